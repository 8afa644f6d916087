// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the method; step.cpp is its table of contents.
#pragma once

#include <array>
#include <vector>

#include "solver/broad/find_pairs.hpp"
#include "solver/case/case.hpp"
#include "solver/contact/crush_solids.hpp"
#include "solver/contact/overlaps.hpp"
#include "solver/contact/recess.hpp"
#include "solver/contact/solve_contacts.hpp"
#include "solver/integrate/integrate.hpp"
#include "solver/live_edge/live_edge.hpp"
#include "solver/loads/measure_loads.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/record/energy_ledger.hpp"
#include "solver/scene/bodies.hpp"
#include "solver/ship/free_ship.hpp"
#include "solver/step/release_bent.hpp"

namespace ice {

enum class Stage { broad, narrow, contact, water, integrate, count };
constexpr std::array<const char*, static_cast<std::size_t>(Stage::count)> kStageNames{
    "broad", "narrow", "contact", "water", "integrate"};

/// A scene in motion with everything a step reuses from the one before.
struct World {
    Case parameters;
    Scene scene;
    double time = 0.0;       ///< [s]
    std::int64_t steps = 0;  ///< made so far

    MotionBounds motion;
    PairList pairs;
    std::vector<Contact> contacts;
    std::vector<Constraint> constraints;
    FreeShip ship;
    LiveEdge edge;  ///< of level ice; has no sheet unless begin() was called
    /// The caller's own loads by body (add_applied); empty: none. They stay until they are changed,
    /// and no checkpoint carries them.
    std::vector<WaterLoad> applied_loads;
    std::vector<FloeLoad> loads;  ///< in the order of Bodies::moving, with those applied
    PositionCorrections corrections;
    WarmStart warm_start;
    ContactFinder finder;
    ContactSolver solver;
    Overlaps overlaps;
    CrushSolids crush_solids;
    Recess recess;
    BentFloes bent;
    StepStart start;  ///< of the present step
    EnergyLedger ledger;

    SolveReport impacts, rest;  ///< of the last step
    /// Wall time of each stage, sum over the steps [s].
    std::array<double, static_cast<std::size_t>(Stage::count)> stage_seconds{};
};

/// Releases the floes that the last step's loads broke, and renews the edge of level ice, where
/// bodies change their shape. step() begins with it; a second call has no effect.
void begin_step(World& world);

/// Advances the world by parameters.time_step. Afterwards `constraints` hold the step's impulses.
void step(World& world);

}  // namespace ice
