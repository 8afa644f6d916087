// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/flow_report.hpp"

#include "common/formats/json_file.hpp"

namespace ice {

std::string flow_report_text(const FlowReport& r) {
    Json json;
    json["schema"] = "iceflow/1";
    json["dimension"] = r.dimension;
    json["symmetric"] = r.symmetric;
    json["draught_m"] = r.draught;
    json["length_m"] = r.length;
    json["panels"] = r.panels;
    json["panel_m"] = r.panel;
    json["residual"] = r.residual;
    json["worst"] = r.worst;
    json["worst_at_m"] = r.worst_at;
    json["net_flux"] = r.net_flux;
    json["nodes"] = r.nodes;
    json["spacing_m"] = r.spacing;
    // absent, not null, without --added-mass: older readers have no such key
    if (r.added_mass)
        json["added_mass"] = {{"matrix", *r.added_mass},
                              {"about_m", r.added_mass_about},
                              {"displacement_kg", r.displacement},
                              {"water_density_kg_per_m3", r.water_density}};
    json["warnings"] = r.warnings;
    json["seconds"] = {{"solve", r.solve_seconds}, {"table", r.table_seconds}};
    add_origin(json);
    return json_text(json);
}

}  // namespace ice
