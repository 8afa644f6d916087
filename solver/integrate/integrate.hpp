// SPDX-License-Identifier: GPL-3.0-or-later
/// Momenta move bodies (docs/method.md, section 2).
#pragma once

#include "solver/integrate/advance_floes.hpp"

namespace ice {

/// Moves all bodies by a step: the ship with its velocity, floes that are not held as advance_floes
/// does.
void advance(Scene& scene, const Advance& step);

}  // namespace ice
