// SPDX-License-Identifier: GPL-3.0-or-later
/// `*.spheres.h5`: the contract between spherize and icesolve (docs/contract.md, section 3).
#pragma once

#include <filesystem>

#include "common/formats/sphere_set.hpp"
#include "common/formats/spheres_report.hpp"

namespace ice {

/// Writes a sphere set and its certificate: the attribute "certificate" of "/" holds it as JSON
/// (schema spherize/1), its numbers are attributes of their own under the same names.
/// Equal sets give equal bytes: no times are stored.
/// @throws Error (exit code 1) when the file cannot be written; nothing half-written stays behind.
void write_spheres(const std::filesystem::path& path, const SphereSet& set,
                   SpheresReport certificate = {});

/// Reads and checks a sphere set: format name and version, array lengths, finite numbers, positive
/// radii and volume, unit normals on the surface, indices in range, the seal (sealed_file.hpp),
/// solid and shares against the mesh (sphere_set_faults.hpp).
///
/// Beside the contract's datasets: `/normal_spread` f32 [N], SphereSet::normal_spread [rad], 0
/// inside; `/crease/sphere` i32 [M] and `/crease/normal` f32 [M,3], SphereSet::creases. Rows of the
/// interior without information are not stored: they read as the datasets' fill values.
///
/// A file without `normal_spread` (format version 1 without the extra dataset) reads as spread 0.
/// @throws Error (exit code 2) naming the file and the dataset.
SphereSet read_spheres(const std::filesystem::path& path);

/// The certificate's line on the ice belt, ice_belt_text(); empty where spherize was given no
/// draught. @throws Error (exit code 2) when the file cannot be read
std::string read_ice_belt(const std::filesystem::path& path);

}  // namespace ice
