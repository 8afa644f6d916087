// SPDX-License-Identifier: GPL-3.0-or-later
/// A set as a YADE clump: a file of spheres and the script that loads it with the right mass.
#pragma once

#include <string>

#include "common/geometry/rigid_body.hpp"
#include "preprocess/write/sink.hpp"

namespace ice {

/// Rows "x y z r clumpId" [m], tabs between, clumpId 0: the frame of the centre of mass and the
/// principal axes, for `ymport.textClumps` as called by the script.
void write_yade_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink);

/// The Python script: a function `load(position, orientation, material)` that makes one clump with
/// the solid's mass and inertia, and a call of it when the script itself is run by YADE.
///
/// Setting `state.mass` and `state.inertia` after `textClumps` is not enough: the clump would still
/// turn about the centre of its spheres and along their axes, which YADE (Clump::updateProperties,
/// 2023.02a) takes from radii and densities alone. The script therefore adds one member that is no
/// sphere, without bound, at the centre of mass; it carries mass and inertia, and the spheres weigh
/// nothing while YADE adds them up.
///
/// @param spheres_file  its name, without quotes or backslashes (check_exports)
/// @param radius  of the spheres [m]: the extent of that member, for pictures
std::string yade_text(const RigidBody& body, double radius, const std::string& spheres_file);

}  // namespace ice
