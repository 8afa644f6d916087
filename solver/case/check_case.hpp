// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/case/complaints.hpp"

namespace ice {

/// Keys against each other, once each by itself is right: times and steps, tracked floes, the
/// first @p groups groups of floes. Orientations become unit quaternions.
/// @param values given and default values by label ("floes.0.position")
void check_case(Case& checked, std::size_t groups, const Values& values,
                const Complaints& complaints);

}  // namespace ice
