// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers, units and axes of a scene that assimp has read.
#pragma once

#include <assimp/matrix4x4.h>

#include <Eigen/Dense>
#include <string>

#include "preprocess/load/choose_frame.hpp"

struct aiScene;

namespace ice {

/// The shortest decimal that gives the same float: assimp keeps numbers as floats, in which the
/// "0.3" of a file is 0.300000012, and models are drawn in round numbers. 0, infinite numbers and
/// NaN stay as they are.
double undo_float(float x);

/// A node's transformation, each number by undo_float().
Eigen::Matrix4d to_matrix(const aiMatrix4x4& m);

/// "glTF", "Collada" or "FBX"; empty for formats without units and axes.
std::string format_of(const aiScene& scene);

/// The file's statements on unit and axes, from where assimp keeps them (import_scene.hpp).
/// @pre scene.mRootNode is there
FileFrame frame_of(const aiScene& scene);

}  // namespace ice
