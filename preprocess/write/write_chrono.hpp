// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/rigid_body.hpp"
#include "preprocess/write/sink.hpp"

namespace ice {

/// A set as a clump of Chrono's DEM-Engine: header "x,y,z,r", then rows [m] in the frame of the
/// centre of mass and the principal axes, without comments (its CSV reader accepts none). Mass,
/// moments and pose are in the JSON file beside it (common/formats/rigid_body_file.hpp):
///
///     LoadClumpType(mass_kg, moments_kg_m2, file, material)
///
/// puts the body's centre of mass at the origin; centroid_m and quaternion_xyzw, given as initial
/// position and orientation, put it where the mesh is. DEM-Engine reads single precision.
void write_chrono_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink);

}  // namespace ice
