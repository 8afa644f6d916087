// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Box around a body as it lies, world axes [m].
Eigen::AlignedBox3d box_of(const Scene& scene, std::size_t body);

/// True for unbroken ice: a floe whose group is held always.
bool is_unbroken(const Scene& scene, const Case& parameters, std::size_t floe);

/// Places of loose floes, and of unbroken ice beside and ahead of them. Without loose floes: an
/// empty box, and neither.
IceAtStart find_ice_at_start(const Scene& scene, const Case& parameters);

}  // namespace ice
