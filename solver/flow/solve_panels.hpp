// SPDX-License-Identifier: GPL-3.0-or-later
/// The flow that a moving body makes: strengths of its source panels.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/flow/panel_sums.hpp"

namespace ice {

/// A body at 1 m/s along `direction` through water at rest, and how well its panels do.
struct PanelFlow {
    PanelBody body;
    std::vector<double> strength;     ///< of each panel [m/s]
    int iterations = 0;               ///< of the linear solver
    double residual = 0.0;            ///< area-rms of |v . n - n_x| at check_points() [m/s]
    double worst = 0.0;               ///< its largest [m/s]
    Vec3 worst_place = Vec3::Zero();  ///< where that is [m]
    double net_flux = 0.0;            ///< sum of s A over sum of |s A| [-]: 0 for a closed body
};

/// Solves for strengths with which the mean of v . n over each panel is that of direction . n, the
/// mean taken at flux_points(): no water passes through the hull (Hess and Smith, 1967; equation
/// (22)). Eigen's BiCGSTAB (van der Vorst, SIAM Journal on Scientific and Statistical Computing
/// 13(2), 1992) to 1e-10, 20 iterations or fewer for hulls. Of a symmetric body only motion in the
/// plane y = 0, and at z = 0 only motion along the water, have such panels' images.
/// @param direction  of the motion, unit
/// @throws Error (exit code 1) where the solver does not settle: thin plates, panels that cross
PanelFlow solve_panels(PanelBody body, const Vec3& direction = Vec3::UnitX());

/// Strengths [m/s] with which the mean of v . n over each panel has the wanted value: a column for
/// each right-hand side. As solve_panels(), whose right-hand side is direction . n.
/// @param wanted      a row for each panel [m/s]
/// @param iterations  of the linear solver for the last column; may be null
Eigen::MatrixXd solve_strengths(const PanelBody& body, const Eigen::MatrixXd& wanted,
                                int* iterations = nullptr);

/// Flow at points [m], on all threads; the same bits for any number. None for no points.
std::vector<FlowSample> flow_at(const PanelFlow& flow, std::span<const Vec3> points);

}  // namespace ice
