// SPDX-License-Identifier: GPL-3.0-or-later
/// The flow of source panels at points: docs/method.md, section 6.
#pragma once

#include <numbers>
#include <span>

#include "solver/flow/source_panel.hpp"

namespace ice {

/// Flow at unit distance from a source of strength and area 1: 1 / (4 pi) [-].
constexpr double kPerSphere = 0.25 / std::numbers::pi;

/// Least denominator r_k + r_(k+1) - l_k of L_k over l_k [-]: there the logarithm is 33. A larger
/// value lowers the speed on an edge, where it is no number of the flow in any case.
constexpr double kLeastGap = 1e-14;

/// The flow at a point, for a ship at 1 m/s along +x.
struct FlowSample {
    Vec3 velocity = Vec3::Zero();  ///< [m/s], in the earth frame
    double potential = 0.0;        ///< whose gradient it is, 0 far away [m2/s]
};

/// Flow of a body's panels and their images at points:
///
///     v = 1/(4 pi) sum_j s_j sum over images (sum_k m_k L_k + Omega n),
///     phi = -1/(4 pi) sum_j s_j sum over images (sum_k m_k . (p_k - x) L_k + h Omega),
///     L_k = ln((r_k + r_(k+1) + l_k) / (r_k + r_(k+1) - l_k)),
///     tan(Omega / 2) = 2 A h' / d,
///     d = r_0 r_1 r_2 + (a_0 . a_1) r_2 + (a_1 . a_2) r_0 + (a_2 . a_0) r_1
///
/// with a_k = p_k - x, r_k its length, l_k and m_k an edge's length and outward normal, h = n . a_0
/// and h' = -h; beyond SourcePanel::far_squared a source in the centroid. Hess and Smith (1967);
/// the solid angle Omega as in van Oosterom and Strackee (1983). An image is the panel's flow at
/// the mirrored point, mirrored back. On an edge, where v grows like a logarithm, it stays finite.
///
/// Points beside each other in space cost less. Panels are added in their order: the same bits on
/// every instruction set, and mirrored points have mirrored flows bit for bit.
/// @param strength  of each panel [m/s]
/// @param out       as many as points
void sum_panels(const PanelBody& body, std::span<const double> strength,
                std::span<const Vec3> points, std::span<FlowSample> out);

/// Panels whose mean flux is computed, eight beside each other.
struct FluxTargets {
    static constexpr std::size_t kCount = 8;
    double x[3][kCount], y[3][kCount], z[3][kCount];  ///< flux_points(), 3 of each panel [m]
    double nx[kCount], ny[kCount], nz[kCount];        ///< normals, unit
};

/// Mean normal velocity through each target from each panel, with its images, at unit strength.
/// @param out  8 per panel of the body: those of panel j from 8 j on [m/s]
void mean_fluxes(const PanelBody& body, const FluxTargets& targets, std::span<double> out);

namespace reference {
// The definition, one point at a time: read this first.
void sum_panels(const PanelBody& body, std::span<const double> strength,
                std::span<const Vec3> points, std::span<FlowSample> out);
void mean_fluxes(const PanelBody& body, const FluxTargets& targets, std::span<double> out);
}  // namespace reference

}  // namespace ice
