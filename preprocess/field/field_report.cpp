// SPDX-License-Identifier: GPL-3.0-or-later
// The measures of a field as JSON.
#include <nlohmann/json.hpp>

#include "preprocess/field/make_field.hpp"

namespace ice {

std::string field_report_text(const FieldReport& r) {
    const nlohmann::ordered_json json{
        {"schema", "icefield/1"},
        {"floes", r.floes},
        {"unbroken_pieces", r.fixed},
        {"shapes", r.shapes},
        {"spheres", r.spheres},
        {"surface_spheres", r.surface_spheres},
        {"corners", r.corners},
        {"concentration", r.concentration},
        {"mean_size_m", r.mean_size},
        {"smallest_size_m", r.smallest},
        {"largest_size_m", r.largest},
        {"warnings", r.warnings},
        {"seconds", {{"plan", r.plan_seconds}, {"fill", r.fill_seconds}}}};
    return json.dump(2) + "\n";
}

}  // namespace ice
