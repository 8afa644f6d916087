// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/field_schema.hpp"

#include <numbers>

namespace ice {

namespace {

// Bounds of lengths [m] in a specification: a micrometre and 1000 km. Beyond them a unit is wrong.
// A wider range lets wrong units pass.
constexpr double kTiny = 1e-6;
constexpr double kFar = 1e6;

double number(const Value& v) { return std::get<double>(v); }
const std::string& text(const Value& v) { return std::get<std::string>(v); }
std::array<double, 2> pair(const Value& v) {
    const auto& x = std::get<std::vector<double>>(v);
    return {x[0], x[1]};
}

// In the order of FieldPattern: the number of bars before a name is its value.
constexpr std::string_view kPatterns = "grid|brick|cusps|voronoi|power-law|polygons";

using D = Dimension;
using S = FieldSpec;

FieldPattern pattern_of(const std::string& name) {
    const auto at = kPatterns.find(name);
    return static_cast<FieldPattern>(
        std::count(kPatterns.begin(), kPatterns.begin() + static_cast<std::ptrdiff_t>(at), '|'));
}

// Each key: path, kind, dimension, default ("" required, "-" none), bounds in SI, length of a list,
// choices, text of --explain, and the member that takes the value. All in one row, so that a key
// cannot have bounds without a text, or be read without a place. Rows are in the order of the help.
std::vector<FieldKey> common_keys() {
    return {
        {"title", Kind::text, D::none, "\"\"", 0, 0, 0, "", "Title of the field.",
         [](S& s, const Value& v) { s.title = text(v); }},
        {"pattern", Kind::choice, D::none, "", 0, 0, 0, kPatterns, "How the floes are made.",
         [](S& s, const Value& v) { s.pattern = pattern_of(text(v)); }},
        {"seed", Kind::integer, D::none, "0", 0, 2e9, 0, "",
         "Seed of the random patterns: cusps, voronoi and power-law.",
         [](S& s, const Value& v) { s.seed = std::get<std::int64_t>(v); }},
        {"ice.thickness", Kind::number, D::length, "", kTiny, 100, 0, "", "Thickness of the ice.",
         [](S& s, const Value& v) { s.thickness = number(v); }},
        {"ice.chamfer", Kind::number, D::length, "0.0", 0, 50, 0, "",
         "Width by which upper and lower edges of the floes are cut off, at 45 degrees.",
         [](S& s, const Value& v) { s.chamfer = number(v); }},
        {"spheres.radius", Kind::number, D::length, "-", kTiny, 50, 0, "",
         "Radius of the contact spheres; default a quarter of the thickness.",
         [](S& s, const Value& v) { s.radius = number(v); }},
        {"spheres.spacing", Kind::number, D::length, "-", kTiny, 100, 0, "",
         "Distance of the spheres' centres on the surface; default twice the radius.",
         [](S& s, const Value& v) { s.spacing = number(v); }},
        {"spheres.mode", Kind::choice, D::none, "\"surface\"", 0, 0, 0, "surface|fill",
         "surface, or fill: spheres inside as well, with shares of the volume but no contacts.",
         [](S& s, const Value& v) { s.surface_only = text(v) == "surface"; }},
        {"area.origin", Kind::vector, D::length, "[0.0, 0.0]", -kFar, kFar, 2, "",
         "x of the field's edge that meets the ship first (its smallest x), y of its centre line; "
         "polygons: moves them.",
         [](S& s, const Value& v) { s.origin = pair(v); }},
        {"area.size", Kind::vector, D::length, "-", kTiny, kFar, 2, "",
         "Length and breadth of the field along x and y.",
         [](S& s, const Value& v) { s.extent = pair(v); }},
    };
}

// Sizes of floes. A key belongs to one pattern or a few (pattern_keys()), so all have the default
// "-" or one that is harmless to the others.
std::vector<FieldKey> floe_keys() {
    return {
        {"floes.size", Kind::vector, D::length, "-", kTiny, kFar, 2, "",
         "Grid and brick: a floe along x and y.",
         [](S& s, const Value& v) { s.floe_size = pair(v); }},
        {"floes.count", Kind::counts, D::none, "-", 1, 1e5, 2, "",
         "Grid and brick: number of floes along x and y.",
         [](S& s, const Value& v) {
             s.count = {static_cast<int>(pair(v)[0]), static_cast<int>(pair(v)[1])};
         }},
        {"floes.gap", Kind::vector, D::length, "[0.0, 0.0]", 0, 1e4, 2, "",
         "Grid, brick and cusps: open water between neighbours along x and y.",
         [](S& s, const Value& v) { s.gap = pair(v); }},
        {"floes.concentration", Kind::number, D::share, "-", 0.01, 0.97, 0, "",
         "Voronoi and power-law: area of the floes over the area of the field.",
         [](S& s, const Value& v) { s.concentration = number(v); }},
        {"floes.mean_size", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Voronoi: mean size, the diameter of the circle with a floe's area.",
         [](S& s, const Value& v) { s.mean_size = number(v); }},
        {"floes.exponent", Kind::number, D::none, "-", 0.01, 10, 0, "",
         "Power-law: a in N(> size) ~ size^-a, the number of floes larger than a size.",
         [](S& s, const Value& v) { s.exponent = number(v); }},
        {"floes.smallest", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Power-law: smallest size.", [](S& s, const Value& v) { s.smallest = number(v); }},
        {"floes.largest", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Power-law: largest size.", [](S& s, const Value& v) { s.largest = number(v); }},
        {"floes.relaxations", Kind::integer, D::none, "10", 0, 1000, 0, "",
         "Voronoi and power-law: rounds of Lloyd's method, which make floes round and alike.",
         [](S& s, const Value& v) { s.relaxations = static_cast<int>(std::get<std::int64_t>(v)); }},
        {"floes.breaking_length", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Cusps: advance from row to row, along x.",
         [](S& s, const Value& v) { s.breaking_length = number(v); }},
        {"floes.breaking_width", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Cusps: chord of a cusp, along y; rounded so that whole cusps fill the breadth.",
         [](S& s, const Value& v) { s.breaking_width = number(v); }},
        {"floes.breaking_depth", Kind::number, D::length, "-", 0, kFar, 0, "",
         "Cusps: how far the arc goes beyond its chord; default half the breaking length.",
         [](S& s, const Value& v) { s.breaking_depth = number(v); }},
        {"floes.entrance_angle", Kind::number, D::angle, "\"90 deg\"", 0.17, 1.5708, 0, "",
         "Cusps: between a row and the centre line, as the bow's water line; 90 deg is straight.",
         [](S& s, const Value& v) { s.entrance_angle = number(v); }},
        {"floes.jitter", Kind::number, D::share, "0.5", 0, 0.9, 0, "",
         "Cusps: largest random offset of a cusp's ends, in half breaking widths.",
         [](S& s, const Value& v) { s.jitter = number(v); }},
        {"floes.file", Kind::path, D::none, "-", 0, 0, 0, "",
         "Polygons: GeoJSON (.geojson, .json) or CSV (rows floe, x, y); relative to this file.",
         [](S& s, const Value& v) { s.file = text(v); }},
        {"floes.scale", Kind::number, D::none, "1.0", 1e-9, 1e9, 0, "",
         "Polygons: metres per unit of the file, for instance per pixel.",
         [](S& s, const Value& v) { s.scale = number(v); }},
    };
}

// Unbroken ice around the field. Without it floes at the edge can be pushed away freely, as in a
// basin that is wider than its ice.
std::vector<FieldKey> edge_keys() {
    return {
        {"edges.breadth", Kind::number, D::length, "0.0", 0, kFar, 0, "",
         "Breadth of the unbroken ice on both sides of the field; 0 for none.",
         [](S& s, const Value& v) { s.edge_breadth = number(v); }},
        {"edges.piece", Kind::number, D::length, "-", kTiny, kFar, 0, "",
         "Length of its pieces along x, all alike; default four times the breadth.",
         [](S& s, const Value& v) { s.edge_piece = number(v); }},
        {"edges.ahead", Kind::number, D::length, "-", 0, kFar, 0, "",
         "Length along x of the unbroken ice across the field's far end; default the breadth, 0 "
         "leaves the end open: free floes are then pushed out ahead of the ship.",
         [](S& s, const Value& v) { s.edge_ahead = number(v); }},
        {"edges.gap", Kind::number, D::length, "0.0", 0, kFar, 0, "",
         "Open water between the field and the unbroken ice.",
         [](S& s, const Value& v) { s.edge_gap = number(v); }},
        {"edges.overhang", Kind::vector, D::length, "[0.0, 0.0]", -kFar, kFar, 2, "",
         "How far the unbroken ice goes beyond the field's smallest and largest x.",
         [](S& s, const Value& v) { s.edge_overhang = pair(v); }},
    };
}

}  // namespace

const std::vector<FieldKey>& field_keys() {
    static const std::vector<FieldKey> keys = [] {
        std::vector<FieldKey> all = common_keys();
        for (const auto& part : {floe_keys(), edge_keys()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return keys;
}

const Schema& field_schema() {
    static const Schema schema = [] {
        Schema out{{}, "", "icefield", "icefield specification", {}};
        for (const FieldKey& key : field_keys()) out.keys.push_back(key);
        return out;
    }();
    return schema;
}

const std::vector<PatternKeys>& pattern_keys() {
    // name, required keys, further keys; the keys of no pattern belong to all
    static const std::vector<PatternKeys> keys{
        {"grid", {"floes.size", "floes.count"}, {"floes.gap"}},
        {"brick", {"floes.size", "floes.count"}, {"floes.gap"}},
        {"cusps",
         {"area.size", "floes.breaking_length", "floes.breaking_width"},
         {"floes.breaking_depth", "floes.entrance_angle", "floes.jitter", "floes.gap"}},
        {"voronoi", {"area.size", "floes.concentration", "floes.mean_size"}, {"floes.relaxations"}},
        {"power-law",
         {"area.size", "floes.concentration", "floes.exponent", "floes.smallest", "floes.largest"},
         {"floes.relaxations"}},
        {"polygons", {"floes.file"}, {"floes.scale"}}};
    return keys;
}

}  // namespace ice
