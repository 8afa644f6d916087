// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/summary_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/base/version.hpp"

namespace ice {

namespace {

// keeps the order of insertion, which is the order of the contract; dump() turns NaN into null
using Json = nlohmann::ordered_json;

constexpr const char* kSummarySchema = "icesolve-summary/1";
constexpr const char* kRemedy = "run the case again with icesolve";

Json force_json(const ForceStatistics& force) {
    return {{"mean_N", force.mean},
            {"contact_mean_N", force.contact_mean},
            {"friction_mean_N", force.friction_mean},
            {"std_N", force.std},
            {"max_N", force.max},
            {"ci95_N", force.ci95}};
}

Json regions_json(const std::map<std::string, RegionStatistics>& regions) {
    Json out = Json::object();
    for (const auto& [name, region] : regions)
        out[name] = {{"hits", region.hits},
                     {"max_impulse_Ns", region.max_impulse},
                     {"mean_N", region.mean},
                     {"contact_mean_N", region.contact_mean},
                     {"friction_mean_N", region.friction_mean}};
    return out;
}

void add_origin(Json& json) {
    json["version"] = version();
    json["git_commit"] = git_commit();
    json["compiler"] = compiler();
}

// texts from file names and meshes may be no UTF-8: replaced, because JSON must be
std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json parse_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw bad_input(path.string(), "file not found or not readable", "check the path");
    try {
        return Json::parse(in);
    } catch (const Json::exception& error) {
        throw bad_input(path.string(), std::string("is not valid JSON: ") + error.what(),
                        "make it again with the tool that wrote it");
    }
}

// Reads values by dotted key and names the key in every complaint.
class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : path_(path), json_(parse_file(path)) {}

    template <class T>
    T get(const std::string& key) const {
        const Json* at = &json_;
        for (std::size_t begin = 0; begin <= key.size();) {
            const std::size_t end = std::min(key.find('.', begin), key.size());
            at = &child(*at, key.substr(begin, end - begin), key);
            begin = end + 1;
        }
        return convert<T>(*at, key);
    }

    // a number, or NaN where the file has null
    double number(const std::string& key) const {
        return get<std::optional<double>>(key).value_or(std::numeric_limits<double>::quiet_NaN());
    }

    ForceStatistics force(const std::string& key) const {
        return {number(key + ".mean_N"),          number(key + ".contact_mean_N"),
                number(key + ".friction_mean_N"), number(key + ".std_N"),
                number(key + ".max_N"),           number(key + ".ci95_N")};
    }

    std::map<std::string, RegionStatistics> regions() const {
        std::map<std::string, RegionStatistics> out;
        for (const auto& [name, region] : child(json_, "regions", "regions").items()) {
            const std::string key = "regions." + name;
            RegionStatistics& row = out[name];
            row.hits = convert<std::int64_t>(child(region, "hits", key), key);
            row.max_impulse = value_or_nan(child(region, "max_impulse_Ns", key), key);
            row.mean = vector(child(region, "mean_N", key), key + ".mean_N");
            // files from before the split have the sum alone
            const Json unknown = Json::array({nullptr, nullptr, nullptr});
            row.contact_mean = vector(region.value("contact_mean_N", unknown), key);
            row.friction_mean = vector(region.value("friction_mean_N", unknown), key);
        }
        return out;
    }

    std::map<std::string, double> numbers(const std::string& key) const {
        std::map<std::string, double> out;
        if (!json_.contains(key)) return out;
        for (const auto& [name, value] : json_[key].items())
            out[name] = value_or_nan(value, key + "." + name);
        return out;
    }

    bool has(const std::string& key) const { return json_.contains(key); }

    Error fault(const std::string& key, const std::string& what) const {
        return bad_input(path_.string() + ": " + key, what, kRemedy);
    }

private:
    const Json& child(const Json& parent, const std::string& name, const std::string& key) const {
        if (!parent.is_object() || !parent.contains(name)) throw fault(key, "is missing");
        return parent[name];
    }

    std::array<double, 3> vector(const Json& json, const std::string& key) const {
        if (json.size() != 3) throw fault(key, "has not 3 elements");
        std::array<double, 3> out{};
        for (std::size_t k = 0; k < 3; ++k) out[k] = value_or_nan(json[k], key);
        return out;
    }

    double value_or_nan(const Json& json, const std::string& key) const {
        return convert<std::optional<double>>(json, key).value_or(
            std::numeric_limits<double>::quiet_NaN());
    }

    template <class T>
    T convert(const Json& json, const std::string& key) const {
        try {
            if constexpr (std::is_same_v<T, std::optional<double>>) {
                if (json.is_null()) return std::nullopt;
                return json.get<double>();
            } else {
                return json.get<T>();
            }
        } catch (const Json::exception&) {
            throw fault(key, "has the wrong type");
        }
    }

    std::filesystem::path path_;
    Json json_;
};

void collect_numbers(const Json& json, const std::string& key, std::map<std::string, double>& out) {
    if (json.is_number()) out[key] = json.get<double>();
    if (json.is_null()) out[key] = std::numeric_limits<double>::quiet_NaN();
    if (!json.is_structured()) return;
    for (const auto& [name, value] : json.items())  // an array's items are named 0, 1, ...
        collect_numbers(value, key.empty() ? name : key + "." + name, out);
}

}  // namespace

