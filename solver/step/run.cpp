// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/step/run.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/timer.hpp"
#include "common/base/version.hpp"
#include "solver/record/lindqvist.hpp"
#include "solver/record/recorder.hpp"
#include "solver/scene/build_scene.hpp"

namespace ice {

namespace {

StepView view_of(const World& w) {
    return {w.scene, w.contacts, w.constraints, w.time, w.impacts.converged && w.rest.converged};
}

void check_finite(const World& w) {
    const Bodies& b = w.scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i)
        if (!b.position[i].allFinite() || !b.velocity[i].allFinite())
            throw run_failed(fmt::format("step {}, floe {}", w.steps, i),
                             "its position is no longer a number",
                             "use a smaller simulation.time_step");
}

// Thickness of the first group's floes as they lie: h of the empirical formula.
double ice_thickness(const World& w) {
    const Shape& shape = w.scene.shapes[static_cast<std::size_t>(w.scene.bodies.shape[1])];
    Eigen::AlignedBox3d box;
    const Mat3 r = w.parameters.floes.front().orientation.toRotationMatrix();
    for (const Vec3& v : shape.mesh.vertices) box.extend(r * v);
    return box.sizes().z();
}

std::optional<double> lindqvist_of(const World& w, double thickness) {
    const Case& p = w.parameters;
    if (p.dimension == 2) return std::nullopt;  // a formula for whole ships
    const auto form = measure_hull_form(w.scene.shapes[0].mesh, -p.hull_position.z());
    if (!form) return std::nullopt;
    const double speed = std::abs(p.ship_speed(0.5 * (p.average_from + p.duration)));
    return lindqvist_submersion(
        *form, {thickness, p.friction_ship_ice, p.ice_density, p.water_density, p.gravity, speed});
}

void fill_run(const World& w, double wall_seconds, Summary& s) {
    const Case& p = w.parameters;
    s.title = p.title;
    s.dimension = p.dimension;
    s.steps = w.steps;
    s.simulated_s = w.time;
    s.wall_s = wall_seconds;
    s.threads = thread_count();
    s.case_file = p.file.string();
    for (std::size_t k = 0; k < kStageNames.size(); ++k)
        s.stage_seconds[kStageNames[k]] = w.stage_seconds[k];
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw run_failed(folder.string(), "cannot be created: " + error.message(),
                         "choose another folder with --out");
}

}  // namespace

World build_world(const Case& parameters) {
    World world;
    world.parameters = parameters;
    world.scene = build_scene(parameters);
    return world;
}

Summary run(World& world, const RunOptions& options) {
    const Timer timer;
    const Case& p = world.parameters;
    make_folder(options.folder);
    // a run into the same folder replaces the old one: nothing of it may look like a result
    std::error_code ignored;
    for (const char* name : {"summary.json", "report.html", "run.h5", "forces.csv"})
        std::filesystem::remove(options.folder / name, ignored);
    write_text_file(options.folder / "case.resolved.cfg",
                    fmt::format("# {} {} ({})\n# {}\n{}", "icesolve", version(), git_commit(),
                                options.command_line, p.resolved));
    const double thickness = ice_thickness(world);

    Recorder recorder(options.folder, p, world.scene, options.command_line);
    Summary summary;
    summary.command_line = options.command_line;
    const auto steps = static_cast<std::int64_t>(std::llround(p.duration / p.time_step));
    while (world.steps < steps) {
        step(world);
        recorder.add(view_of(world));
        if (world.steps % 100 == 0) check_finite(world);
        const double done = static_cast<double>(world.steps) / static_cast<double>(steps);
        if (!options.keep_going(done, world)) {
            summary.status = "interrupted";
            break;
        }
    }
    check_finite(world);
    recorder.finish(view_of(world), summary);
    summary.lindqvist_submersion = lindqvist_of(world, thickness);
    fill_run(world, timer.seconds(), summary);
    write_text_file(options.folder / "summary.json", summary_text(summary));
    return summary;
}

}  // namespace ice
