// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/checkpoint_file.hpp"
#include "solver/record/recorder.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// State of run() itself, beside the world and the recorder.
struct RunProgress {
    double wall_seconds = 0.0;      ///< of all programs that worked on the run [s]
    std::vector<Warning> warnings;  ///< about the start and restarts
};

/// All state that a run carries from one step to the next, in lists that both write and read a
/// checkpoint: here that of the world, in record/recorder_state.cpp that of the recorder, and in
/// WarmStart::carry, FreeShip::carry and LiveEdge::carry theirs.
///
/// To add a field: give it a line there. Nothing else is needed, but that its name is new and its
/// type one of CheckpointFile's; an array per body is carried by carry_each(), a table by one
/// column() per member. Quantities that the next step computes anew (contacts, loads, grids,
/// velocities from momenta) is no state. A checkpoint without the field is then refused with the
/// version that wrote it. The test "a run continued from a checkpoint ends with the same bits"
/// fails when a field was forgotten.
void carry(CheckpointFile& file, World& world);
void carry(CheckpointFile& file, RecordPosition& position);
void carry(CheckpointFile& file, RunProgress& progress);

}  // namespace ice
