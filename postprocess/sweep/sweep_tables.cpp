// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_tables.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"
#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_columns.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sweep {

using views::escape;
using views::readable;

namespace {

// columns of the CSV; the page leaves out the places' contact, which is the rest of their friction
constexpr Part kParts[] = {Part::total,          Part::bow,
                           Part::sides,          Part::bottom,
                           Part::rest,           Part::contact,
                           Part::friction,       Part::bow_contact,
                           Part::sides_contact,  Part::bottom_contact,
                           Part::rest_contact,   Part::bow_friction,
                           Part::sides_friction, Part::bottom_friction,
                           Part::rest_friction};
// later columns, at the end: scripts count on the others' places
constexpr Part kLevelIceParts[] = {Part::breaking, Part::submersion};
const std::vector<std::pair<Part, std::string>> kColumns{
    {Part::bow, "bow"},         {Part::bow_friction, "bow, friction"},
    {Part::sides, "sides"},     {Part::sides_friction, "sides, friction"},
    {Part::bottom, "bottom"},   {Part::bottom_friction, "bottom, friction"},
    {Part::rest, "rest"},       {Part::rest_friction, "rest, friction"},
    {Part::contact, "contact"}, {Part::friction, "friction"}};

std::string head(const std::vector<std::string>& names) {
    std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string& name : names) out += "<th scope=\"col\">" + escape(name) + "</th>";
    return out + "</tr></thead>\n<tbody>\n";
}

std::string cell(const std::string& text) { return "<td>" + escape(text) + "</td>"; }

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::vector<std::string> titles(const std::vector<Column>& columns) {
    std::vector<std::string> out;
    for (const Column& column : columns) out.push_back(column.title);
    return out;
}

std::string cells(const std::vector<Column>& columns, std::size_t row) {
    std::string out;
    for (const Column& column : columns) out += cell(column.cells[row]);
    return out;
}

// of a column's name: per metre of breadth in 2D
const char* force_ending(int dimension) { return dimension == 2 ? "_N_per_m" : "_N"; }

// "jeong_2010_buoyancy_clearing"
std::string column_name(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (kept)
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    return out;
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

// by how much warnings affect a mean [%]; NaN: not measured
double affected_percent(const std::vector<Warning>& warnings) {
    return 100.0 * affected_share(warnings).value_or(std::nan(""));
}

// of all runs of a point
std::vector<Warning> warnings_of(const Sweep& sweep, const Point& point) {
    std::vector<Warning> out;
    for (const std::size_t row : point.runs) {
        const auto& warnings = sweep.runs[row].summary->warnings;
        out.insert(out.end(), warnings.begin(), warnings.end());
    }
    return out;
}

}  // namespace

std::string link_to_run(const SweepRun& run, const std::string& text,
                        const std::filesystem::path& page) {
    namespace fs = std::filesystem;
    const fs::path report = run.folder / "report.html";
    const fs::path target = fs::exists(report) ? report : run.folder;
    // a run that never began has no folder
    if (!fs::exists(target)) return escape(text);
    std::error_code error;
    // relative to the page, so that a folder may be moved as a whole
    const fs::path from = fs::absolute(page).parent_path();
    const std::string address = fs::absolute(target).lexically_relative(from).generic_string();
    return "<a href=\"" + encode_address(address) + "\">" + escape(text) + "</a>";
}

