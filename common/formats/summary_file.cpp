// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/summary_file.hpp"

#include <fmt/format.h>

#include "common/formats/json_file.hpp"
#include "common/formats/load_statistics_json.hpp"
#include "common/formats/particulars_json.hpp"

namespace ice {

namespace {

constexpr const char* kSummarySchema = "icesolve-summary/1";

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json force_json(const ForceStatistics& force) {
    // A number that is not known is NaN here and null in the file (JsonReader turns it back).
    Json out{{"mean_N", force.mean},
             {"contact_mean_N", force.contact_mean},
             {"friction_mean_N", force.friction_mean},
             {"std_N", force.std},
             {"max_N", force.max},
             {"ci95_N", force.ci95},
             {"correlation_time_s", force.correlation_time},
             {"effective_samples", force.effective_samples},
             {"trend_N", force.trend},
             {"trend_significant", or_null(force.trend_significant)}};
    if (force.breaking_mean) out["breaking_mean_N"] = *force.breaking_mean;
    if (force.submersion_mean) out["submersion_mean_N"] = *force.submersion_mean;
    return out;
}

Json regions_json(const std::map<std::string, RegionStatistics>& regions) {
    Json out = Json::object();
    for (const auto& [name, region] : regions) {
        // a key per region: names are those of the mesh and may be any text
        out[name] = {{"hits", region.hits},
                     {"max_impulse_Ns", region.max_impulse},
                     {"mean_N", region.mean},
                     {"contact_mean_N", region.contact_mean},
                     {"friction_mean_N", region.friction_mean}};
        add_peaks(region, out[name]);
    }
    return out;
}

Json ensemble_json(const Ensemble& e) {
    return {{"members", e.means.size()},
            {"mean_N", e.mean},
            {"ci95_N", e.ci95},
            {"means_N", e.means},
            {"seeds", e.seeds}};
}

Json warnings_json(const std::vector<Warning>& warnings) {
    Json out = Json::array();
    for (const Warning& w : warnings)
        out.push_back({{"text", w.text},
                       {"affects_mean", or_null(w.affects_mean)},
                       {"share", or_null(w.share)}});
    return out;
}

// Ending of a key whose value is per metre of breadth.
constexpr std::string_view kPerMetre = "_per_m";

// In 2D forces, impulses and energies are per metre of breadth; a twin of each key names the unit.
void add_names_per_metre(Json& json) {
    if (!json.is_structured()) return;
    // Collected first: an object must not grow while it is walked through.
    std::vector<std::pair<std::string, Json>> twins;
    for (auto& [key, value] : json.items()) {
        const bool newtons = key.ends_with("_N") || key.ends_with("_Ns") || key.ends_with("_J");
        // a list's items have no names; those inside them may
        if (newtons && json.is_object())
            twins.emplace_back(key + std::string(kPerMetre), value);
        else
            add_names_per_metre(value);
    }
    for (auto& [key, value] : twins) json[key] = std::move(value);
}

ForceStatistics read_force(const JsonReader& in, const std::string& key) {
    // These six were in the first version of the file and are required.
    ForceStatistics out{in.number(key + ".mean_N"),          in.number(key + ".contact_mean_N"),
                        in.number(key + ".friction_mean_N"), in.number(key + ".std_N"),
                        in.number(key + ".max_N"),           in.number(key + ".ci95_N")};
    // files of version 0.1 end here
    out.correlation_time = in.number_if_there(key, "correlation_time_s");
    out.effective_samples = in.number_if_there(key, "effective_samples");
    out.trend = in.number_if_there(key, "trend_N");
    const Json& force = in.at(key);
    if (force.contains("trend_significant"))
        out.trend_significant = in.convert<std::optional<bool>>(force["trend_significant"], key);
    for (auto [name, part] : {std::pair{"breaking_mean_N", &out.breaking_mean},
                              std::pair{"submersion_mean_N", &out.submersion_mean}})
        if (force.contains(name))
            *part = in.convert<std::optional<double>>(force[name], key + "." + name);
    return out;
}

// a fault that the JSON library finds, as an error that names the file
template <class Work>
void guarded(const JsonReader& in, const std::string& key, const Work& work) {
    try {
        work();
    } catch (const Json::exception&) {
        throw in.fault(key, "has a missing key or the wrong type");
    }
}

std::map<std::string, RegionStatistics> read_regions(const JsonReader& in) {
    std::map<std::string, RegionStatistics> out;
    for (const auto& [name, region] : in.at("regions").items()) {
        const std::string key = "regions." + name;
        RegionStatistics& row = out[name];
        row.hits = in.convert<std::int64_t>(in.child(region, "hits", key), key);
        row.max_impulse = in.value_or_nan(in.child(region, "max_impulse_Ns", key), key);
        row.mean = in.vector(in.child(region, "mean_N", key), key + ".mean_N");
        // files from before the split have the sum alone
        const Json unknown = Json::array({nullptr, nullptr, nullptr});
        row.contact_mean = in.vector(region.value("contact_mean_N", unknown), key);
        row.friction_mean = in.vector(region.value("friction_mean_N", unknown), key);
        guarded(in, key, [&, &from = region] { read_peaks(from, row); });
    }
    return out;
}

// energies without their twins per metre
std::map<std::string, double> read_energy(const JsonReader& in) {
    // Twins repeat the same numbers in 2D and would count an entry twice.
    auto energy = in.numbers("energy");
    std::erase_if(energy, [](const auto& entry) { return entry.first.ends_with(kPerMetre); });
    return energy;
}

std::vector<Warning> read_warnings(const JsonReader& in) {
    std::vector<Warning> out;
    for (const Json& w : in.at("warnings")) {
        const std::string key = "warnings";
        if (w.is_string()) {  // of version 0.1
            out.push_back({w.get<std::string>()});
            continue;
        }
        out.push_back({in.convert<std::string>(in.child(w, "text", key), key + ".text"),
                       in.convert<std::optional<bool>>(in.child(w, "affects_mean", key), key),
                       in.convert<std::optional<double>>(w.value("share", Json()), key)});
    }
    return out;
}

std::optional<Ensemble> read_ensemble(const JsonReader& in) {
    if (!in.has("ensemble")) return std::nullopt;
    Ensemble out{in.number("ensemble.mean_N"),
                 in.number("ensemble.ci95_N"),
                 {},
                 in.get<std::vector<std::int64_t>>("ensemble.seeds")};
    for (const Json& mean : in.at("ensemble.means_N"))
        out.means.push_back(in.value_or_nan(mean, "ensemble.means_N"));
    return out;
}

void collect_numbers(const Json& json, const std::string& key, std::map<std::string, double>& out) {
    // null is NaN and not left out: a check can then tell "unknown" from a misspelt key
    if (json.is_number()) out[key] = json.get<double>();
    if (json.is_null()) out[key] = std::numeric_limits<double>::quiet_NaN();
    if (!json.is_structured()) return;
    for (const auto& [name, value] : json.items())  // an array's items are named 0, 1, ...
        collect_numbers(value, key.empty() ? name : key + "." + name, out);
}

}  // namespace

std::string summary_text(const Summary& s) {
    Json json;
    // The order here is the order in the file: origin, run, scene, forces, checks.
    // docs/contract.md, section 5, has the meaning of each key.
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
    json["ship"] = s.ship;
    json["ice"] = s.ice;
    if (s.cracks) json["level_ice"] = *s.cracks;
    json["travel"] = s.travel;
    json["resistance"] = force_json(s.resistance);
    json["lateral"] = force_json(s.lateral);
    json["vertical"] = force_json(s.vertical);
    json["regions"] = regions_json(s.regions);
    if (s.panels.size > 0.0) add_panels(s.panels, json);
    json["contacts"] = {{"mean", s.contacts_mean},
                        {"max", s.contacts_max},
                        {"max_overlap_m", s.max_overlap},
                        {"unseen_overlap_m", s.unseen_overlap},
                        {"unconverged_steps", s.unconverged_steps},
                        {"residual_share", s.residual_share}};
    json["energy"] = s.energy;
    if (!s.imbalance.empty()) json["imbalance"] = s.imbalance;
    json["lindqvist_submersion_N"] = or_null(s.lindqvist_submersion);
    json["formulas"] = s.formulas;
    if (s.flow)
        json["flow"] = {
            {"model", s.flow->model}, {"panels", s.flow->panels}, {"residual", s.flow->residual}};
    if (s.ensemble) json["ensemble"] = ensemble_json(*s.ensemble);
    json["warnings"] = warnings_json(s.warnings);
    // Twins are added last: they are made of all keys that end in a unit of force or energy.
    if (s.dimension == 2) add_names_per_metre(json);
    add_origin(json);
    return json_text(json);
}

Summary read_summary(const std::filesystem::path& path) {
    const JsonReader in(path, "run the case again with icesolve");
    Summary s;
    // before any other key: the summary of another program is named as such
    if (in.get<std::string>("schema") != kSummarySchema)
        throw in.fault("schema", std::string("is not ") + kSummarySchema);
    s.status = in.get<std::string>("status");
    s.title = in.get<std::string>("title");
    // Keys that `has` guards came later than the format: a run of an older program lacks them and
    // is still readable.
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
    // As hexadecimal text: JSON readers keep 53 bits of a number.
    s.state_hash = std::strtoull(in.get<std::string>("state_hash").c_str(), nullptr, 16);
    s.hull_spheres = in.get<std::int64_t>("spheres.hull");
    s.ice_spheres = in.get<std::int64_t>("spheres.ice");
    s.floes_total = in.get<std::int64_t>("floes.total");
    s.floes_moved = in.get<std::int64_t>("floes.moved");
    s.floes_behind = in.get<std::int64_t>("floes.behind");
    if (in.has("ship")) s.ship = in.get<ShipParticulars>("ship");
    if (in.has("ice")) s.ice = in.get<IceParticulars>("ice");
    if (in.has("level_ice")) s.cracks = in.get<CrackParticulars>("level_ice");
    if (in.has("travel")) s.travel = in.get<TravelParticulars>("travel");
    s.resistance = read_force(in, "resistance");
    s.lateral = read_force(in, "lateral");
    s.vertical = read_force(in, "vertical");
    s.regions = read_regions(in);
    guarded(in, "panels", [&] { s.panels = read_panels(in.whole()); });
    s.contacts_mean = in.number("contacts.mean");
    s.contacts_max = in.number("contacts.max");
    s.max_overlap = in.number("contacts.max_overlap_m");
    s.unseen_overlap = in.number_if_there("contacts", "unseen_overlap_m");
    s.unconverged_steps = in.get<std::int64_t>("contacts.unconverged_steps");
    s.residual_share = in.number_if_there("contacts", "residual_share");
    s.energy = read_energy(in);
    s.imbalance = in.numbers("imbalance");
    s.lindqvist_submersion = in.get<std::optional<double>>("lindqvist_submersion_N");
    if (in.has("formulas")) s.formulas = in.get<std::vector<FormulaValue>>("formulas");
    if (in.has("flow"))
        s.flow = FlowSummary{in.get<std::string>("flow.model"), in.get<std::int64_t>("flow.panels"),
                             in.number("flow.residual")};
    s.ensemble = read_ensemble(in);
    s.warnings = read_warnings(in);
    return s;
}

std::map<std::string, double> read_json_numbers(const std::filesystem::path& path) {
    std::map<std::string, double> out;
    collect_numbers(parse_json_file(path), "", out);
    return out;
}

}  // namespace ice
