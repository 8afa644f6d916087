// SPDX-License-Identifier: GPL-3.0-or-later
// iceflow: hull in, the water's flow around it out. Command line only; the work is in flow/.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/output_files.hpp"
#include "common/cli/quantity_option.hpp"
#include "common/cli/start_threads.hpp"
#include "common/formats/flow_report.hpp"
#include "common/formats/spheres_file.hpp"
#include "common/toml/recognise_input.hpp"
#include "solver/flow/added_mass.hpp"
#include "solver/flow/flow_table.hpp"
#include "solver/flow/wetted_panels.hpp"
#include "solver/flow/write_vti.hpp"

namespace {

// Command line of iceflow: lengths [m], density [kg/m3]; 0 and empty mean "not given".
struct Options {
    std::string hull, out, json, simd = "auto";
    std::vector<std::string> exports, left_out;
    std::optional<double> draught;
    double panel = 0.0, spacing = 0.0;
    int threads = 0;
    double density = 1025.0;
    std::vector<double> about;
    bool check = false, added_mass = false;
    ice::MessageOptions messages;
};

void declare(CLI::App& app, Options& o) {
    const auto length = [](const char* example) {
        return ice::positive_quantity(ice::Dimension::length, example);
    };
    // lengths with or without a unit, as in case files: 1.44, "144 cm"
    ice::declare_version(app);
    app.add_option("hull", o.hull, "Sphere set of the hull, made by spherize");
    app.add_option("-o,--output", o.out, "Flow file (default <hull stem>.flow.h5)");
    app.add_option("--draught", o.draught,
                   "Water over the hull's lowest point (default: the water is z = 0 of the mesh)")
        ->type_name("T")
        ->transform(length("1.44"));
    app.add_option("--panel", o.panel,
                   "Longest edge of a source panel (default: length / 15; in 2D length / 100)")
        ->type_name("H")
        ->transform(length("0.5"));
    app.add_option("--spacing", o.spacing,
                   "Spacing of the table's nodes; half a floe's thickness or less (default: that "
                   "of 300 000 nodes)")
        ->type_name("S")
        ->transform(length("0.15"));
    app.add_option("--without", o.left_out,
                   "Region of the hull to leave out, a thin plate such as a rudder (repeatable)")
        ->type_name("REGION")
        ->allow_extra_args(false);
    // what is computed, then what is written, then how
    app.add_flag("--check", o.check,
                 "Solve the flow and report the panels' residual; write no flow file");
    app.add_flag("--added-mass", o.added_mass,
                 "Also print the hull's added mass: surge, sway, yaw for slow motions, heave, "
                 "roll, pitch for fast ones");
    app.add_option("--about", o.about,
                   "Point for rotations, in the mesh's axes (default: midships in the water)")
        ->expected(3);
    app.add_option("--density", o.density, "Of the water, for the added mass")
        ->type_name("RHO")
        ->capture_default_str()
        ->transform(ice::positive_quantity(ice::Dimension::density, "1025"));
    app.add_option("--export", o.exports, "Also write the flow for another program (repeatable)")
        ->check(CLI::IsMember({"vti"}))
        ->allow_extra_args(false);
    app.add_option("--json", o.json, "Write the flow's measures as JSON");
    app.add_option("--threads", o.threads, "Threads (default: all cores)")
        ->check(CLI::Range(1, 4096));
    app.add_option("--simd", o.simd, "Instruction set; results are the same on all")
        ->check(CLI::IsMember({"auto", "scalar", "sse4", "avx2", "avx512"}));
    app.add_flag("-q,--quiet", o.messages.quiet, "No messages but errors");
    app.footer("Exit codes: 0 ok; 1 failed; 2 bad command line or hull.");
}

std::filesystem::path output_of(const Options& o) {
    if (!o.out.empty()) return o.out;
    // hull.spheres.h5 and hull.h5 both give hull.flow.h5.
    std::filesystem::path stem = std::filesystem::path(o.hull).stem();
    if (stem.extension() == ".spheres") stem = stem.stem();
    return stem.string() + ".flow.h5";
}

// Beside the flow file, with its name.
std::filesystem::path export_of(const std::filesystem::path& out) {
    return std::filesystem::path(out).replace_extension(".vti");
}

// z of the water in the mesh's frame
double water_of(const Options& o, const ice::SphereSet& hull) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const ice::Vec3& v : hull.mesh.vertices) {
        low = std::min(low, v.z());
        high = std::max(high, v.z());
    }
    // without a draught the mesh's own z = 0, where designers mostly have the waterline
    const double water = o.draught ? low + *o.draught : 0.0;
    if (water <= low || water >= high)
        throw ice::bad_input(
            o.draught ? "--draught" : o.hull,
            fmt::format("the water at z = {:.4g} m does not cut the hull, which lies from z = "
                        "{:.4g} to {:.4g} m",
                        water, low, high),
            fmt::format("give --draught, between 0 and {:.4g} m", high - low));
    return water;
}

