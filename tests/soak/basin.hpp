// SPDX-License-Identifier: GPL-3.0-or-later
/// The soak's scene: a closed basin of floes that a ship stirs for as long as it is asked to.
#pragma once

#include "solver/step/step.hpp"

namespace ice::soak {

constexpr int kFloes = 400;
constexpr double kThickness = 0.3;  ///< of the floes [m]
constexpr double kPeriod = 360.0;   ///< of the ship's motion [s]

/// A basin of 29.5 x 15 m between four held walls, 400 floes of 1 x 0.8 x 0.3 m, and a ship of
/// 10 x 6 m, flared all round from a keel of 6 x 1 m, that goes to and fro along it at 0.1 m/s.
///
/// The floes cannot leave, and beside the ship's way, 3 m broad at the waterline, there is no room
/// for all of them (320 of 354 m2, more than rectangles thrown together ever cover): every passage
/// meets ice. A passage and the next one back take 360 s; then the ship is where it was.
///
/// @param duration  simulated seconds
World make_basin(double duration);

/// The number of floes that are beyond the walls or 10 m above or below the water.
int count_escaped(const World& world);

}  // namespace ice::soak
