// SPDX-License-Identifier: GPL-3.0-or-later
// spherize: mesh in, sphere set out. Command line only; each step is a folder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/timer.hpp"
#include "common/base/units.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/output_files.hpp"
#include "common/cli/quantity_option.hpp"
#include "common/cli/start_threads.hpp"
#include "common/formats/spheres_file.hpp"
#include "preprocess/certify/certify_solid.hpp"
#include "preprocess/certify/find_cut_back.hpp"
#include "preprocess/certify/judge_spheres.hpp"
#include "preprocess/fill/fill_spheres.hpp"
#include "preprocess/load/gunzip.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/looks_cut_off.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/load/refuse_short_file.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "preprocess/write/report_text.hpp"
#include "preprocess/write/write_exports.hpp"

namespace {

// Density of ice [kg/m3] in exports without --density; fresh to sea ice has 850 to 920. It scales
// mass and inertia there; the sphere set has unit density.
constexpr double kIceDensity = 900.0;

struct Options {
    std::string mesh, out, arrangement = "conforming", mode = "fill", slice, units, mirror, json;
    std::string repair = "auto", solid = "envelope";
    std::vector<std::string> exports;
    std::optional<double> draught, ice_thickness;  // [m]
    std::optional<double> density;  // [kg/m3]; the sphere set itself keeps unit density
    ice::ReadOptions read;
    ice::FillOptions fill;
    int threads = 0;
    bool check = false;
    ice::MessageOptions messages;
};

// Puts the unit's length in metres in place of its name.
std::string metres_per_unit(std::string& text) {
    // The units of lengths are those of all options; km is no unit of meshes, and more likely a
    // slip.
    const auto unit = ice::parse_quantity("1 " + text, ice::Dimension::length);
    if (!unit || !unit->has_unit || text == "km") return text + " is none of mm, cm, m, ft, in";
    text = fmt::format("{}", unit->value);
    return {};
}

// In the order of the help: file, spheres, solid, axes, ice belt, repair, output.
void declare(CLI::App& app, Options& o) {
    ice::declare_version(app);
    app.add_option("mesh", o.mesh, "Surface mesh: OBJ, STL, PLY, OFF, DAE, glTF, FBX, also .gz")
        ->required();
    app.add_option("-o,--output", o.out, "Sphere file (default <mesh stem>.spheres.h5)");
    const auto length = ice::positive_quantity(ice::Dimension::length, "0.15");
    app.add_option("-r,--radius", o.fill.radius, "Sphere radius, in m or with a unit (0.1)")
        ->transform(length);
    app.add_option("-s,--spacing", o.fill.spacing,
                   "Centre distance on the surface, in m or with a unit (radius)")
        ->transform(length);
    app.add_option("--arrangement", o.arrangement, "conforming or lattice")
        ->check(CLI::IsMember({"conforming", "lattice"}));
    app.add_option("--mode", o.mode, "fill, or surface to drop the interior")
        ->check(CLI::IsMember({"fill", "surface"}));
    app.add_option("--slice", o.slice, "y=VALUE: 2D set from that section");
    app.add_option("--solid", o.solid, "envelope (fill inner voids and double skins) or material")
        ->check(CLI::IsMember({"envelope", "material"}));
    auto* unit = app.add_option("--units", o.read.scale,
                                "Unit of the file: mm, cm, m, ft, in (from the file, or guessed)")
                     ->type_name("UNIT")
                     ->transform(CLI::Validator(metres_per_unit, "{mm,cm,m,ft,in}"));
    app.add_option("--scale", o.read.scale, "Metres per file unit")
        ->transform(ice::positive_quantity(ice::Dimension::none, "0.001"))
        ->excludes(unit);
    app.add_option("--up", o.read.up, "File axis that points up (from the file, or guessed)")
        ->check(CLI::IsMember({"y", "z", "-y", "-z"}));
    app.add_option("--forward", o.read.forward, "File direction of the bow (guessed)")
        ->check(CLI::IsMember({"+x", "-x", "+y", "-y", "+z", "-z"}));
    app.add_option("--mirror", o.mirror, "y: the file holds one half of the hull")
        ->check(CLI::IsMember({"y"}));
    app.add_option("--draught", o.draught,
                   "Height of the water over the mesh's lowest point, in m or with a unit; adds a "
                   "report on the ice belt")
        ->transform(length);
    app.add_option("--ice-thickness", o.ice_thickness,
                   "Ice thickness of that belt, in m or with a unit (a tenth of the draught)")
        ->transform(length);
    app.add_option("--repair", o.repair, "auto, strict (refuse an open mesh) or wrap (shrink-wrap)")
        ->check(CLI::IsMember({"auto", "strict", "wrap"}));
    app.add_flag("--check", o.check,
                 "Diagnose the mesh only: its faults, and the repairs it would get");
    app.add_option("--export", o.exports,
                   "Also write the set as csv, vtp, yade, liggghts or chrono; repeatable")
        ->check(CLI::IsMember(ice::export_formats()));
    app.add_option("--density", o.density, "Density [kg/m3] of the mass in the exports (900, ice)")
        ->transform(ice::positive_quantity(ice::Dimension::density, "900"));
    app.add_option("--json", o.json, "Write the certificate as JSON");
    app.add_option("--threads", o.threads, "Threads (default: all cores)")
        ->check(CLI::Range(1, 4096));
    app.add_flag("-q,--quiet", o.messages.quiet, "No messages but errors");
    app.footer("Exit codes: 0 ok; 1 failed; 2 bad command line or mesh.");
}

void warn_half_hull(const ice::HalfHull& half, ice::SpheresReport& report) {
    if (half) report.warnings.push_back(half.text() + ": give --mirror y if it is");
}

ice::TriangleMesh read_surface(const Options& o, ice::SpheresReport& report) {
    // Before the reader, which takes a file that was cut off for a smaller mesh.
    ice::refuse_short_file(o.mesh);
    ice::ReadNotes notes;
    ice::TriangleMesh mesh = ice::read_mesh(o.mesh, o.read, &notes);
    report.guessed = notes.guessed;
    report.warnings = notes.warnings;
    if (notes.centre_plane_dropped > 0)
        report.repairs.emplace_back("triangles in the centre plane dropped",
                                    notes.centre_plane_dropped);
    return mesh;
}

ice::TriangleMesh read_solid(const Options& o, ice::TriangleMesh surface,
                             ice::SpheresReport& report) {
    ice::SolidOptions options;
    options.kind = o.solid == "material" ? ice::SolidKind::material : ice::SolidKind::envelope;
    options.mode = o.repair == "strict" ? ice::RepairMode::strict
                   : o.repair == "wrap" ? ice::RepairMode::wrap
                                        : ice::RepairMode::automatic;
    // Repairs are measured against the radius: details finer than a sphere change no contact.
    options.radius = o.fill.radius;
    options.suspect = ice::looks_cut_off(o.mesh);
    if (!options.suspect.empty()) report.warnings.push_back(options.suspect);
    // Looked at twice: of the surface, which make_solid takes over, in case it is refused, and of
    // the solid, which may have been mirrored.
    const ice::HalfHull half = ice::looks_like_half_hull(surface);
    ice::TriangleMesh mesh;
    try {
        mesh =
            ice::make_solid(std::move(surface), o.mesh, options, report.repairs, &report.warnings);
    } catch (const ice::Error&) {  // a warning of the reader may name the reason
        warn_half_hull(half, report);
        for (const std::string& warning : report.warnings) ice::say_warning(warning);
        throw;
    }
    warn_half_hull(ice::looks_like_half_hull(mesh), report);
    if (o.mirror.empty() && ice::was_mirrored(report))
        report.warnings.emplace_back(
            "the mesh is open along y = 0, half a hull, and was mirrored there: give --mirror y to "
            "say so, or close it if it is whole");
    return mesh;
}

// --check: describes the mesh and its repairs, without spheres. A mesh that is refused is described
// first, on stdout and in the JSON.
int report_check(const Options& o, ice::SpheresReport& report) {
    const ice::TriangleMesh surface = read_surface(o, report);
    ice::write_data(fmt::format("{}:\n{}", o.mesh, ice::describe_mesh(surface)));
    const auto write_json = [&] {
        if (!o.json.empty()) ice::write_text_file(o.json, ice::spheres_report_text(report));
    };
    try {
        const ice::TriangleMesh mesh = read_solid(o, surface, report);
        const ice::MassProperties mass = ice::measure_mass(mesh);
        report.volume = mass.volume;
        report.area = mass.area;
        ice::set_ice_belt(mesh, o.draught, o.ice_thickness, report);
        ice::certify_solid(o.mesh, surface, mesh, o.fill.radius, o.repair == "wrap", report);
        for (const auto& [what, value] : report.guessed)
            ice::write_data(fmt::format("  {:<18}{}: {}\n", "assumed", what, value));
        for (const auto& [step, count] : report.repairs)
            ice::write_data(fmt::format("  {:<18}{}: {}\n", "repair", step, count));
        ice::write_data(fmt::format("{}: closed solid, {} triangles, {:.9g} m3\n", o.mesh,
                                    mesh.triangles.size(), mass.volume));
    } catch (const ice::Error& refusal) {
        // the JSON of a refused mesh has the reason, for programs that read no messages
        report.warnings.emplace_back(refusal.what());
        write_json();
        throw;
    }
    write_json();
    for (const std::string& warning : report.warnings) ice::say_warning(warning);
    return 0;
}

double slice_offset(const std::string& slice) {
    const auto offset = slice.starts_with("y=")
                            ? ice::parse_quantity(slice.substr(2), ice::Dimension::length)
                            : std::nullopt;
    if (!offset || !std::isfinite(offset->value))
        throw ice::bad_input("--slice " + slice, "is not y=VALUE",
                             "write for instance --slice y=0");
    return offset->value;
}

// A name given twice would cost the user the mesh, or one of the results.
void check_outputs(const Options& o, const std::string& out) {
    ice::OutputFiles files;
    files.protect(o.mesh, "the mesh");
    files.add("--output", out);
    files.add("--json", o.json);
    for (const auto& file :
         ice::export_files(o.exports, std::filesystem::path(out).replace_extension()))
        files.add("--export", file);
}

ice::SphereSet fill_solid(const Options& o, const ice::TriangleMesh& mesh,
                          ice::SpheresReport& report) {
    try {
        if (o.slice.empty()) return ice::fill_spheres(mesh, o.fill, report);
        return ice::fill_discs(ice::slice_solid(mesh, slice_offset(o.slice)), mesh.region_names,
                               o.fill, report);
    } catch (const ice::Error&) {  // a unit wrongly guessed may be the reason
        for (const auto& [what, value] : report.guessed)
            ice::say_warning("assumed " + what + ": " + value);
        throw;
    }
}

// A line on stderr every few seconds while a step takes long.
void tell_progress(ice::FillOptions& fill) {
    // Time between two lines [s]: short runs print none, long ones do not fill a log. A smaller
    // value prints more lines, a larger one lets the user wait.
    constexpr double kEvery = 3.0;
    fill.progress = [timer = ice::Timer(), next = kEvery](const std::string& step,
                                                          double share) mutable {
        if (timer.seconds() < next) return;
        next = timer.seconds() + kEvery;
        ice::say(share > 0.0 ? fmt::format("{}: {:.0f} %", step, 100.0 * share) : step);
    };
}

int run_spherize(Options& o, const std::string& command_line) {
    const ice::Timer timer;
    ice::set_thread_count(o.threads);
    ice::start_threads();
    o.read.mirror_y = o.mirror == "y";
    o.fill.surface_only = o.mode == "surface";
    o.fill.arrangement =
        o.arrangement == "lattice" ? ice::Arrangement::lattice : ice::Arrangement::conforming;

    if (o.arrangement == "lattice" && o.fill.spacing > 0.0)
        throw ice::bad_input("--spacing", "has no meaning for a lattice, whose pitch is 2 R",
                             "leave it out, or use --arrangement conforming");

    // all refusals come before the long work
    const std::string out = o.out.empty() ? ice::mesh_stem(o.mesh) + ".spheres.h5" : o.out;
    check_outputs(o, out);
    ice::SpheresReport report;
    if (o.check) return report_check(o, report);
    ice::TriangleMesh surface = read_surface(o, report);
    report.seconds["read"] = timer.seconds();
    // With a wrong unit the mesh is a thousand times too small or too large: seen here, before the
    // repair, which can take minutes.
    ice::refuse_thin_mesh(o.mesh, surface, o.fill.radius, o.slice.empty() ? 3 : 2);
    tell_progress(o.fill);
    const ice::TriangleMesh mesh = read_solid(o, surface, report);
    report.seconds["repair"] = timer.seconds() - report.seconds["read"];
    ice::set_ice_belt(mesh, o.draught, o.ice_thickness, report);
    ice::certify_solid(o.mesh, std::move(surface), mesh, o.fill.radius, o.repair == "wrap", report);
    ice::SphereSet set = fill_solid(o, mesh, report);
    ice::find_cut_back(set, report);

    // the set's origin is stored with it
    const std::filesystem::path source(o.mesh);
    set.source_mesh = report.source_mesh = source.filename().string();
    set.source_sha256 = ice::file_sha256(source);
    set.created_by = fmt::format("spherize {} ({})", ice::version(), ice::git_commit());
    set.command_line = report.command_line = command_line;
    // Last of all measures, as it turns them into warnings.
    ice::judge_spheres(set, o.fill.arrangement, report);
    const auto export_base = std::filesystem::path(out).replace_extension();
    // Refused before anything is written, so that no run leaves half of its files.
    ice::check_exports(set, o.exports, export_base);
    const double density = o.density.value_or(kIceDensity);
    if (!o.density && std::any_of(o.exports.begin(), o.exports.end(), ice::has_mass))
        report.guessed["density"] = fmt::format("{} kg/m3, as of ice, in the exports", density);
    const ice::Timer writing;
    ice::write_spheres(out, set, report);
    report.seconds["write"] = writing.seconds();
    report.seconds["total"] = timer.seconds();
    if (!o.json.empty()) ice::write_text_file(o.json, ice::spheres_report_text(report));
    const auto exported = ice::write_exports(set, o.exports, density, export_base);
    if (!o.messages.quiet) ice::write_data(ice::report_text(report, out));
    if (!o.messages.quiet)
        for (const auto& path : exported)
            ice::write_data(fmt::format("  {:<18}{}\n", "exported", path.string()));
    for (const std::string& warning : report.warnings) ice::say_warning(warning);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    ice::keep_pages();
    CLI::App app("Fills a closed mesh with contact spheres: mesh in, sphere set out.", "spherize");
    Options o;
    declare(app, o);
    return ice::run_command_line(
        app, argc, argv, o.messages, "use a larger radius or spacing, --mode surface",
        [&](const std::string& command_line) { return run_spherize(o, command_line); });
}