std::string summary_text(const Summary& s) {
    Json json;
    json["schema"] = kSummarySchema;
    json["status"] = s.status;
    json["title"] = s.title;
    json["case_file"] = s.case_file;
    json["command_line"] = s.command_line;
    json["dimension"] = s.dimension;
    json["steps"] = s.steps;
    json["simulated_s"] = s.simulated_s;
    json["average_from_s"] = s.average_from;
    json["wall_s"] = s.wall_s;
    json["realtime_factor"] = s.simulated_s / s.wall_s;
    json["stage_seconds"] = s.stage_seconds;
    json["threads"] = s.threads;
    json["simd"] = s.simd;
    json["state_hash"] = fmt::format("{:016x}", s.state_hash);
    json["spheres"] = {{"hull", s.hull_spheres}, {"ice", s.ice_spheres}};
    json["floes"] = {
        {"total", s.floes_total}, {"moved", s.floes_moved}, {"behind", s.floes_behind}};
    json["resistance"] = force_json(s.resistance);
    json["lateral"] = force_json(s.lateral);
    json["vertical"] = force_json(s.vertical);
    json["regions"] = regions_json(s.regions);
    json["contacts"] = {{"mean", s.contacts_mean},
                        {"max", s.contacts_max},
                        {"max_overlap_m", s.max_overlap},
                        {"unconverged_steps", s.unconverged_steps}};
    json["energy"] = s.energy;
    if (!s.imbalance.empty()) json["imbalance"] = s.imbalance;
    json["lindqvist_submersion_N"] =
        s.lindqvist_submersion ? Json(*s.lindqvist_submersion) : Json(nullptr);
    json["warnings"] = s.warnings;
    add_origin(json);
    return dump(json);
}

Summary read_summary(const std::filesystem::path& path) {
    const Reader in(path);
    Summary s;
    if (in.get<std::string>("schema") != kSummarySchema)
        throw in.fault("schema", std::string("is not ") + kSummarySchema);
    s.status = in.get<std::string>("status");
    s.title = in.get<std::string>("title");
    if (in.has("case_file")) s.case_file = in.get<std::string>("case_file");
    if (in.has("command_line")) s.command_line = in.get<std::string>("command_line");
    if (in.has("dimension")) s.dimension = in.get<int>("dimension");
    s.steps = in.get<std::int64_t>("steps");
    s.simulated_s = in.number("simulated_s");
    if (in.has("average_from_s")) s.average_from = in.number("average_from_s");
    s.wall_s = in.number("wall_s");
    s.stage_seconds = in.numbers("stage_seconds");
    s.threads = in.get<int>("threads");
    s.simd = in.get<std::string>("simd");
    s.state_hash = std::strtoull(in.get<std::string>("state_hash").c_str(), nullptr, 16);
    s.hull_spheres = in.get<std::int64_t>("spheres.hull");
    s.ice_spheres = in.get<std::int64_t>("spheres.ice");
    s.floes_total = in.get<std::int64_t>("floes.total");
    s.floes_moved = in.get<std::int64_t>("floes.moved");
    s.floes_behind = in.get<std::int64_t>("floes.behind");
    s.resistance = in.force("resistance");
    s.lateral = in.force("lateral");
    s.vertical = in.force("vertical");
    s.regions = in.regions();
    s.contacts_mean = in.number("contacts.mean");
    s.contacts_max = in.number("contacts.max");
    s.max_overlap = in.number("contacts.max_overlap_m");
    s.unconverged_steps = in.get<std::int64_t>("contacts.unconverged_steps");
    s.energy = in.numbers("energy");
    s.imbalance = in.numbers("imbalance");
    s.lindqvist_submersion = in.get<std::optional<double>>("lindqvist_submersion_N");
    s.warnings = in.get<std::vector<std::string>>("warnings");
    return s;
}

std::map<std::string, double> read_json_numbers(const std::filesystem::path& path) {
    std::map<std::string, double> out;
    collect_numbers(parse_file(path), "", out);
    return out;
}

std::string spheres_report_text(const SpheresReport& r) {
    Json json;
    json["schema"] = "spherize/1";
    json["dimension"] = r.dimension;
    json["radius_m"] = r.radius;
    json["spacing_m"] = r.spacing;
    json["spheres"] = r.spheres;
    json["surface_spheres"] = r.surface_spheres;
    json["volume_m3"] = r.volume;
    json["area_m2"] = r.area;
    json["centroid_m"] = r.centroid;
    json["inertia_unit_density"] = r.inertia_unit_density;
    json["protrusion_max_m"] = r.protrusion_max;
    json["covering_radius_m"] = r.covering_radius;
    json["gap_p50_m"] = r.gap_p50;
    json["gap_p99_m"] = r.gap_p99;
    json["gap_max_m"] = r.gap_max;
    json["normal_error_mean_deg"] = r.normal_error_mean_deg;
    json["normal_error_p99_deg"] = r.normal_error_p99_deg;
    json["thin_features"] = Json::array();
    for (const ThinFeature& thin : r.thin_features)
        json["thin_features"].push_back({{"at_m", thin.at}, {"size_m", thin.size}});
    json["repairs"] = Json::array();
    for (const auto& [step, count] : r.repairs)
        json["repairs"].push_back({{"step", step}, {"count", count}});
    json["guessed"] = r.guessed;
    json["warnings"] = r.warnings;
    json["seconds"] = r.seconds;
    json["source_mesh"] = r.source_mesh;
    json["command_line"] = r.command_line;
    add_origin(json);
    return dump(json);
}

}  // namespace ice
