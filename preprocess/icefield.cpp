// SPDX-License-Identifier: GPL-3.0-or-later
// icefield: specification in, ice field out. Command line only; the work is in field/.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/timer.hpp"
#include "common/base/version.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/console.hpp"
#include "common/cli/output_files.hpp"
#include "common/cli/picture_file.hpp"
#include "common/cli/start_threads.hpp"
#include "common/formats/field_file.hpp"
#include "preprocess/field/make_field.hpp"

namespace {

struct Options {
    std::string spec, out, json, preview, explain;
    std::vector<std::string> overrides;
    std::optional<std::int64_t> seed;
    int threads = 0;
    bool defaults = false, schema = false;
    ice::MessageOptions messages;
};

void declare(CLI::App& app, Options& o) {
    ice::declare_version(app);
    app.add_option("specification", o.spec, "Specification of the field (TOML)");
    app.add_option("-o,--output", o.out, "Field file (default <specification stem>.h5)");
    app.add_option("--set", o.overrides, "key=value, replaces a key; repeatable")
        ->allow_extra_args(false)
        ->take_all();
    app.add_option("--seed", o.seed, "Another seed than the specification's");
    app.add_option("--json", o.json, "Write the field's measures as JSON");
    app.add_option("--preview", o.preview, "Draw the field from above: .svg, .png or .pdf");
    app.add_option("--explain", o.explain, "Explain a key of the specification");
    app.add_flag("--print-defaults", o.defaults, "Print all keys with their defaults");
    app.add_flag("--print-schema", o.schema, "Print the JSON schema of the specification");
    app.add_option("--threads", o.threads, "Threads (default: all cores)")
        ->check(CLI::Range(1, 4096));
    app.add_flag("-q,--quiet", o.messages.quiet, "No messages but errors");
    app.footer("Exit codes: 0 ok; 1 failed; 2 bad command line or specification.");
}

void check_outputs(const Options& o, const ice::FieldSpec& spec, const std::string& out) {
    ice::OutputFiles files;
    // No output may replace an input or another output: the name is refused, not the file lost.
    files.protect(o.spec, "the specification");
    if (!spec.file.empty()) files.protect(spec.file, "the polygons");
    files.add("--output", out);
    files.add("--json", o.json);
    files.add("--preview", o.preview);
}

std::string report_text(const ice::FieldReport& r, const ice::Field& field,
                        const std::string& out) {
    return fmt::format(
        "{}\n"
        "  floes             {} of {} shapes, and {} pieces of unbroken ice\n"
        "  area              {:.5g} x {:.5g} m\n"
        "  concentration     {:.4f}\n"
        "  size              mean {:.4g}, from {:.4g} to {:.4g} m\n"
        "  spheres           {} of radius {:g} m, {} at the surface\n"
        "  time              {:.2f} s, {:.2f} s of it for the outlines\n",
        out, r.floes, r.shapes, r.fixed, field.area[2] - field.area[0],
        field.area[3] - field.area[1], r.concentration, r.mean_size, r.smallest, r.largest,
        r.spheres, field.radius, r.surface_spheres, r.plan_seconds + r.fill_seconds,
        r.plan_seconds);
}

int run_icefield(const Options& o, const std::string& command_line) {
    // Questions about keys need no specification and no threads.
    if (!o.explain.empty()) {
        ice::write_data(ice::explain_key(ice::field_schema(), o.explain));
        return 0;
    }
    if (o.schema || o.defaults) {
        ice::write_data(o.schema ? ice::json_schema(ice::field_schema())
                                 : ice::default_text(ice::field_schema()));
        return 0;
    }
    if (o.spec.empty())
        throw ice::bad_input("icefield", "no specification given", "icefield SPEC.toml -o FILE");
    ice::set_thread_count(o.threads);
    ice::start_threads();
    if (!o.preview.empty()) ice::check_picture_name(o.preview);
    std::vector<std::string> overrides = o.overrides;
    if (o.seed) overrides.push_back(fmt::format("seed={}", *o.seed));
    const ice::FieldSpec spec = ice::read_field_spec(o.spec, overrides);
    const std::string out =
        o.out.empty() ? std::filesystem::path(o.spec).stem().string() + ".h5" : o.out;
    // After the specification, which may name a file of polygons that no output may replace, and
    // before the work, which may take minutes.
    check_outputs(o, spec, out);

    const ice::Timer timer;
    ice::FieldReport report;
    const ice::FieldPlan plan = ice::plan_field(spec, report.warnings);
    report.plan_seconds = timer.seconds();
    // before the spheres: the drawing may show why they do not fit
    if (!o.preview.empty()) ice::write_picture(o.preview, ice::field_svg(plan));
    ice::Field field = ice::make_field(spec, plan, report);
    field.created_by = fmt::format("icefield {} ({})", ice::version(), ice::git_commit());
    field.command_line = command_line;
    ice::write_field(out, field);
    if (!o.json.empty()) ice::write_text_file(o.json, ice::field_report_text(report));
    if (!o.messages.quiet) ice::write_data(report_text(report, field, out));
    for (const std::string& warning : report.warnings) ice::say_warning(warning);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    ice::keep_pages();
    CLI::App app("Makes an ice field: specification in, floes as contact spheres out.", "icefield");
    Options o;
    declare(app, o);
    return ice::run_command_line(
        app, argc, argv, o.messages, "use larger spheres, fewer floes",
        [&](const std::string& command_line) { return run_icefield(o, command_line); });
}
