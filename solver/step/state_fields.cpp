// SPDX-License-Identifier: GPL-3.0-or-later
// The list of all state. carry() writes a field or sets it, by the file's direction.
#include "solver/step/state_fields.hpp"

#include <fmt/format.h>

namespace ice {

void StateFields::carry(CheckpointFile& file, World& w) {
    file.carry("time", w.time);
    file.carry("steps", w.steps);
    for (std::size_t k = 0; k < kStageNames.size(); ++k)
        file.carry(fmt::format("stage_seconds.{}", kStageNames[k]), w.stage_seconds[k]);

    Bodies& b = w.scene.bodies;
    file.carry_each("bodies.position", b.position);
    file.carry_each("bodies.orientation", b.orientation);
    file.carry_each("bodies.momentum", b.momentum);
    file.carry_each("bodies.angular_momentum", b.angular_momentum);
    file.carry_each("bodies.held", b.held);

    EnergyLedger& ledger = w.ledger;
    file.carry("ledger.ship_work", ledger.ship_work);
    file.carry("ledger.kinetic", ledger.kinetic);
    file.carry("ledger.friction", ledger.friction);
    file.carry("ledger.restitution", ledger.restitution);
    file.carry("ledger.crushing", ledger.crushing);
    file.carry("ledger.breaking", ledger.breaking);
    file.carry("ledger.drag", ledger.drag);
    file.carry("ledger.water_work", ledger.water_work);
    file.carry("ledger.applied_work", ledger.applied_work);
    file.carry("ledger.separation", ledger.separation);
    file.carry("ledger.buoyancy_moment", ledger.buoyancy_moment);
    file.carry("ledger.potential_start", ledger.potential_start);

    FreeShip& ship = w.ship;
    file.carry("ship.angles", ship.angles_);
    file.carry("ship.velocity", ship.velocity_);
    file.carry("ship.spin", ship.spin_);
    file.carry("ship.speed_error", ship.speed_error_);
    file.carry("ship.thrust_work", ship.energies_.thrust);
    file.carry("ship.tow_work", ship.energies_.tow);
    file.carry("ship.mooring_work", ship.energies_.mooring);
    file.carry("ship.ice_work", ship.energies_.ice);
    file.carry("ship.losses", ship.energies_.losses);
    file.carry("ship.kinetic_start", ship.energies_.kinetic_start);
    file.carry("ship.potential_start", ship.energies_.potential_start);

    file.carry("crushed.first", w.scene.crushed.first);
    file.carry("crushed.recess", w.scene.crushed.recess);
    file.carry("crushed.deepest", w.scene.crushed.deepest);

    auto& entries = w.warm_start.entries_;
    file.column("warm_start.a", entries, &WarmStart::Entry::a);
    file.column("warm_start.b", entries, &WarmStart::Entry::b);
    file.column("warm_start.key", entries, &WarmStart::Entry::key);
    file.column("warm_start.normal", entries, &WarmStart::Entry::normal);
    file.column("warm_start.tangent", entries, &WarmStart::Entry::tangent);

    // the last step's impulses: they are part of the state hash, which may be asked for at once
    file.column("impulses.impact_normal", w.constraints, &Constraint::impact_normal);
    file.column("impulses.impact_tangent", w.constraints, &Constraint::impact_tangent);
    file.column("impulses.rest_normal", w.constraints, &Constraint::rest_normal);
    file.column("impulses.rest_tangent", w.constraints, &Constraint::rest_tangent);
}

void StateFields::carry(CheckpointFile& file, Recorder& r) {
    file.carry("row.contact_force", r.row_.contact_force);
    file.carry("row.friction_force", r.row_.friction_force);
    file.carry("row.moment", r.row_.moment);
    file.carry("row.breaking_x", r.row_.breaking_x);
    file.carry("row.contacts", r.row_.contacts);
    file.carry("row.moving_floes", r.row_.moving_floes);
    file.carry("row.max_overlap", r.row_.max_overlap);
    file.carry("row.kinetic_energy", r.row_.kinetic_energy);
    file.column("row.region_contact", r.row_regions_, &RegionForce::contact);
    file.column("row.region_friction", r.row_regions_, &RegionForce::friction);
    file.carry("row.steps", r.row_steps_);
    file.column("row.tracked_contact", r.tracked_sum_, &FloeForces::contact);
    file.column("row.tracked_friction", r.tracked_sum_, &FloeForces::friction);
    file.column("row.tracked_ice", r.tracked_sum_, &FloeForces::ice);
    file.carry_each("frame.impulse", r.frame_impulse_);
    carry(file, r.hull_contacts_);
    file.carry("frame.last_time", r.last_frame_);
    file.carry("frame.count", r.frames_);
    file.carry("row.count", r.rows_);
    carry(file, r.tally_);
    carry(file, r.panel_loads_);
    file.carry("row.thrust", r.row_.thrust);
    file.carry("row.tow_force", r.row_.tow_force);
    carry(file, r.ship_tally_);
}

void StateFields::carry(CheckpointFile& file, ShipTally& t) {
    file.carry("ship_tally.speed", t.speed_);
    file.carry("ship_tally.thrust", t.thrust_);
    file.carry("ship_tally.tow", t.tow_);
    for (std::size_t k = 0; k < kFreedoms; ++k) {
        file.carry(fmt::format("ship_tally.sum.{}", k), t.sum_[k]);
        file.carry(fmt::format("ship_tally.square.{}", k), t.square_[k]);
    }
    std::uint8_t stuck = t.stuck_ ? 1 : 0;
    file.carry("ship_tally.slow_since", t.slow_since_);
    file.carry("ship_tally.stuck", stuck);
    t.stuck_ = stuck != 0;
}

void StateFields::carry(CheckpointFile& file, PanelLoads& p) {
    file.carry("panels.steps", p.steps_);
    file.carry("panels.windows", p.windows_);
    file.carry_each("panels.on_panel", p.on_panel_);
    file.carry_each("panels.on_region", p.on_region_);
    file.column("panels.load_window", p.loads_, &PanelLoads::Load::window);
    file.column("panels.load_panel", p.loads_, &PanelLoads::Load::panel);
    file.column("panels.load_force", p.loads_, &PanelLoads::Load::force);
    file.carry("panels.regions", p.regions_);
}

void StateFields::carry(CheckpointFile& file, HullContacts& h) {
    std::vector<std::pair<std::int32_t, std::int32_t>> keys;
    std::vector<HullContacts::Sum> sums;
    for (const auto& [key, sum] : h.sums_) {  // a map goes as a table
        keys.push_back(key);
        sums.push_back(sum);
    }
    file.column("hull_contacts.floe", keys, &std::pair<std::int32_t, std::int32_t>::first);
    file.column("hull_contacts.sphere", keys, &std::pair<std::int32_t, std::int32_t>::second);
    file.column("hull_contacts.weight", sums, &HullContacts::Sum::weight);
    file.column("hull_contacts.point", sums, &HullContacts::Sum::point);
    file.column("hull_contacts.push", sums, &HullContacts::Sum::push);
    file.column("hull_contacts.rub", sums, &HullContacts::Sum::rub);
    h.sums_.clear();
    for (std::size_t k = 0; k < keys.size(); ++k) h.sums_.emplace(keys[k], sums[k]);
}

void StateFields::carry(CheckpointFile& file, Tally& t) {
    for (std::size_t d = 0; d < 3; ++d) file.carry(fmt::format("tally.total.{}", d), t.total_[d]);
    file.carry("tally.contact", t.contact_);
    file.carry("tally.friction", t.friction_);
    file.carry("tally.breaking_x", t.breaking_x_);
    file.carry("tally.averaged_time", t.averaged_time_);
    file.column("tally.region_hits", t.regions_, &Tally::Region::hits);
    file.column("tally.region_max_impulse", t.regions_, &Tally::Region::max_impulse);
    file.column("tally.region_impulse", t.regions_, &Tally::Region::impulse);
    file.column("tally.region_friction", t.regions_, &Tally::Region::friction);

    // a set goes as a table
    std::vector<std::pair<std::int32_t, std::int32_t>> touching(t.touching_.begin(),
                                                                t.touching_.end());
    file.column("tally.touching_floe", touching, &std::pair<std::int32_t, std::int32_t>::first);
    file.column("tally.touching_region", touching, &std::pair<std::int32_t, std::int32_t>::second);
    t.touching_ = {touching.begin(), touching.end()};

    file.carry("tally.steps", t.steps_);
    file.carry("tally.unconverged", t.unconverged_);
    file.carry("tally.impulse", t.impulse_);
    file.carry("tally.residual", t.residual_);
    file.carry("tally.jam_force", t.jam_.force);
    file.carry("tally.jam_averaged", t.jam_.steps);
    file.carry("tally.fast_force", t.fast_.force);
    file.carry("tally.fast_averaged", t.fast_.steps);
    file.carry("tally.jammed_steps", t.jammed_steps_);
    file.carry("tally.contacts", t.contacts_);
    file.carry("tally.contacts_max", t.contacts_max_);
    file.carry("tally.max_overlap", t.max_overlap_);
    file.carry("tally.looks", t.looks_);
    file.carry("tally.doubtful_looks", t.doubtful_looks_);
    file.carry("tally.unseen_overlap", t.unseen_overlap_);
    file.carry("tally.unseen_time", t.unseen_time_);
    file.carry("tally.unseen_a", t.unseen_a_);
    file.carry("tally.unseen_b", t.unseen_b_);
    file.carry("tally.kinetic", t.kinetic_);
    file.carry("tally.kinetic_max", t.kinetic_max_);
    file.carry("tally.first_jam_time", t.first_jam_time_);
    file.carry("tally.deepest_time", t.deepest_time_);
    file.carry("tally.closing_speed", t.closing_speed_);
    file.carry("tally.closing_time", t.closing_time_);
    file.carry("tally.closing_a", t.closing_a_);
    file.carry("tally.closing_b", t.closing_b_);
    file.carry("tally.first_jam_floe", t.first_jam_floe_);
    file.carry("tally.first_jam_point", t.first_jam_point_);
}

void StateFields::carry(CheckpointFile& file, RecordPosition& position) {
    file.carry("files.samples", position.run.samples);
    file.carry("files.frames", position.run.frames);
    file.carry("files.contacts", position.run.contacts);
    file.carry("files.last_orientation", position.run.last_orientation);
    file.carry("files.csv_bytes", position.csv_bytes);
}

void StateFields::carry(CheckpointFile& file, RunProgress& progress) {
    auto count = static_cast<std::int64_t>(progress.warnings.size());
    file.carry("wall_seconds", progress.wall_seconds);
    file.carry("warnings.count", count);
    progress.warnings.resize(static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < progress.warnings.size(); ++k) {
        Warning& w = progress.warnings[k];
        const std::string name = fmt::format("warnings.{}.", k);
        std::optional<std::uint8_t> affects;
        if (w.affects_mean) affects = *w.affects_mean ? 1 : 0;
        file.carry(name + "text", w.text);
        file.carry(name + "affects_mean", affects);
        file.carry(name + "share", w.share);
        if (affects) w.affects_mean = *affects != 0;
    }
}

}  // namespace ice
