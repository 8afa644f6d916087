// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Reads the sphere sets of a case and places hull and floes.
///
/// Floes are numbered in the order of the case's groups, x fastest. Their height is floating
/// equilibrium unless a single floe states z. "brick" shifts every other column (along x) by half a
/// floe and its gap along y. "file" takes shapes and places from a field; its unbroken ice comes
/// last.
///
/// @throws Error (exit code 2) naming file or key: set of the wrong dimension, tracked floe that
///         does not exist, floe denser than water without a stated z, more than 10 million floes.
Scene build_scene(const Case& parameters);

/// Adds one floe of a shape; used by build_scene and by tests that build scenes in code.
/// @return its body index
std::size_t add_floe(Scene& scene, std::int32_t shape, double density, const Vec3& position,
                     const Quaternion& orientation, std::int32_t group, bool held);

/// An empty scene with the ship in it.
Scene make_scene(Shape hull, const Vec3& position, const Vec3& velocity);

}  // namespace ice
