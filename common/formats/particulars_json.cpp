// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/particulars_json.hpp"

#include <cmath>
#include <set>

namespace ice {

namespace {

// A key that is missing or null leaves the default, "not known": files of older programs
// have fewer keys, and NaN is null in JSON.
template <class T>
void take(const Json& json, const char* key, T& value) {
    if (json.contains(key) && !json[key].is_null()) json[key].get_to(value);
}

}  // namespace

void to_json(Json& json, const ShipParticulars& s) {
    json = {{"length_m", s.length},
            {"breadth_m", s.breadth},
            {"draught_m", s.draught},
            {"displacement_kg", s.displacement},
            {"stem_angle_deg", s.stem_angle_deg},
            {"entrance_angle_deg", s.entrance_angle_deg},
            {"parallel_length_m", s.parallel_length},
            {"bow_length_m", s.bow_length},
            {"speed_mean", s.speed_mean}};
    // The motions that are free decide which keys a ship has; they follow those of the hull.
    for (const auto& [key, value] : s.motion) json[key] = value;
    if (s.stuck) json["stuck"] = *s.stuck;
}

void from_json(const Json& json, ShipParticulars& s) {
    take(json, "length_m", s.length);
    take(json, "breadth_m", s.breadth);
    take(json, "draught_m", s.draught);
    take(json, "displacement_kg", s.displacement);
    take(json, "stem_angle_deg", s.stem_angle_deg);
    take(json, "entrance_angle_deg", s.entrance_angle_deg);
    take(json, "parallel_length_m", s.parallel_length);
    take(json, "bow_length_m", s.bow_length);
    take(json, "speed_mean", s.speed_mean);
    // the keys above: all of them, or a hull's number would appear among the motions
    const std::set<std::string> of_hull{
        "length_m",        "breadth_m",         "draught_m",
        "displacement_kg", "stem_angle_deg",    "entrance_angle_deg",
        "speed_mean",      "parallel_length_m", "bow_length_m"};
    // every other number is of a ship's motion, whatever its name
    for (const auto& [key, value] : json.items()) {
        if (of_hull.contains(key)) continue;
        if (value.is_boolean() && key == "stuck") s.stuck = value.get<bool>();
        if (value.is_number()) s.motion.emplace_back(key, value.get<double>());
        if (value.is_null()) s.motion.emplace_back(key, kUnknown);
    }
}

void to_json(Json& json, const IceParticulars& i) {
    // Unknown numbers are NaN in memory and null in the file; from_json() turns them back.
    json = {{"thickness_m", i.thickness},
            {"floes", i.floes},
            {"floe_size_min_m", i.floe_size_min},
            {"floe_size_mean_m", i.floe_size_mean},
            {"floe_size_max_m", i.floe_size_max},
            {"concentration", i.concentration},
            {"density_kg_per_m3", i.density},
            {"friction_ship_ice", i.friction_ship_ice},
            {"friction_ice_ice", i.friction_ice_ice},
            {"crushing_pressure_Pa", i.crushing_pressure},
            {"hold", i.hold},
            {"water_density_kg_per_m3", i.water_density},
            {"gravity_m_per_s2", i.gravity},
            {"flexural_strength_Pa", i.flexural_strength},
            {"elastic_modulus_Pa", i.elastic_modulus},
            {"poisson_ratio", i.poisson_ratio}};
    // of level ice that breaks
    if (!i.bending_model.empty()) json["bending_model"] = i.bending_model;
    if (std::isfinite(i.bending_factor)) json["bending_factor"] = i.bending_factor;
}

void from_json(const Json& json, IceParticulars& i) {
    // Keys that a file lacks, as one of an older program, leave their members as they are.
    take(json, "thickness_m", i.thickness);
    take(json, "floes", i.floes);
    take(json, "floe_size_min_m", i.floe_size_min);
    take(json, "floe_size_mean_m", i.floe_size_mean);
    take(json, "floe_size_max_m", i.floe_size_max);
    take(json, "concentration", i.concentration);
    take(json, "density_kg_per_m3", i.density);
    take(json, "friction_ship_ice", i.friction_ship_ice);
    take(json, "friction_ice_ice", i.friction_ice_ice);
    take(json, "crushing_pressure_Pa", i.crushing_pressure);
    take(json, "hold", i.hold);
    take(json, "water_density_kg_per_m3", i.water_density);
    take(json, "gravity_m_per_s2", i.gravity);
    take(json, "flexural_strength_Pa", i.flexural_strength);
    take(json, "elastic_modulus_Pa", i.elastic_modulus);
    take(json, "poisson_ratio", i.poisson_ratio);
    take(json, "bending_model", i.bending_model);
    take(json, "bending_factor", i.bending_factor);
}

void to_json(Json& json, const CrackParticulars& c) {
    json = {{"pieces", c.pieces},
            {"crack_radius_m", c.radius},
            {"characteristic_length_m", c.characteristic_length},
            {"thickness_m", c.thickness},
            {"crack_radius_per_length", c.per_length()},
            {"crack_radius_per_thickness", c.per_thickness()},
            {"opening_deg", c.opening_deg},
            {"breaking_load_N", c.load},
            {"channel_breadth_m", c.channel_breadth}};
}

void from_json(const Json& json, CrackParticulars& c) {
    take(json, "pieces", c.pieces);
    take(json, "crack_radius_m", c.radius);
    take(json, "characteristic_length_m", c.characteristic_length);
    take(json, "thickness_m", c.thickness);
    take(json, "opening_deg", c.opening_deg);
    take(json, "breaking_load_N", c.load);
    take(json, "channel_breadth_m", c.channel_breadth);
}

void to_json(Json& json, const TravelParticulars& t) {
    json = {{"distance_m", t.distance},
            {"lengths", t.lengths},
            {"averaged_lengths", t.averaged_lengths}};
}

void from_json(const Json& json, TravelParticulars& t) {
    take(json, "distance_m", t.distance);
    take(json, "lengths", t.lengths);
    take(json, "averaged_lengths", t.averaged_lengths);
}

void to_json(Json& json, const FormulaValue& f) {
    json = {{"name", f.name}, {"part", f.part}, {"value_N", f.value}, {"verified", f.verified}};
}

void from_json(const Json& json, FormulaValue& f) {
    take(json, "name", f.name);
    take(json, "part", f.part);
    take(json, "value_N", f.value);
    take(json, "verified", f.verified);
}

}  // namespace ice
