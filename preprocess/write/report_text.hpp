// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/sphere_set.hpp"
#include "common/formats/summary_file.hpp"

namespace ice {

/// The one-screen report of a finished set.
std::string report_text(const SpheresReport& report, const std::string& output);

/// Centres, radii and normals as CSV: x_m,y_m,z_m,radius_m,nx,ny,nz,layer,region.
std::string csv_text(const SphereSet& set);

}  // namespace ice
