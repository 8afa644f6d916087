// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Releases held floes that are touched within the step, by the rule of their group:
/// until-hull-contact by the ship only, until-contact by the ship or a moving floe. Floes held
/// until they bend are released by BentFloes, without strength as until-contact.
///
/// A contact touches when gap + dt min(v_r . n, 0) <= 0: the criterion of the impacts, so that a
/// floe is free in the impact that releases it.
/// @return true when a floe was released, so that contacts must be searched again
bool release_touched(Scene& scene, const Case& parameters, const std::vector<Contact>& contacts);

}  // namespace ice
