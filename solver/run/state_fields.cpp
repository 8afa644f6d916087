// SPDX-License-Identifier: GPL-3.0-or-later
// The list of all state. carry() writes a field or sets it, by the file's direction.
#include "solver/run/state_fields.hpp"

#include <fmt/format.h>

namespace ice {

void carry(CheckpointFile& file, World& w) {
    file.carry("time", w.time);
    file.carry("steps", w.steps);
    for (std::size_t k = 0; k < kStageNames.size(); ++k)
        file.carry(fmt::format("stage_seconds.{}", kStageNames[k]), w.stage_seconds[k]);

    // momenta, not velocities: these are derived from them (2)
    Bodies& b = w.scene.bodies;
    file.carry_each("bodies.position", b.position);
    file.carry_each("bodies.orientation", b.orientation);
    file.carry_each("bodies.momentum", b.momentum);
    file.carry_each("bodies.angular_momentum", b.angular_momentum);
    file.carry_each("bodies.held", b.held);

    // Sums since the start of the run: no motion depends on them.
    EnergyLedger& ledger = w.ledger;
    file.carry("ledger.ship_work", ledger.ship_work);
    file.carry("ledger.drift_work", ledger.drift_work);
    file.carry("ledger.kinetic", ledger.kinetic_change);
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

    // The crushed ice is geometry: without it a resumed run would meet whole floes.
    w.ship.carry(file);
    w.edge.carry(file);
    file.carry("crushed.first", w.scene.crushed.first);
    file.carry("crushed.recess", w.scene.crushed.displacement);
    file.carry("crushed.deepest", w.scene.crushed.deepest);
    w.scene.crushed_solids.carry(file);

    // Data for the next step alone: impulses to begin with, and the depths that distinguish a
    // recess from a motion. Neighbour lists are left out, because they are made anew with the same
    // contacts.
    w.warm_start.carry(file);
    w.recess.carry(file);

    // the last step's impulses: they are part of the state hash, which may be read at once
    file.column("impulses.impact_normal", w.constraints, &Constraint::impact_normal);
    file.column("impulses.impact_tangent", w.constraints, &Constraint::impact_tangent);
    file.column("impulses.rest_normal", w.constraints, &Constraint::rest_normal);
    file.column("impulses.rest_tangent", w.constraints, &Constraint::rest_tangent);
}

// Lengths of the files: later rows belong to steps that a resumed run makes again.
void carry(CheckpointFile& file, RecordPosition& position) {
    file.carry("files.samples", position.run.samples);
    file.carry("files.frames", position.run.frames);
    file.carry("files.contacts", position.run.contacts);
    file.carry("files.last_orientation", position.run.last_orientation);
    file.carry("files.csv_bytes", position.csv_bytes);
}

void carry(CheckpointFile& file, RunProgress& progress) {
    auto count = static_cast<std::int64_t>(progress.warnings.size());
    file.carry("wall_seconds", progress.wall_seconds);
    file.carry("warnings.count", count);
    // Reading and writing are one text (checkpoint_file.hpp): the size is set in both, and changes
    // nothing when writing.
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
