// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/checkpoint_file.hpp"
#include "solver/record/recorder.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// What run() itself carries on beside the world and the recorder.
struct RunProgress {
    double wall_seconds = 0.0;      ///< of all programs that worked on the run
    std::vector<Warning> warnings;  ///< about the start and restarts
};

/// All state that a run carries from one step to the next, in one list (state_fields.cpp) that both
/// writes and reads a checkpoint.
///
/// To add a field: give it a line there. Nothing else is needed, but that its name is new and its
/// type one of CheckpointFile's; an array per body goes through carry_each(), a table through one
/// column() per member. Private members need `friend struct StateFields` in their class. What the
/// next step computes anew (contacts, loads, grids, velocities from momenta) is no state.
/// A checkpoint without the field is then refused with the version that wrote it. The test "a run
/// continued from a checkpoint ends with the same bits" fails when a field was forgotten.
struct StateFields {
    static void carry(CheckpointFile& file, World& world);
    static void carry(CheckpointFile& file, Recorder& recorder);
    static void carry(CheckpointFile& file, RecordPosition& position);
    static void carry(CheckpointFile& file, RunProgress& progress);

private:
    static void carry(CheckpointFile& file, Tally& tally);
    static void carry(CheckpointFile& file, HullContacts& contacts);
    static void carry(CheckpointFile& file, PanelLoads& loads);
    static void carry(CheckpointFile& file, ShipTally& tally);
};

}  // namespace ice
