// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// One entry of the energy ledger as a force.
struct WorkShare {
    const char* title;
    double force;  ///< energy per metre of the ship's travel [N; 2D: N/m], or NaN
};

/// Uses of the ship's work, mean over a point's runs: first the work itself, then its uses, which
/// add up to it but for the residual (docs/energy.md). Energy put in by opened overlaps and moving
/// water counts negative. Work per metre is the mean force over the whole run, start-up included,
/// while the resistance is that from output.average_from on.
///
/// NaN where the runs have no constant speed, or no energy ledger.
std::vector<WorkShare> share_work(const Sweep& sweep, const Point& point);

}  // namespace ice::sweep
