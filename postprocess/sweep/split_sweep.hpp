// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// The runs of a sweep by dimension, 3D first: forces of a 3D run are newtons, those of a 2D run
/// newtons per metre of breadth, so they share no chart and no table. Each part has axes of its
/// own. A run without a summary belongs where its case says, else to the first part. A sweep of
/// one dimension comes back as it is.
std::vector<Sweep> split_sweep(const Sweep& sweep);

/// 3, or 2 for a sweep per metre of breadth. @pre of one dimension
int dimension_of(const Sweep& sweep);

}  // namespace ice::sweep
