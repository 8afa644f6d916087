// SPDX-License-Identifier: GPL-3.0-or-later
/// Lower bounds of the gaps of two feature types, for any motion within a skin.
#pragma once

#include <array>

#include "solver/narrow/feature/feature_pair.hpp"

namespace ice {

/// Relative motion of two bodies within which a neighbour list stays valid.
struct Skin {
    double distance;  ///< of any point of one body in the other one's axes [m]
    double angle;     ///< of the relative rotation [rad]
};

/// A lower bound of later gaps. While b has moved by at most s <= skin.distance relative to a and
/// turned by at most skin.angle, measure_gap_surface gives a gap of at least this bound less s, or
/// no contact within `patch_radius` [m], the larger one. Infinite: no contact is possible; minus
/// infinite: there is no bound.
///
/// Face axes are fixed in one of the two bodies, so the gap along them changes by no more than the
/// motion; the cross product of two edges turns faster, and its bound includes that rotation.
class FeaturePairBound {
public:
    /// @param a, b  one feature of each type, whose centre does not matter; both outlive this
    /// @param patch_radius  the larger one [m]
    FeaturePairBound(const Feature& a, const Feature& b, bool prefer_reference_a,
                     double patch_radius, const Skin& skin);

    /// The bound for two spheres of these types [m].
    /// @param center_a, center_b  of the two spheres, in the axes of a and b [m]
    double least(const Vec3& center_a, const Vec3& center_b);

private:
    // The cross product of two edges, from a to b.
    struct EdgeAxis {
        Vec3 normal;
        double turn;  // largest rotation of the normal within the skin [rad]
        double skew;  // largest distance of their apexes, in patch radii
        Vec3 edge;    // a's
    };

    void list_faces();
    void list_edge_axes();
    void add_edge_axis(int edge_a, int edge_b);
    double least_along(const Vec3& center_a, const Vec3& center_b) const;
    double least_of_edges(const Vec3& center_a, const Vec3& center_b);
    double least_across(const Vec3& d, const Vec3& between);

    const Feature *a_, *b_;
    double far_;  // patch radius and skin: no contact is farther across a normal [m]
    Skin skin_;
    bool reference_is_a_;
    AxisRule rule_;
    std::uint8_t faces_ = 0;
    std::int8_t edge_axes_ = -1;     // -1: not listed yet
    Vec3 offset_a_, offset_b_;       // from the centres to the foremost points [m]
    std::array<FaceAxis, 6> face_;   // the first one is the only one of rule `face_axis`
    std::array<bool, 6> certain_{};  // will the face's normal surely be one of both?
    std::array<EdgeAxis, 18> edge_axis_;
};

}  // namespace ice
