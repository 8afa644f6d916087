// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/write/sink.hpp"

namespace ice {

/// Centres, radii and normals as CSV, mesh frame: x_m,y_m,z_m,radius_m,nx,ny,nz,layer,region.
/// Numbers have as many digits as give the same double back; a region name that holds a comma,
/// quote or line break is in quotes (RFC 4180).
void write_csv(const SphereSet& set, const Sink& sink);

}  // namespace ice
