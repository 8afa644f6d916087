// SPDX-License-Identifier: GPL-3.0-or-later
/// A set as a LIGGGHTS multisphere template: a file of spheres and the input line that reads it.
#pragma once

#include <string>

#include "common/geometry/rigid_body.hpp"
#include "preprocess/write/sink.hpp"

namespace ice {

/// Rows "x y z r" [m]: mesh axes, origin at the centre of mass. LIGGGHTS reads no comments there.
void write_liggghts_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink);

/// The `fix particletemplate/multisphere` command that reads the rows, for `include`.
///
/// It gives mass and inertia tensor and says `use_density`: then LIGGGHTS takes the spheres as they
/// are. With `use_volume` it would move them by its own Monte Carlo estimate of the centre of their
/// union (fix_template_multisphere.cpp, FixTemplateMultisphere::post_create, 3.8.0), 0.18 m for
/// three spheres along 2 m.
/// @param id  of the fix: letters, digits and underscores
std::string liggghts_text(const RigidBody& body, std::size_t count, const std::string& id,
                          const std::string& spheres_file);

}  // namespace ice
