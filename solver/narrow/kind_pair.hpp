// SPDX-License-Identifier: GPL-3.0-or-later
/// What the kinds of two spheres decide, wherever these spheres are.
///
/// Spheres of one kind (Shape::kind) differ by their places only: all along an edge of a floe have
/// the same normals. So which directions may part them is found once per kind with kind, and each
/// two spheres are left with a few products.
#pragma once

#include <array>
#include <cstdint>

#include "solver/narrow/gap_rule.hpp"
#include "solver/narrow/measure_gap.hpp"

namespace ice {

/// By what rule a kind meets another.
enum class KindRule : std::uint8_t {
    never,      ///< they do not face each other, wherever they are
    direction,  ///< along one direction, fixed in one of the bodies
    edges,      ///< two edges or corners that know their faces: by what parts them farthest
    afresh      ///< the normal turns with the line of centres: nothing is decided
};

/// A direction, fixed in one of two bodies, that may part spheres of two kinds.
struct KindDirection {
    Vec3 normal;                ///< from a to b
    Foothold under_a, under_b;  ///< what edges stand for there
};

/// measure_gap_surface for two kinds, to the last bit (but for edges that meet, to rounding, at
/// their very ends).
class KindPair {
public:
    /// @param a, b  one sphere of each kind, whose centre does not matter; both outlive this
    KindPair(const SphereSurface& a, const SphereSurface& b, bool prefer_a);

    /// @param center_a, center_b  of the two spheres, in the axes of a and b [m]
    Gap measure(const Vec3& center_a, const Vec3& center_b) const {
        if (rule_ == KindRule::edges) return measure_edges(center_a, center_b);
        if (rule_ == KindRule::direction) return measure_direction(center_a, center_b);
        return rule_ == KindRule::never ? kNone : measure_afresh(center_a, center_b);
    }

private:
    // The normal across two edges.
    struct Crossing {
        Vec3 normal;                       // one way or the other
        bool forth = false, back = false;  // is it a normal of both, from a to b, from b to a?
        bool ends = false;                 // does one of them end there?
        Vec3 along_a, along_b;  // how far from there they are nearest: this . (corner to corner)
        std::int8_t edge_a, edge_b;

        ice::Crossing at(const Vec3& between) const {
            return {along_a.dot(between), along_b.dot(between)};
        }
    };
    // One of these, which way it parts them and how far.
    struct Across {
        const Crossing* crossing;
        double way, gap;
    };
    static inline const Gap kNone{Vec3::UnitZ(), 0.0, 0.0, true, false};

    void list_faces();
    void list_crossings();
    void add_crossing(int edge_a, int edge_b);
    Gap measure_direction(const Vec3& center_a, const Vec3& center_b) const;
    Gap measure_edges(const Vec3& center_a, const Vec3& center_b) const;
    Gap measure_afresh(const Vec3& center_a, const Vec3& center_b) const;
    template <class Visit>
    void for_each_across(const Vec3& d, const Vec3& between, const double& least,
                         const Visit& visit) const;
    // Of largest gap, above `least`; none: null.
    Across largest_across(const Vec3& d, const Vec3& between, double least) const;
    // Of the edges that cross nearest to the two spheres, in reach of both; none: null.
    Across nearest_across(const Vec3& d, const Vec3& between) const;
    Gap gap_across(const Across& across, const Vec3& between) const;
    bool meet(const Crossing& c, const Vec3& between) const;
    bool meet_elsewhere(const Vec3& between, double gap) const;

    const SphereSurface *a_, *b_;
    bool prefer_a_, a_is_surface_;
    KindRule rule_;
    std::uint8_t faces_ = 0, crossings_ = 0;  // that may part them
    Vec3 offset_a_, offset_b_;                // from the centres to the foremost points [m]
    std::array<KindDirection, 6> face_;       // the first one is the only one of rule `direction`
    std::array<Crossing, 9> crossing_;
};

/// What rule two kinds follow, and the direction where it is the only one.
struct KindMeeting {
    KindRule rule;
    bool a_is_surface;
    Vec3 normal;  ///< of rule `direction`
};
/// @param slack  bounds are wider by this [rad]
KindMeeting find_meeting(const SphereSurface& a, const SphereSurface& b, bool prefer_a,
                         double slack = 0.0);

}  // namespace ice
