// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/make_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/file_turn.hpp"
#include "common/base/state_hash.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/flow/flow_table.hpp"
#include "solver/record/measure_particulars.hpp"

namespace ice {

namespace {

// Version of the tables' content [-]: to be raised where equal hulls get other tables, so that old
// ones are not read.
constexpr std::uint64_t kTables = 1;

// Largest difference of a file's draught from the case's, as its share [-]. Larger takes the flow
// of another wetted hull; smaller refuses draughts that were rounded.
constexpr double kSameDraught = 0.01;
// Froude number above which the flat surface is worth a warning [-]: waves change the flow by its
// square, 4 % here. A smaller value warns at speeds without waves that matter, a larger one leaves
// waves unsaid.
constexpr double kMostFroude = 0.2;
// Residual of the flow that is worth a warning [-]: hulls with sharp edges have 0.02 to 0.04. A
// smaller value warns of such hulls, a larger one leaves flows with large errors unsaid.
constexpr double kMostResidual = 0.05;
// The longest that this program waits for the flow that another one makes [min]. A shorter time
// computes tables twice, a longer one waits for a program that has stopped.
constexpr auto kOthersWork = std::chrono::minutes(10);
// Change of a mean resistance per change of the flow [-]: 1 % of the flow is a quarter of a per
// cent of a channel's resistance. It scales a warning's share alone.
constexpr double kOfMean = 0.25;

// Extent along z in the shape's own axes [m], 0 without floes: the flow has to be resolved over a
// floe's height, and floes mostly lie flat.
double thinnest_floe(const Scene& scene) {
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < scene.shapes.size(); ++k) {
        double low = 0.0, high = 0.0;
        for (const Vec3& v : scene.shapes[k].mesh.vertices) {
            low = std::min(low, v.z());
            high = std::max(high, v.z());
        }
        out = std::min(out, high - low);
    }
    return std::isfinite(out) ? out : 0.0;
}

// To three digits: floes of one thickness, in fields of several seeds, differ in the last ones, and
// are to share a table.
double round_down(double length) {
    if (length <= 0.0) return 0.0;
    const double unit = std::pow(10.0, std::floor(std::log10(length)) - 2.0);
    return unit * std::floor(length / unit * (1.0 + 1e-9));
}

double keel_of(const TriangleMesh& mesh) {
    double keel = std::numeric_limits<double>::infinity();
    for (const Vec3& v : mesh.vertices) keel = std::min(keel, v.z());
    return keel;
}

std::uint64_t hash_of_flow(const TriangleMesh& mesh, int dimension, const FlowOptions& options) {
    // All that decides the table is in the file's name; a changed hull, draught or thickness has
    // another file.
    StateHash hash;
    hash.add(kTables);
    hash.add(static_cast<std::uint64_t>(dimension));
    for (const double value : {options.water, options.panel, options.spacing, options.finest})
        hash.add(value);
    for (const Vec3& v : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) hash.add(v[axis]);
    for (const auto& t : mesh.triangles)
        for (const std::int32_t corner : t) hash.add(static_cast<std::uint64_t>(corner));
    return hash.value();
}

std::filesystem::path kept_as(const std::filesystem::path& spheres, std::uint64_t hash) {
    std::filesystem::path stem = spheres.stem();
    if (stem.extension() == ".spheres") stem = stem.stem();
    return spheres.parent_path() / fmt::format("{}.{:016x}.flow.h5", stem.string(), hash);
}

// Of several runs at once the first makes a flow, the others wait for it. The lock is a file of its
// own, removed afterwards; where none can be made, each makes its own.
class OneMaker {
public:
    explicit OneMaker(const std::filesystem::path& flow)
        : lock_(flow.string() + ".lock"), turn_(made(lock_), FileTurn::Kind::write, kOthersWork) {}
    ~OneMaker() {
        std::error_code ignored;
        std::filesystem::remove(lock_, ignored);
    }
    OneMaker(const OneMaker&) = delete;
    OneMaker& operator=(const OneMaker&) = delete;

private:
    static const std::filesystem::path& made(const std::filesystem::path& lock) {
        std::ofstream(lock, std::ios::app).flush();
        return lock;
    }
    std::filesystem::path lock_;
    FileTurn turn_;
};

FlowTable make_table(const Case& p, const Scene& scene) {
    const TriangleMesh& mesh = scene.shapes[0].mesh;
    FlowOptions options;
    options.water = -scene.bodies.position[kShip].z();
    // the table's finest nodes are half a floe's thickness apart
    options.finest = round_down(0.5 * thinnest_floe(scene));
    const auto file = kept_as(p.hull_spheres, hash_of_flow(mesh, p.dimension, options));
    if (std::filesystem::exists(file)) return read_flow(file);
    // Asked twice: before the lock, so that finished flows cost no lock, and after it, because
    // another run may have made the file meanwhile.
    const OneMaker turn(file);
    if (std::filesystem::exists(file)) return read_flow(file);
    say("computing the flow around the hull");
    HullFlow made = make_hull_flow(mesh, p.dimension, options);
    made.table.source_sha256 = read_spheres(p.hull_spheres).source_sha256;
    made.table.created_by = fmt::format("icesolve {} ({})", version(), git_commit());
    say(fmt::format(
        "flow around the hull: {} panels, {:.1f} % of the speed left on the hull, {} x "
        "{} x {} nodes, {:.1f} s",
        made.table.panels, 100.0 * made.table.residual, made.table.nodes[0], made.table.nodes[1],
        made.table.nodes[2], made.solve_seconds + made.table_seconds));
    try {
        write_flow(file, made.table);
        say(fmt::format("kept in {}", file.string()));
        // A folder that cannot be written is no fault of the run: it has its table in memory.
    } catch (const Error& error) {
        say(fmt::format("not kept for the next run: {}", error.what()));
    }
    return made.table;
}

FlowTable read_table(const Case& p, const Scene& scene) {
    FlowTable table = read_flow(p.flow_file);
    const double draught = -scene.bodies.position[kShip].z() - keel_of(scene.shapes[0].mesh);
    // a table of a section has one node across
    if ((table.nodes[1] == 1) != (p.dimension == 2))
        throw bad_input(p.flow_file.string(),
                        p.dimension == 2 ? "is of a hull in 3D" : "is of a section",
                        "make it with iceflow from the case's hull.spheres");
    if (std::abs(table.draught - draught) > kSameDraught * draught)
        throw bad_input(p.flow_file.string(),
                        fmt::format("is for a draught of {:.4g} m, the case's hull has {:.4g} m",
                                    table.draught, draught),
                        fmt::format("make it with iceflow --draught {:.6g}", draught));
    return table;
}

// Whether the ship ever moves through the water: else its flow is zero, and no table is needed.
bool pushes_water(const Case& p) {
    return p.ship.free[surge] ||
           std::any_of(p.speed_table.begin(), p.speed_table.end(),
                       [&](const auto& row) { return row.second != p.current[0]; });
}

}  // namespace

