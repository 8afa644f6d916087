// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/step/step.hpp"

namespace ice {

/// Draws a world before its first step, from the side, in the format of the picture's suffix.
///
/// Drawing is icepost's work, which takes a run folder: one with this frame alone is written to the
/// temporary folder and removed again.
/// @throws Error as check_picture_name(); exit code 1 when icepost is not there or fails
void draw_start(const World& world, const std::filesystem::path& picture);

}  // namespace ice
