// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits of the iteration that finds the strengths of panels and lines (Eigen's BiCGSTAB).
#pragma once

namespace ice {

/// Residual of the equations over their right side [-], far below the error of the panels
/// themselves, about 1 %. Larger is seen in the flow, smaller takes more iterations.
constexpr double kSolverTolerance = 1e-10;

/// Iterations at most [-]: hulls take 20 or fewer, so more shows a mesh whose equations have no
/// good solution. Larger only delays the error.
constexpr int kMostIterations = 200;

}  // namespace ice