WaterFlow make_water(const Case& p, const Scene& scene) {
    WaterFlow out;
    out.current = Vec3(p.current[0], p.current[1], 0.0);
    if (p.flow == FlowModel::none) return out;
    if (p.flow == FlowModel::double_body && !pushes_water(p)) return out;
    const FlowTable table = p.flow == FlowModel::file ? read_table(p, scene) : make_table(p, scene);
    out.grid = FlowGrid(table);
    out.presses = p.flow_pressure;
    return out;
}

std::vector<Warning> check_water(const Case& p, const Scene& scene) {
    std::vector<Warning> out;
    const WaterFlow& water = scene.water;
    if (water.grid.empty()) return out;
    double speed = 0.0;
    for (const auto& [time, u] : p.speed_table)
        speed = std::max(speed, std::abs(u - water.current.x()));
    // The double-body flow has a rigid water surface. The neglected waves grow with Fr^2, which is
    // the warning's share.
    const double froude = speed / std::sqrt(p.gravity * measure_ship(scene, p).length);
    if (froude > kMostFroude)
        out.push_back(judged(
            fmt::format("flow: {:.3g} m/s is a Froude number of {:.2f}: the ship makes waves, "
                        "which flow.model = \"double-body\" leaves out; go slower, or give a "
                        "field with flow.model = \"file\"",
                        speed, froude),
            froude * froude));
    if (water.grid.residual > kMostResidual)
        out.push_back(
            judged(fmt::format("flow: velocity through the hull is {:.1f} % of the ship's speed "
                               "(rms): iceflow --check says where, --panel makes smaller panels, "
                               "--without leaves out thin plates, flow.file reads the result",
                               100.0 * water.grid.residual),
                   kOfMean * water.grid.residual));
    return out;
}

}  // namespace ice
