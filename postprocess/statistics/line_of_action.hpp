// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/formats/run_file.hpp"

namespace ice::statistics {

/// The mean load of the ice on the ship as one force and where it acts, axes of the ship, which
/// does not turn.
struct LineOfAction {
    Vec3 force = Vec3::Zero();    ///< mean [N] (2D: N per metre)
    Vec3 moment = Vec3::Zero();   ///< mean about the hull mesh's origin [N m] (2D: N)
    double from = 0.0, to = 0.0;  ///< averaged time [s]
    /// Mean place of all contacts, weighted by normal force and time: the centre of normal load
    /// [m]. None without contacts in the averaged frames.
    std::optional<Vec3> center;
    /// Point of the mean force's line of action that is nearest to `center` (else to the origin)
    /// [m]: with c that place, c + f x (m - c x f) / |f|^2. None without a force.
    std::optional<Vec3> point;
    /// The couple about the line itself, which no choice of the point removes [N m] (2D: 0),
    /// positive by the right hand along the force.
    double couple = 0.0;
};

/// Means over the history samples with t >= from [s]. A run without samples there gives zeros.
LineOfAction find_line_of_action(const RunData& run, double from);

}  // namespace ice::statistics
