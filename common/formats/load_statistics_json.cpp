// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/load_statistics_json.hpp"

namespace ice {

namespace {

// endings of keys
constexpr const char* kForce = "N";
constexpr const char* kLineLoad = "N_per_m";

// text of summary.json's "panel_rule" and of every table of peaks: the meaning of the numbers
constexpr const char* kPeakRule =
    "largest window mean between two up-crossings of the mean of all windows";

double number(const Json& json, const std::string& key) {
    const Json& value = json.at(key);
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::array<double, 3> three(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 point(const Json& json, const std::string& key) {
    const auto v = json.at(key).get<std::array<double, 3>>();
    return {v[0], v[1], v[2]};
}

Json peaks_json(const PeakStatistics& peaks, const std::string& unit) {
    // The unit is part of each key's name, so that a file can be read without its documents.
    Json exceeded = Json::array();
    for (const Exceedance& e : peaks.exceeded)
        exceeded.push_back({{"level_" + unit, e.level}, {"per_hour", e.per_hour}});
    return {{"count", peaks.count},
            {"mean_" + unit, peaks.mean},
            {"p99_" + unit, peaks.p99},
            {"max_" + unit, peaks.max},
            {"exceeded", exceeded}};
}

PeakStatistics peaks_of(const Json& json, const std::string& unit) {
    PeakStatistics out;
    out.count = json.at("count").get<std::int64_t>();
    out.mean = number(json, "mean_" + unit);
    out.p99 = number(json, "p99_" + unit);
    out.max = number(json, "max_" + unit);
    for (const Json& e : json.at("exceeded"))
        out.exceeded.push_back({number(e, "level_" + unit), number(e, "per_hour")});
    return out;
}

}  // namespace

void add_peaks(const RegionStatistics& region, Json& out) {
    if (region.force_peaks) out["force_peaks"] = peaks_json(*region.force_peaks, kForce);
    if (region.line_load_peaks)
        out["line_load_peaks"] = peaks_json(*region.line_load_peaks, kLineLoad);
}

void read_peaks(const Json& region, RegionStatistics& out) {
    if (region.contains("force_peaks"))
        out.force_peaks = peaks_of(region.at("force_peaks"), kForce);
    if (region.contains("line_load_peaks"))
        out.line_load_peaks = peaks_of(region.at("line_load_peaks"), kLineLoad);
}

void add_panels(const PanelSummary& panels, Json& out) {
    // The file has loads per length and per area, as class rules and measurements have them; the
    // force in newtons depends on the size of a panel.
    out["panel_rule"] = {{"size_m", panels.size},
                         {"window_s", panels.window},
                         {"panels", panels.count},
                         {"touched", panels.touched},
                         {"peak", kPeakRule}};
    Json list = Json::array();
    for (const auto& [region, p] : panels.hardest)
        list.push_back({{"region", region},
                        {"center_m", three(p.center)},
                        {"normal", three(p.normal)},
                        {"area_m2", p.area},
                        {"length_m", p.length},
                        {"line_load_mean_N_per_m", p.mean / p.length},
                        {"line_load_p99_N_per_m", p.p99 / p.length},
                        {"line_load_max_N_per_m", p.max / p.length},
                        {"pressure_mean_Pa", p.mean / p.area},
                        {"pressure_p99_Pa", p.p99 / p.area},
                        {"pressure_max_Pa", p.max / p.area}});
    out["panels"] = list;
}

PanelSummary read_panels(const Json& summary) {
    PanelSummary out;
    if (!summary.contains("panels") || !summary.contains("panel_rule")) return out;
    const Json& rule = summary.at("panel_rule");
    out.size = number(rule, "size_m");
    out.window = number(rule, "window_s");
    out.count = rule.at("panels").get<std::int64_t>();
    out.touched = rule.at("touched").get<std::int64_t>();
    for (const Json& json : summary.at("panels")) {
        PanelLoad p;
        p.center = point(json, "center_m");
        p.normal = point(json, "normal");
        p.area = number(json, "area_m2");
        p.length = number(json, "length_m");
        // loads and pressures in the file, forces in memory: the panel's length turns one into
        // the other
        p.mean = number(json, "line_load_mean_N_per_m") * p.length;
        p.p99 = number(json, "line_load_p99_N_per_m") * p.length;
        p.max = number(json, "line_load_max_N_per_m") * p.length;
        out.hardest.emplace_back(json.at("region").get<std::string>(), p);
    }
    return out;
}

}  // namespace ice