// The measures of a flow as JSON and text have them, so that both state the same numbers.
ice::FlowReport report_of(const ice::HullFlow& flow, int dimension) {
    ice::FlowReport r;
    r.dimension = dimension;
    r.symmetric = flow.table.symmetric;
    r.draught = flow.table.draught;
    r.length = flow.length;
    r.panels = flow.table.panels;
    r.panel = flow.panel;
    r.residual = flow.table.residual;
    r.worst = flow.worst;
    r.worst_at = {flow.worst_place.x(), flow.worst_place.y(), flow.worst_place.z()};
    r.net_flux = flow.net_flux;
    r.nodes = flow.table.nodes;
    r.spacing = flow.table.spacing;
    r.solve_seconds = flow.solve_seconds;
    r.table_seconds = flow.table_seconds;
    r.warnings = ice::warnings_of(flow);
    return r;
}

void add_added_mass(const Options& o, const ice::SphereSet& hull, double water,
                    ice::FlowReport& r) {
    // A section has three motions, and masses per metre of breadth.
    if (hull.dimension != 3)
        throw ice::bad_input("--added-mass", "needs a hull in 3D",
                             "give the set of the whole hull");
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const ice::Vec3& v : hull.mesh.vertices) {
        low = std::min(low, v.x());
        high = std::max(high, v.x());
    }
    // midships, on the centre line, in the water's surface
    r.added_mass_about = {0.5 * (low + high), 0.0, water};
    if (!o.about.empty()) std::copy_n(o.about.begin(), 3, r.added_mass_about.begin());
    const ice::Vec3 about(r.added_mass_about[0], r.added_mass_about[1], r.added_mass_about[2]);
    const ice::ShipAddedMass mass =
        ice::ship_added_mass(hull.mesh, water, about, o.density, o.panel);
    r.displacement = mass.displacement;
    r.water_density = o.density;
    r.added_mass.emplace();
    // Order of the six motions: surge, sway, heave, roll, pitch, yaw.
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            (*r.added_mass)[i][j] = mass.matrix(static_cast<int>(i), static_cast<int>(j));
}

// Shares and radii instead of the matrix, whose numbers say little to the eye; JSON has all of it.
std::string added_mass_text(const ice::FlowReport& r) {
    if (!r.added_mass) return "";
    const auto& a = *r.added_mass;
    // inertia as the radius r with A' = displacement r^2
    return fmt::format(
        "  added mass        surge {:.3f}, sway {:.3f}, heave {:.3f} of the displacement, {:.4g} "
        "t\n"
        "  added inertia     as if that lay at {:.3g} m (roll), {:.3g} m (pitch), {:.3g} m (yaw)\n",
        a[0][0] / r.displacement, a[1][1] / r.displacement, a[2][2] / r.displacement,
        1e-3 * r.displacement, std::sqrt(a[3][3] / r.displacement),
        std::sqrt(a[4][4] / r.displacement), std::sqrt(a[5][5] / r.displacement));
}

