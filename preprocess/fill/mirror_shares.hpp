// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/sphere_set.hpp"

namespace ice {

/// Makes a set symmetric about y = 0, bit for bit, whose centres are: pairs get the mean of their
/// areas and volumes, the starboard sphere (y < 0) takes the port one's normal and spread, and
/// spheres on y = 0 lose the y of their normals. Sums, and first moments along x and z, are kept;
/// regions stay. A sphere without an image stays as it is.
///
/// The shares are measured on triangles, whose diagonals need not be mirror images: without this a
/// symmetric floe would list by rounding, and a model's two sides would drift apart.
void mirror_shares(SphereSet& set);

}  // namespace ice
