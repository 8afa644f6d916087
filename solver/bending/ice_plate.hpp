// SPDX-License-Identifier: GPL-3.0-or-later
/// Ice as a thin elastic plate on water: the load under which it breaks by bending
/// (docs/method.md, section 5).
#pragma once

namespace ice {

/// A plate of ice on water. All members > 0.
struct IcePlate {
    double thickness;          ///< h [m]
    double flexural_strength;  ///< sigma_f, largest bending stress [Pa]
    double elastic_modulus;    ///< E [Pa]
    double poisson_ratio;      ///< nu [-], < 0.5
    double water_weight;       ///< rho_w g: weight of water per volume [N/m3]
};

/// Characteristic length of the plate [m], over which a load at a point bends it:
///
///     l = (E h^3 / (12 rho_w g (1 - nu^2)))^(1/4)
double characteristic_length(const IcePlate& plate);

/// Load per breadth on the edge of a semi-infinite beam on water that breaks it [N/m]:
///
///     P = exp(pi/4) / (6 sin(pi/4)) sigma_f h^2 lambda,   lambda = (3 rho_w g / (E h^3))^(1/4),
///
/// which is 0.680 sigma_f (rho_w g h^5 / E)^(1/4).
/// Source: Hetényi, Beams on Elastic Foundation, 1946, chapter III.
double beam_breaking_load(const IcePlate& plate);

/// Where that load breaks the beam: how far its largest bending moment is from its edge [m].
///
///     M(x) = P / lambda exp(-lambda x) sin(lambda x),   dM/dx = 0 at x = pi / (4 lambda)
double beam_breaking_length(const IcePlate& plate);

/// Nevel's bracket: load that breaks a wedge on water over tan(angle / 2) / 3 sigma_f h^2, when it
/// is spread evenly over the wedge from its tip to the distance `ratio` x l:
///
///     1.05 + 2.0 ratio + 0.50 ratio^3
///
/// [-], at a ratio b / l [-], >= 0. The three numbers are those of the source, fitted to the wedge.
/// Within 1 % of the wedge as a beam of growing breadth up to ratio 0.7, 4 % below it at 1.
/// Source: Nevel, The ultimate failure of a floating ice sheet, IAHR Ice Symposium, 1972; taken
/// from later papers that print it, and compared with a beam's solution in tests/solver.
double nevel_bracket(double ratio);

/// Load that breaks a piece of the opening angle `angle` [rad], 0 to pi, off a plate that has
/// cracked radially into wedges of at most 36 degrees, five over a straight edge [N]:
///
///     P = n tan(angle / (2 n)) / 3 sigma_f h^2 nevel_bracket(load_length / l)
///     n = ceil(5 angle / pi)
///
/// @param load_length  distance from the tip over which the load is spread [m]
double wedge_breaking_load(const IcePlate& plate, double angle, double load_length);

/// Kashtelyan's load for the same piece [N]: (angle / pi)^2 sigma_f h^2, to be multiplied by the
/// measured factor. Models of ships in level ice use about 3.1, which holds the water's inertia
/// and contact along the whole edge; a dry static plate has 0.55 to 0.8 at angle pi.
/// Source: Kashtelyan et al. 1968 as used by Su, Riska, Moan, Cold Regions Science and Technology,
/// 2010; the value 3.1 is unverified: it was not read in either.
double kashtelyan_breaking_load(const IcePlate& plate, double angle);

}  // namespace ice
