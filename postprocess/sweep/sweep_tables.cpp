// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/share_work.hpp"
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
constexpr std::pair<Part, const char*> kColumns[] = {
    {Part::bow, "Bow"},         {Part::bow_friction, "Of it friction"},
    {Part::sides, "Sides"},     {Part::sides_friction, "Of it friction"},
    {Part::bottom, "Bottom"},   {Part::bottom_friction, "Of it friction"},
    {Part::rest, "Rest"},       {Part::rest_friction, "Of it friction"},
    {Part::contact, "Contact"}, {Part::friction, "Friction"}};

std::string head(const std::vector<std::string>& names) {
    std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string& name : names) out += "<th scope=\"col\">" + escape(name) + "</th>";
    return out + "</tr></thead>\n<tbody>\n";
}

std::string cell(const std::string& text) { return "<td>" + escape(text) + "</td>"; }

// a link to the run's report, or to its folder where it has none
std::string link(const SweepRun& run, const std::string& text, const std::filesystem::path& page) {
    namespace fs = std::filesystem;
    const fs::path report = run.folder / "report.html";
    const fs::path target = fs::exists(report) ? report : run.folder;
    if (!fs::exists(target)) return escape(text);
    std::error_code error;
    const fs::path from = fs::absolute(page).parent_path();
    const std::string address = fs::absolute(target).lexically_relative(from).generic_string();
    return "<a href=\"" + encode_address(address) + "\">" + escape(text) + "</a>";
}

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

}  // namespace

std::string with_interval(const report::ForceUnit& unit, const Estimate& e) {
    if (!std::isfinite(e.half)) return unit.text(e.mean);
    return unit.text(e.mean) + " \u00b1 " + unit.text(e.half);
}

std::string point_table(const Sweep& sweep, const std::vector<Point>& points,
                        const report::ForceUnit& unit, const std::filesystem::path& page) {
    std::vector<std::string> names;
    for (const std::string& axis : sweep.axes) names.push_back(axis_title(axis));
    names.insert(names.end(), {"Runs", "Resistance \u00b1 95 % [" + unit.name + "]"});
    for (const auto& [part, title] : kColumns) names.push_back(title);
    names.push_back("Lindqvist");
    std::string out = head(names);
    for (const Point& point : points) {
        out += "<tr>";
        for (const std::string& axis : sweep.axes) out += cell(short_text(point.at.at(axis)));
        out += "<td>";
        for (std::size_t k = 0; k < point.runs.size(); ++k)
            out +=
                (k > 0 ? " " : "") + link(sweep.runs[point.runs[k]], std::to_string(k + 1), page);
        out += "</td>" + cell(with_interval(unit, point.part(Part::total)));
        for (const auto& [part, title] : kColumns)
            out += cell(with_interval(unit, point.part(part)));
        out += cell(std::isfinite(point.lindqvist) ? unit.text(point.lindqvist) : "-") + "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string work_table(const Sweep& sweep, const std::vector<Point>& points,
                       const report::ForceUnit& unit) {
    std::vector<std::string> names;
    for (const std::string& axis : sweep.axes) names.push_back(axis_title(axis));
    for (const auto& [title, force] : share_work(sweep, points.front())) names.push_back(title);
    std::string out = head(names);
    for (const Point& point : points) {
        out += "<tr>";
        for (const std::string& axis : sweep.axes) out += cell(short_text(point.at.at(axis)));
        for (const auto& [title, force] : share_work(sweep, point)) out += cell(unit.text(force));
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string run_table(const Sweep& sweep, const report::ForceUnit& unit,
                      const std::filesystem::path& page) {
    std::string out = head({"Run", "Status", "Resistance \u00b1 95 % [" + unit.name + "]",
                            "Friction", "Unconverged steps", "Warnings", "Wall time [s]"});
    for (const SweepRun& run : sweep.runs) {
        out += "<tr><td>" + link(run, run.name, page) + "</td><td><span class=\"status" +
               (run.summary ? "" : " bad") + "\">" + escape(run.status) + "</span></td>";
        if (const auto& s = run.summary)
            out += cell(with_interval(unit, {s->resistance.mean, s->resistance.ci95})) +
                   cell(unit.text(s->resistance.friction_mean)) +
                   cell(std::to_string(s->unconverged_steps)) +
                   cell(std::to_string(s->warnings.size())) + cell(readable(s->wall_s));
        else
            out += "<td colspan=\"5\" style=\"text-align:left;white-space:normal\">" +
                   escape(run.fault) + "</td>";
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string point_csv(const Sweep& sweep, const std::vector<Point>& points) {
    std::string out;
    for (const std::string& axis : sweep.axes) out += csv_text(axis) + ",";
    out += "runs";
    for (const Part part : kParts) out += fmt::format(",{0}_N,{0}_ci95_N", part_name(part));
    out += ",lindqvist_submersion_N\r\n";
    for (const Point& point : points) {
        for (const std::string& axis : sweep.axes) out += csv_text(point.at.at(axis).text) + ",";
        out += std::to_string(point.runs.size());
        for (const Part part : kParts)
            out +=
                "," + csv_number(point.part(part).mean) + "," + csv_number(point.part(part).half);
        out += "," + csv_number(point.lindqvist) + "\r\n";
    }
    return out;
}

std::string run_csv(const Sweep& sweep) {
    std::string out = "run,status";
    for (const std::string& axis : sweep.axes) out += "," + csv_text(axis);
    out += std::string(",") + kSeedKey +
           ",resistance_N,ci95_N,contact_N,friction_N,lindqvist_submersion_N,unconverged_steps,"
           "wall_s,remark\r\n";
    for (const SweepRun& run : sweep.runs) {
        out += csv_text(run.name) + "," + run.status;
        for (const std::string& axis : sweep.axes) out += "," + csv_text(run.text(axis));
        out += "," + csv_text(run.text(kSeedKey));
        if (const auto& s = run.summary)
            out += "," + csv_number(s->resistance.mean) + "," + csv_number(s->resistance.ci95) +
                   "," + csv_number(s->resistance.contact_mean) + "," +
                   csv_number(s->resistance.friction_mean) + "," +
                   csv_number(s->lindqvist_submersion.value_or(std::nan(""))) + "," +
                   std::to_string(s->unconverged_steps) + "," + csv_number(s->wall_s);
        else
            out += ",,,,,,,";
        out += "," + csv_text(run.fault) + "\r\n";
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
