// SPDX-License-Identifier: GPL-3.0-or-later
// All state of the recorder and its parts. carry() writes a field or sets it, by the file's
// direction.
#include <fmt/format.h>

#include <algorithm>

#include "common/formats/checkpoint_file.hpp"
#include "solver/record/recorder.hpp"

namespace ice {

void Recorder::carry(CheckpointFile& file) {
    // The row of the histories that is begun, and the frame: all that is not in a file yet. A
    // checkpoint is read by these names: a member may be renamed alone, a field only with a new
    // version of the format.
    file.carry("row.contact_force", row_.contact_force);
    file.carry("row.friction_force", row_.friction_force);
    file.carry("row.moment", row_.moment);
    file.carry("row.breaking_x", row_.breaking_x);
    file.carry("row.contacts", row_.contacts);
    file.carry("row.moving_floes", row_.moving_floes);
    file.carry("row.max_overlap", row_.max_overlap);
    file.carry("row.kinetic_energy", row_.kinetic_energy);
    file.column("row.region_contact", row_regions_, &RegionForce::contact);
    file.column("row.region_friction", row_regions_, &RegionForce::friction);
    file.carry("row.steps", row_steps_);
    file.column("row.tracked_contact", tracked_sum_, &FloeForces::contact);
    file.column("row.tracked_friction", tracked_sum_, &FloeForces::friction);
    file.column("row.tracked_ice", tracked_sum_, &FloeForces::ice);
    file.carry_each("frame.impulse", frame_impulse_);
    hull_contacts_.carry(file);
    file.carry("frame.last_time", last_frame_);
    file.carry("frame.count", frames_);
    file.carry("row.count", rows_);
    statistics_.carry(file);
    panel_loads_.carry(file);
    file.carry("row.thrust", row_.thrust);
    file.carry("row.tow_force", row_.tow_force);
    ship_statistics_.carry(file);
}

void ShipStatistics::carry(CheckpointFile& file) {
    speed_.carry(file, "ship_statistics.speed");
    thrust_.carry(file, "ship_statistics.thrust");
    tow_.carry(file, "ship_statistics.tow");
    mooring_.carry(file, "ship_statistics.mooring");
    file.carry("ship_statistics.power", power_);
    for (std::size_t k = 0; k < kFreedoms; ++k) {
        file.carry(fmt::format("ship_statistics.sum.{}", k), sum_[k]);
        file.carry(fmt::format("ship_statistics.square.{}", k), square_[k]);
    }
    // a checkpoint has no truth values
    std::uint8_t stuck = stuck_ ? 1 : 0;
    file.carry("ship_statistics.slow_since", slow_since_);
    file.carry("ship_statistics.stuck", stuck);
    stuck_ = stuck != 0;
}

// The panels themselves follow from the hull; their loads alone are state.
void PanelLoads::carry(CheckpointFile& file) {
    file.carry("panels.steps", steps_);
    file.carry("panels.windows", windows_);
    file.carry_each("panels.on_panel", on_panel_);
    file.carry_each("panels.on_region", on_region_);
    WindowForces::carry(file, "panels.force", forces_);
    for (std::size_t r = 0; r < regions_.size(); ++r) {
        regions_[r].carry(file, fmt::format("panels.region.{}", r));
        lines_[r].carry(file, fmt::format("panels.line.{}", r));
    }
}

void HullContacts::carry(CheckpointFile& file) {
    std::vector<std::pair<std::int32_t, std::int32_t>> keys;
    std::vector<Sum> sums;
    for (const auto& [key, sum] : sums_) {  // a map is stored as a table
        keys.push_back(key);
        sums.push_back(sum);
    }
    file.column("hull_contacts.floe", keys, &std::pair<std::int32_t, std::int32_t>::first);
    file.column("hull_contacts.sphere", keys, &std::pair<std::int32_t, std::int32_t>::second);
    file.column("hull_contacts.weight", sums, &Sum::weight);
    file.column("hull_contacts.point", sums, &Sum::point);
    file.column("hull_contacts.push", sums, &Sum::push);
    file.column("hull_contacts.rub", sums, &Sum::rub);
    // the same again where it was written, the saved entries where it was read
    sums_.clear();
    for (std::size_t k = 0; k < keys.size(); ++k) sums_.emplace(keys[k], sums[k]);
}

// Sums and extremes since the start: a resumed run's means are those of an uninterrupted one.
void RunStatistics::carry(CheckpointFile& file) {
    for (std::size_t d = 0; d < 3; ++d)
        total_[d].carry(file, fmt::format("statistics.total.{}", d));
    file.carry("statistics.contact", contact_);
    file.carry("statistics.friction", friction_);
    file.carry("statistics.breaking_x", breaking_x_);
    file.carry("statistics.averaged_time", averaged_time_);
    file.column("statistics.region_hits", regions_, &Region::hits);
    file.column("statistics.region_max_impulse", regions_, &Region::max_impulse);
    file.column("statistics.region_impulse", regions_, &Region::impulse);
    file.column("statistics.region_friction", regions_, &Region::friction);

    // a set is stored as a table
    std::vector<std::pair<std::int32_t, std::int32_t>> touching(touching_.begin(), touching_.end());
    file.column("statistics.touching_floe", touching,
                &std::pair<std::int32_t, std::int32_t>::first);
    file.column("statistics.touching_region", touching,
                &std::pair<std::int32_t, std::int32_t>::second);
    touching_ = {touching.begin(), touching.end()};

    file.carry("statistics.steps", steps_);
    file.carry("statistics.unconverged", unconverged_);
    file.carry("statistics.impulse", impulse_);
    file.carry("statistics.residual", residual_);
    file.carry("statistics.jam_force", jam_.force);
    file.carry("statistics.jam_averaged", jam_.steps);
    file.carry("statistics.fast_force", fast_.force);
    file.carry("statistics.fast_averaged", fast_.steps);
    file.carry("statistics.jammed_steps", jammed_steps_);
    file.carry("statistics.contacts", contacts_);
    file.carry("statistics.contacts_max", contacts_max_);
    file.carry("statistics.max_overlap", max_overlap_);
    file.carry("statistics.checks", checks_);
    file.carry("statistics.doubtful_checks", doubtful_checks_);
    file.carry("statistics.unseen_overlap", unseen_overlap_);
    file.carry("statistics.unseen_time", unseen_time_);
    file.carry("statistics.unseen_a", unseen_a_);
    file.carry("statistics.unseen_b", unseen_b_);
    file.carry("statistics.unseen_all", unseen_loads_.all);
    file.carry("statistics.unseen_doubtful", unseen_loads_.doubtful);
    file.carry("statistics.unseen_pressing", unseen_loads_.pressing);
    file.carry("statistics.unseen_missing", unseen_loads_.missing);
    file.carry("statistics.kinetic", kinetic_);
    file.carry("statistics.kinetic_max", kinetic_max_);
    file.carry("statistics.first_jam_time", first_jam_time_);
    file.carry("statistics.deepest_time", deepest_time_);
    file.carry("statistics.closing_speed", closing_speed_);
    file.carry("statistics.closing_time", closing_time_);
    file.carry("statistics.closing_a", closing_a_);
    file.carry("statistics.closing_b", closing_b_);
    file.carry("statistics.first_jam_floe", first_jam_floe_);
    file.carry("statistics.first_jam_point", first_jam_point_);
}

}  // namespace ice
