// SPDX-License-Identifier: GPL-3.0-or-later
/// Overlap that a step's velocities leave: bodies move apart, or ice is crushed
/// (docs/method.md, section 5).
#pragma once

#include <algorithm>
#include <vector>

#include "solver/contact/constraints.hpp"

namespace ice {

/// Overlap that is left alone, as a share of the smaller contact sphere's radius [-]: contacts that
/// just touch stay contacts, and a case may begin with it. Places rounded to a millimetre, normals
/// stored as floats and the change of the nearest sphere make overlaps of this size between floes
/// that only touch. More leaves bodies deeper in each other; with less, position correction moves
/// floes that only touch.
constexpr double kToleratedOverlap = 0.02;

/// The radius of the smaller one of the bodies' spheres [m], in which overlaps are measured.
double smaller_radius(const Scene& scene, const Constraint& c);

/// Small moves that shrink overlaps; they change poses, never velocities or reported forces.
struct PositionCorrections {
    std::vector<Vec3> shift;  ///< by body, world axes [m]
    std::vector<Vec3> turn;   ///< by body, rotation vector in world axes [rad]
};

/// Extends a move to at least `length` [m] along a unit direction. A second push on a sphere
/// extends the move only where the first is shorter along its direction.
inline void add_along(double length, const Vec3& direction, Vec3& move) {
    move += std::max(0.0, length - move.dot(direction)) * direction;
}

/// Opens or crushes overlaps. Between steps it keeps its memory and nothing else.
class Overlaps {
public:
    /// Moves overlapping bodies apart by a part of the overlap that this step's velocities leave
    /// (equation (12)):
    ///
    ///     n . (d_b - d_a) >= min(dt / 0.1 s, 1/5) min(overlap - R / 50, R / 2)
    ///
    /// solved as the velocities are, by Gauss-Seidel on displacements d. With steps up to 0.02 s a
    /// deep pair thus opens at five radii R a second; with longer ones a tenth of a radius in each
    /// step, which is slower.
    ///
    /// Contacts at their bound are left out, because that ice is crushed, but for those in `uncut`
    /// (CrushSolids::uncut). A free ship moves by its
    /// share, of its mass and the water's that moves along; one on a prescribed course does not
    /// move.
    /// @param dt   time step [s]
    /// @param out  resized to all bodies; zero for bodies without overlap. It is that of the last
    ///             step, or empty: only the ship and moving bodies are cleared
    void correct_positions(const Scene& scene, const std::vector<Constraint>& constraints,
                           const std::vector<std::size_t>& uncut, double dt,
                           PositionCorrections& out);

    /// Spheres of ice at their bound are crushed: the overlap that the step leaves at such a
    /// contact is taken off the ice for good. A second contact that presses on a sphere extends
    /// the move only where the first is shorter along its normal. Rigid ice has no bound. Of solids
    /// CrushSolids does the same.
    /// @param dt  time step [s]
    /// @pre called before the poses advance, after resolve_rest, with the constraints' law and dt
    void crush(Scene& scene, const std::vector<Contact>& contacts,
               const std::vector<Constraint>& constraints, const ContactLaw& law, double dt);

private:
    struct Push {
        std::size_t constraint;
        double target, done;    // move along the normal [m]; impulse so far [kg m]
        Vec3 turn_a, turn_b;    // by a unit push: I^-1 (r x n) [rad/(kg m)]
        double effective_mass;  // 1 / k(n) [kg]
        Vec3 ship_shift;        // by a unit push, of a free ship [1/kg]
    };
    // @param target  move along the normal [m]
    static Push push_of(const Bodies& bodies, const Constraint& c, std::size_t row, double target);

    // A sphere that one constraint crushes.
    struct Crushing {
        std::int32_t body, sphere;
        std::size_t constraint;
        double gap;    // at the end of the step [m]
        Vec3 inwards;  // world axes
    };
    std::vector<Push> pushes_;
    std::vector<Crushing> crushings_;
};

}  // namespace ice
