// SPDX-License-Identifier: GPL-3.0-or-later
/// Loads of the water that moves along with floes: docs/method.md, section 6.
#pragma once

#include <span>

#include "solver/case/case.hpp"
#include "solver/loads/load_floes.hpp"

namespace ice {

/// Adds to floes' loads those of their added mass A (world axes) that are no inertia. With the
/// velocity through the water u = v - v_w, v_w being the water's at the centre of mass, and the
/// floe's angular velocity w,
///
///     T = -u x A u                                  (the Munk moment)
///     F = (dA/dt) v_w + A Dv_w/Dt,   (dA/dt) v_w = w x (A v_w) - A (w x v_w)
///
/// (equation (P3), Kirchhoff's equations), of first order in dt.
///
/// A Dv_w/Dt only where the flow's pressure acts (flow.pressure), whose force is rho V Dv_w/Dt. The
/// loads that the water's own motion causes are part of FloeLoad::pressure, and so of the water's
/// work.
/// @param loads  of load_floes(), as many
/// @pre bodies.have_added_mass()
void add_water_inertia(const Scene& scene, const Case& parameters,
                       std::span<const std::int32_t> floes, std::span<FloeLoad> loads);

}  // namespace ice
