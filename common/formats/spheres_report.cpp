// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/spheres_report.hpp"

#include "common/formats/json_file.hpp"

namespace ice {

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
    return json_text(json);
}

}  // namespace ice
