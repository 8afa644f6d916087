// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/spheres_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/formats/json_file.hpp"

namespace ice {

namespace {

Json distance_json(const SurfaceDistance& d) {
    return {{"p50_m", d.p50}, {"p99_m", d.p99}, {"max_m", d.max}, {"at_m", d.at}};
}

Json source_json(const SourceCheck& s) {
    return {{"to_solid", distance_json(s.to_solid)},
            {"from_solid", distance_json(s.to_source)},
            {"caps_m2", s.caps_area},
            {"left_out_m2", s.left_out_area}};
}

Json belt_json(const SpheresReport& r) {
    return {{"draught_m", r.belt.draught},
            {"ice_thickness_m", r.belt.thickness},
            {"z_m", {r.belt.low, r.belt.high}},
            {"to_solid", distance_json(r.belt.to_solid)},
            {"from_solid", distance_json(r.belt.to_source)},
            {"gap_p99_m", r.belt.gap_p99},
            {"gap_max_m", r.belt.gap_max},
            {"text", ice_belt_text(r)}};
}

}  // namespace

std::int64_t interior_bytes(const SpheresReport& r) {
    return 32 * (r.spheres - r.surface_spheres);  // centre and volume; other rows are not stored
}

std::string cut_back_text(const CutBack& cut) {
    return fmt::format("the {} is cut back by up to {:.3g} m between {} = {:.4g} and {:.4g} m",
                       cut.part, cut.by, cut.part == "keel" ? "x" : "z", cut.from, cut.to);
}

std::string ice_belt_text(const SpheresReport& r) {
    if (!r.belt) return {};
    const IceBelt& b = r.belt;
    std::string out = fmt::format("z {:.4g} to {:.4g} m (draught {:g} m, ice {:g} m): ", b.low,
                                  b.high, b.draught, b.thickness);
    // The larger of both directions: a part that repairs added lies far from the mesh, one that
    // they removed lies far from the solid.
    const double moved = std::max(b.to_solid.max, b.to_source.max);
    if (r.source.known)
        out += moved > 0.0
                   ? fmt::format("repairs moved the surface by {:.2g} m at p99, {:.2g} m at most; ",
                                 std::max(b.to_solid.p99, b.to_source.p99), moved)
                   : "the surface is the mesh's; ";
    out +=
        fmt::format("gap to the spheres {:.2g} m at p99, {:.2g} m at most", b.gap_p99, b.gap_max);
    for (const CutBack& cut : r.cut_back)
        // The keel lies below the ice belt and meets no ice there.
        if (cut.part != "keel") out += "; " + cut_back_text(cut);
    return out;
}

std::string spheres_report_text(const SpheresReport& r) {
    Json json;
    // In the order of docs/contract.md. Readers take keys by name; people read the file from above.
    json["schema"] = "spherize/1";
    json["dimension"] = r.dimension;
    json["radius_m"] = r.radius;
    json["spacing_m"] = r.spacing;
    json["spheres"] = r.spheres;
    json["surface_spheres"] = r.surface_spheres;
    json["interior_bytes"] = interior_bytes(r);
    json["volume_m3"] = r.volume;
    json["area_m2"] = r.area;
    json["centroid_m"] = r.centroid;
    json["inertia_unit_density"] = r.inertia_unit_density;
    json["protrusion_max_m"] = r.protrusion_max;
    json["covering_radius_m"] = r.covering_radius;
    json["covering_at_m"] = r.covering_at;
    json["gap_p50_m"] = r.gap_p50;
    json["gap_p99_m"] = r.gap_p99;
    json["gap_max_m"] = r.gap_max;
    json["normal_error_mean_deg"] = r.normal_error_mean_deg;
    json["normal_error_p99_deg"] = r.normal_error_p99_deg;
    // an empty list, not a missing key, where nothing is thin
    json["thin_features"] = Json::array();
    for (const ThinFeature& thin : r.thin_features)
        json["thin_features"].push_back({{"at_m", thin.at}, {"size_m", thin.size}});
    json["unfitted_share"] = r.unfitted_share;
    json["corners"] = r.corners;
    json["blind_corners"] = r.blind_corners;
    json["outside_dropped"] = r.outside_dropped;
    json["cut_back"] = Json::array();
    for (const CutBack& cut : r.cut_back)
        json["cut_back"].push_back({{"part", cut.part},
                                    {"by_m", cut.by},
                                    {"from_m", cut.from},
                                    {"to_m", cut.to},
                                    {"text", cut_back_text(cut)}});
    // null, not left out: "not measured" differs from the file of an older program.
    json["source"] = r.source.known ? source_json(r.source) : Json();
    json["ice_belt"] = r.belt ? belt_json(r) : Json();
    json["repairs"] = Json::array();
    for (const auto& [step, count] : r.repairs)
        json["repairs"].push_back({{"step", step}, {"count", count}});
    json["guessed"] = r.guessed;
    json["warnings"] = r.warnings;
    json["seconds"] = r.seconds;
    json["source_mesh"] = r.source_mesh;
    json["command_line"] = r.command_line;
    add_origin(json);
    return json_text(json);
}

}  // namespace ice
