// SPDX-License-Identifier: GPL-3.0-or-later
/// `field.h5`: the contract between icefield and icesolve.
#pragma once

#include <filesystem>

#include "common/formats/field.hpp"

namespace ice {

/// Writes a field. Equal fields give equal bytes: no times are stored.
///
/// Attributes of "/": format "icesolve-field", format_version 1, units "SI", radius, spacing, mode,
/// area [4], concentration, specification, seed, created_by, command_line. F floes and K shapes;
/// arrays of shapes have one shape after the other, N spheres and S surface spheres in all:
///
///     /floe/shape             i32 [F]     row of /shape/...
///     /floe/position          f64 [F,2]   x, y of the centre of mass [m]
///     /floe/orientation       f64 [F,4]   w, x, y, z, body to world
///     /floe/fixed             u8  [F]     1: unbroken ice
///     /shape/spheres          i64 [K]     rows of each shape in the arrays below; so also
///                                         surface_spheres, creases, vertices, triangles
///     /shape/volume, area     f64 [K]     [m3], [m2], exact; so also centroid [K,3], inertia [K,9]
///     /sphere/center, volume  f64 [N,3], [N]   surface spheres of a shape first
///     /surface/normal         f32 [S,3]   and area f64 [S], normal_spread f32 [S]
///     /crease/sphere, normal  i32 [C], f32 [C,3]     sphere: counted within its shape
///     /mesh/vertices          f64 [V,3]   body axes [m]
///     /mesh/triangles         i32 [T,3]   vertices counted within their shape
///
/// The columns have the meanings of a sphere set's (spheres_file.hpp).
/// @throws Error (exit code 1) when the file cannot be written; nothing half-written stays behind.
void write_field(const std::filesystem::path& path, const Field& field);

/// Reads and checks a field: format, lengths, ranges, finite numbers, unit normals, the seal
/// (sealed_file.hpp), each shape's solid and shares against its mesh (sphere_set_faults.hpp).
/// @throws Error (exit code 2) naming the file and the dataset.
Field read_field(const std::filesystem::path& path);

}  // namespace ice
