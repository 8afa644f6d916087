// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/formats/warning.hpp"
#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Warns, at the end of a run, of a channel that emptied: the ship pushed loose floes out of its
/// open far end, so that the ice ahead moved with the ship instead of resisting it.
///
/// A channel has unbroken ice on both sides of its loose floes (Scene::start). A floe counts that
/// moves freely ahead of the bow and reaches beyond where the ice ended at the start by a tenth of
/// its own length. No warning if the farthest floe came out by less than a tenth of the ship's
/// travel: floes that spread slowly into open water do not move with the ship.
///
/// @param travel  of the ship up to now [m]
std::optional<Warning> warn_of_open_end(const Scene& scene, const Case& parameters, double travel);

}  // namespace ice
