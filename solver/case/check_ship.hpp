// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/case/complaints.hpp"

namespace ice {

/// Complains of keys of [ship], [propulsion], [tow], [mooring] and of a drift that do not go
/// together: given twice, without effect, or out of the plane of a 2D case.
/// @param values  of the keys given
void check_ship(const Case& checked, const Values& values, const Complaints& complaints);

/// Gives drift_velocity to the floes that have no velocity of their own, and to the water unless
/// flow.current is given.
/// @param groups  of the case; there are no others yet
void take_drift(Case& checked, std::size_t groups, const Values& values,
                const Complaints& complaints);

}  // namespace ice