std::string point_table(const Sweep& sweep, const std::vector<Point>& points,
                        const report::ForceUnit& unit, const std::filesystem::path& page) {
    const auto axes = axis_columns(sweep, points, true);
    auto forces = force_columns(points, unit, kColumns, true);
    for (Column& column : crack_columns(points)) forces.push_back(std::move(column));
    std::vector<std::string> names = titles(axes);
    names.push_back("runs");
    for (const Column& column : forces) names.push_back(column.title);
    std::string out = head(names);
    for (std::size_t row = 0; row < points.size(); ++row) {
        const auto& runs = points[row].runs;
        out += "<tr>" + cells(axes, row) + "<td>";
        // one link per run, numbered as in the row
        for (std::size_t k = 0; k < runs.size(); ++k)
            out +=
                (k > 0 ? " " : "") + link_to_run(sweep.runs[runs[k]], std::to_string(k + 1), page);
        out += "</td>" + cells(forces, row) + "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string work_table(const Sweep& sweep, const std::vector<Point>& points,
                       const report::ForceUnit& unit) {
    ICE_ASSERT(!points.empty());
    const auto axes = axis_columns(sweep, points, true), work = work_columns(sweep, points, unit);
    // runs of older programs have no energy ledger
    if (work.empty()) return "";
    std::vector<std::string> names = titles(axes);
    for (const Column& column : work) names.push_back(column.title);
    std::string out = head(names);
    for (std::size_t row = 0; row < points.size(); ++row)
        out += "<tr>" + cells(axes, row) + cells(work, row) + "</tr>\n";
    return out + "</tbody></table></div>\n";
}

std::string run_table(const Sweep& sweep, const report::ForceUnit& unit,
                      const std::filesystem::path& page) {
    std::string out =
        head({"Run", "Status", "Resistance \u00b1 95 % [" + unit.name + "]",
              "Friction [" + unit.name + "]", "Largest [" + unit.name + "]", "Unconverged steps",
              "Warnings", "Wall time [s]", "Mean affected by [%]"});
    for (const SweepRun& run : sweep.runs) {
        out += "<tr><td>" + link_to_run(run, run.name, page) + "</td><td><span class=\"status" +
               (run.summary ? "" : " bad") + "\">" + escape(run.status) + "</span></td>";
        if (const auto& s = run.summary)
            out += cell(with_interval(unit, {s->resistance.mean, s->resistance.ci95})) +
                   cell(unit.text(s->resistance.friction_mean)) +
                   cell(unit.text(s->resistance.max)) + cell(std::to_string(s->unconverged_steps)) +
                   cell(std::to_string(s->warnings.size())) + cell(readable(s->wall_s)) +
                   cell(readable(affected_percent(s->warnings)));
        else
            out += "<td colspan=\"7\" class=\"text\">" + escape(run.fault) + "</td>";
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string point_csv(const Sweep& sweep, const std::vector<Point>& points) {
    std::string out;
    for (const std::string& axis : sweep.axes) out += csv_text(axis) + ",";
    out += "runs";
    const char* in = force_ending(points.empty() ? 3 : points.front().dimension);
    for (const Part part : kParts) out += fmt::format(",{0}{1},{0}_ci95{1}", part_name(part), in);
    // Names state the unit, and all columns are always there: scripts find them in any sweep.
    // Lindqvist's submersion has a column also where no formula was evaluated.
    out += fmt::format(",largest{0},lindqvist_submersion{0}", in);
    const auto formulas = formula_columns(points);
    for (const FormulaValue& f : formulas)
        out += "," + csv_text(column_name(f.name + " " + f.part) + in);
    out += ",hold,affected_%";
    for (const Part part : kLevelIceParts)
        out += fmt::format(",{0}{1},{0}_ci95{1}", part_name(part), in);
    out +=
        ",crack_radius_m,crack_radius_per_length,crack_radius_per_thickness,opening_deg,"
        "channel_breadth_m\r\n";
    for (const Point& point : points) {
        for (const std::string& axis : sweep.axes) out += csv_text(point.at.at(axis).text) + ",";
        out += std::to_string(point.runs.size());
        for (const Part part : kParts)
            out +=
                "," + csv_number(point.part(part).mean) + "," + csv_number(point.part(part).half);
        out += "," + csv_number(point.largest) + "," + csv_number(point.lindqvist);
        for (const FormulaValue& f : formulas)
            out += "," + csv_number(point.formula(f.name, f.part));
        out += "," + csv_text(point.hold) + "," +
               csv_number(affected_percent(warnings_of(sweep, point)));
        for (const Part part : kLevelIceParts)
            out +=
                "," + csv_number(point.part(part).mean) + "," + csv_number(point.part(part).half);
        const CrackParticulars c = point.cracks.value_or(CrackParticulars{});
        for (const double value :
             {c.radius, c.per_length(), c.per_thickness(), c.opening_deg, c.channel_breadth})
            out += "," + csv_number(value);
        out += "\r\n";
    }
    return out;
}

std::string run_csv(const Sweep& sweep) {
    std::string out = "run,status";
    for (const std::string& axis : sweep.axes) out += "," + csv_text(axis);
    out += fmt::format(
        ",{0},resistance{1},ci95{1},contact{1},friction{1},largest{1},lindqvist_submersion{1},"
        "unconverged_steps,wall_s,hold,remark,affected_%\r\n",
        kSeedKey, force_ending(dimension_of(sweep)));
    for (const SweepRun& run : sweep.runs) {
        // The row of a failed run has its settings, so that a script can run it again.
        out += csv_text(run.name) + "," + run.status;
        for (const std::string& axis : sweep.axes) out += "," + csv_text(run.text(axis));
        out += "," + csv_text(run.text(kSeedKey));
        if (const auto& s = run.summary)
            out += "," + csv_number(s->resistance.mean) + "," + csv_number(s->resistance.ci95) +
                   "," + csv_number(s->resistance.contact_mean) + "," +
                   csv_number(s->resistance.friction_mean) + "," + csv_number(s->resistance.max) +
                   "," + csv_number(s->lindqvist_submersion.value_or(std::nan(""))) + "," +
                   std::to_string(s->unconverged_steps) + "," + csv_number(s->wall_s) + "," +
                   csv_text(release_rule(s->ice));
        else
            // as many commas as the numbers above have
            out += ",,,,,,,,,";
        out += "," + csv_text(run.fault) + "," +
               (run.summary ? csv_number(affected_percent(run.summary->warnings)) : "") + "\r\n";
    }
    return out;
}

std::string encode_address(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return out;
}

}  // namespace ice::sweep
