// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/read_mesh.hpp"
#include <assimp/scene.h>
#include "common/cli/console.hpp"
#  include "preprocess/fill/fill_spheres.hpp"
