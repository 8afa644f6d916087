// SPDX-License-Identifier: GPL-3.0-or-later
/// Ship, ice and travel of a case in a few numbers, measured in the simulated scene.
#pragma once

#include <optional>

#include "common/formats/summary_file.hpp"
#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// The hull as it lies in calm water: section and sink of its mesh at the ship's height.
///
/// Length, breadth and angles as measure_hull_dimensions(). Displacement: volume below the water,
/// exactly (measure_submerged), times the water's density. Draught: down to the mesh's lowest
/// point; negative where the hull hangs above the water. All else is NaN where the hull does not
/// cross the water; in 2D all but length and draught. The mean speed is speed_mean().
///
/// @param height  of the mesh's origin [m]; as the scene has it where not given
ShipParticulars measure_ship(const Scene& scene, const Case& parameters);
ShipParticulars measure_ship(const Scene& scene, const Case& parameters, double height);

/// The floes that may move: those of groups that are not held always. Their plan area is the area
/// seen from above in their group's orientation, not in the present one; overhangs count twice.
/// Without floes: the case's own values.
IceParticulars measure_ice(const Scene& scene, const Case& parameters);

/// Mean speed [m/s] from average_from to `until`, or over the whole run where it ends before.
double speed_mean(const Case& parameters, double until);

/// Travel from the start to `until` [s], in metres and lengths of the waterline.
TravelParticulars measure_travel(const Case& parameters, const ShipParticulars& ship, double until);

/// Travel of a free ship, and its height in calm water.
struct FreeTravel {
    double height;              ///< of the mesh's origin at equilibrium [m]
    double speed_mean;          ///< over the averaged time [m/s]
    double distance, averaged;  ///< along x, all and in the averaged time [m]
};

/// Fills ship, ice, travel, formulas and lindqvist_submersion of a run that ended at `until` [s].
/// @param went  of a free ship; none on a prescribed course
void fill_particulars(const Scene& scene, const Case& parameters, double until, Summary& summary,
                      const std::optional<FreeTravel>& went = std::nullopt);

}  // namespace ice
