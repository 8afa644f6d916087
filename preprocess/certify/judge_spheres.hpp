// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/formats/sphere_set.hpp"
#include "common/formats/spheres_report.hpp"
#include "preprocess/fill/fill_spheres.hpp"

namespace ice {

/// Sets report.belt for a draught [m], from the lowest point of the solid up to the water; without
/// one the belt stays empty.
/// @param ice_thickness  [m]; by default a tenth of the draught
/// @throws Error (exit code 2) where the solid is not as deep as the draught, or an ice thickness
///         comes without a draught
void set_ice_belt(const TriangleMesh& solid, std::optional<double> draught,
                  std::optional<double> ice_thickness, SpheresReport& report);

/// Warnings of the certificate, with their numbers: spheres that reach out by more than a hundredth
/// of a radius or were dropped as outside; places without one within 0.75 spacings; a lattice that
/// leaves a face without spheres; a stem or stern cut back by more than a radius in the ice belt;
/// thin parts; wide spacings. To be called last: it reads all measures of the report.
void judge_spheres(const SphereSet& set, Arrangement arrangement, SpheresReport& report);

}  // namespace ice
