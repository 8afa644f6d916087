// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "common/geometry/rigid_body.hpp"

namespace ice {

/// A rigid body beside a file of its spheres, as JSON text (schema spherize-body/1), SI units, all
/// digits: mass, principal moments, centroid and orientation in the mesh's frame.
///
/// @param spheres_file  name of the file that holds the spheres
/// @param frame         of the file's coordinates, in words, for the reader
/// @param count         its number of spheres
std::string rigid_body_text(const RigidBody& body, const std::string& spheres_file,
                            const std::string& frame, std::size_t count);

}  // namespace ice