std::string report_text(const ice::FlowReport& r, const std::string& name) {
    std::string out = fmt::format(
        "{}\n"
        "  wetted hull       {:.4g} m long, draught {:.4g} m{}\n"
        "  panels            {}, edges up to {:.3g} m\n"
        "  normal velocity   {:.2f} % of the ship's speed left on the hull (rms); largest {:.1f} % "
        "at ({:.2f}, {:.2f}, {:.2f}) m\n"
        "  net flux          {:.3f} % of the sources\n",
        name, r.length, r.draught, r.symmetric ? ", symmetric" : "", r.panels, r.panel,
        100.0 * r.residual, 100.0 * r.worst, r.worst_at[0], r.worst_at[1], r.worst_at[2],
        100.0 * r.net_flux);
    if (r.nodes[0] > 0)
        out += fmt::format("  table             {} x {} x {} nodes every {:.3g} m\n", r.nodes[0],
                           r.nodes[1], r.nodes[2], r.spacing);
    return out + added_mass_text(r) +
           fmt::format("  time              {:.2f} s for the panels, {:.2f} s for the table\n",
                       r.solve_seconds, r.table_seconds);
}

int run_iceflow(const Options& o, const std::string& command_line) {
    if (o.hull.empty())
        throw ice::bad_input("iceflow", "no hull given", "iceflow HULL.spheres.h5 -o HULL.flow.h5");
    if (const auto mesh = ice::recognise_file(o.hull, ""); mesh && std::filesystem::exists(o.hull))
        throw ice::bad_input(o.hull, "is " + mesh->what + ", not a sphere set",
                             "spherize " + ice::shell_word(o.hull) + " makes a sphere set of it");
    // neither changes a bit of the table
    ice::set_thread_count(o.threads);
    ice::start_threads();
    ice::set_instruction_set(o.simd);
    const std::filesystem::path out = output_of(o);
    ice::OutputFiles files;
    // no output may replace the hull or another output, which is checked before the long work
    files.protect(o.hull, "the hull");
    if (!o.check) files.add("--output", out);
    if (!o.exports.empty()) files.add("--export", export_of(out));
    files.add("--json", o.json);
    ice::SphereSet hull = ice::read_spheres(o.hull);
    if (!o.left_out.empty()) hull.mesh = ice::without_regions(hull.mesh, o.left_out);
    // A check solves the panels alone, unless an export needs the table.
    ice::FlowOptions options{water_of(o, hull), o.panel, o.spacing, 0.0};
    options.table = !o.check || !o.exports.empty();
    ice::HullFlow flow = ice::make_hull_flow(hull.mesh, hull.dimension, options);
    flow.table.source_sha256 = hull.source_sha256;
    flow.table.created_by = fmt::format("iceflow {} ({})", ice::version(), ice::git_commit());
    flow.table.command_line = command_line;
    if (!o.check) ice::write_flow(out, flow.table);
    if (!o.exports.empty()) ice::write_vti(export_of(out), flow.table);
    ice::FlowReport report = report_of(flow, hull.dimension);
    if (o.added_mass) add_added_mass(o, hull, options.water, report);
    if (!o.json.empty()) ice::write_text_file(o.json, ice::flow_report_text(report));
    if (!o.messages.quiet) ice::write_data(report_text(report, o.check ? o.hull : out.string()));
    for (const std::string& warning : report.warnings) ice::say_warning(warning);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    ice::keep_pages();
    CLI::App app(
        "Computes the water's flow around a moving hull: sphere set in, table of velocities out.",
        "iceflow");
    Options o;
    declare(app, o);
    return ice::run_command_line(
        app, argc, argv, o.messages, "use larger panels or a larger spacing",
        [&](const std::string& command_line) { return run_iceflow(o, command_line); });
}
