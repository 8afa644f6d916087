// SPDX-License-Identifier: GPL-3.0-or-later
/// How near spheres of two kinds may come while their bodies move a little.
#pragma once

#include <array>

#include "solver/narrow/kind_pair.hpp"

namespace ice {

/// How two spheres may move before they are measured again.
struct Leeway {
    double distance;  ///< of any of their points in the other one's axes [m]
    double angle;     ///< of the turn between them [rad]
};

/// A bound on later gaps: as long as b has moved by at most s <= leeway.distance relative to a and
/// turned by at most leeway.angle, measure_gap_surface gives a gap of at least this less s, or none
/// within `reach` [m], the larger of both shapes'. Infinite, and minus infinite where nothing can
/// be said.
///
/// Every normal that the rule may choose is fixed in one of the two bodies, so that the gap along
/// it changes by no more than they move; only the normal across two edges turns faster than that.
class KindBound {
public:
    /// @param a, b  one sphere of each kind, whose centre does not matter; both outlive this
    KindBound(const SphereSurface& a, const SphereSurface& b, bool prefer_a, double reach,
              const Leeway& leeway);

    /// @param center_a, center_b  of the two spheres, in the axes of a and b [m]
    double least(const Vec3& center_a, const Vec3& center_b);

private:
    // A normal across two edges, from a to b.
    struct Crossing {
        Vec3 normal;
        double turn;  // by how much it may turn [rad]
        double skew;  // how far apart their corners may be, in reaches of one
        Vec3 edge;    // a's
    };

    void list_faces();
    void list_crossings();
    double least_along(const Vec3& center_a, const Vec3& center_b) const;
    double least_of_edges(const Vec3& center_a, const Vec3& center_b);
    double least_across(const Vec3& d, const Vec3& between);

    const SphereSurface *a_, *b_;
    double far_;  // across a normal, beyond which there is nothing [m]
    Leeway leeway_;
    bool a_is_surface_;
    KindRule rule_;
    std::uint8_t faces_ = 0;
    std::int8_t crossings_ = -1;         // -1: not listed yet
    Vec3 offset_a_, offset_b_;           // from the centres to the foremost points [m]
    std::array<KindDirection, 6> face_;  // the first one is the only one of rule `direction`
    std::array<bool, 6> certain_{};      // will the face's normal surely be one of both?
    std::array<Crossing, 18> crossing_;
};

}  // namespace ice
