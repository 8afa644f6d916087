// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// The set as a VTK XML file (.vtp) for ParaView: one point per sphere with the arrays radius,
/// normal, area, volume, layer and region; appended raw, little-endian. Point Gaussian or a glyph
/// scaled by radius shows the spheres. Equal sets give equal bytes.
std::string vtp_text(const SphereSet& set);

}  // namespace ice
