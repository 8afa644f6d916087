// SPDX-License-Identifier: GPL-3.0-or-later
/// Candidate separating axes of two feature types, computed once for all their spheres.
///
/// Spheres of one feature type (Shape::feature_type) differ in place only: all spheres along an
/// edge of a floe have the same normals. The candidate axes of two types are therefore computed
/// once per pair of bodies; each pair of spheres then costs a few dot products.
#pragma once

#include <array>
#include <cstdint>

#include "solver/narrow/feature/gap_rule.hpp"
#include "solver/narrow/feature/measure_gap.hpp"

namespace ice {

/// How the normal of two feature types is chosen.
enum class AxisRule : std::uint8_t {
    never,      ///< no contact: they do not face each other, whatever their places
    face_axis,  ///< one axis, fixed in one of the bodies
    all_axes,   ///< two edges or vertices: of all face and edge axes the one with the largest gap
    in_full     ///< the normal turns with the line of centres: each pair of spheres by itself
};

/// A face's normal as candidate axis, fixed in one of the two bodies.
struct FaceAxis {
    Vec3 normal;                         ///< unit, from a to b
    Footprint footprint_a, footprint_b;  ///< of the two edges or vertices on that face
};

/// measure_gap_surface for two feature types, to the last bit (but for edges that meet at their
/// very ends, to rounding).
class FeaturePair {
public:
    /// @param a, b  one feature of each type, whose centre does not matter; both outlive this
    FeaturePair(const Feature& a, const Feature& b, bool prefer_reference_a);

    /// The gap of two spheres of these types; invalid where measure_gap_surface's is.
    /// @param center_a, center_b  of the two spheres, in the axes of a and b [m]
    Gap measure(const Vec3& center_a, const Vec3& center_b) const {
        if (rule_ == AxisRule::all_axes) return measure_all_axes(center_a, center_b);
        if (rule_ == AxisRule::face_axis) return measure_face_axis(center_a, center_b);
        return rule_ == AxisRule::never ? kNone : measure_in_full(center_a, center_b);
    }

private:
    // The cross product of two edges as candidate axis.
    struct EdgeAxis {
        Vec3 normal;                       // of either sign
        bool forth = false, back = false;  // is it in both cones from a to b, from b to a?
        bool ends = false;                 // does one of the edges end at its vertex?
        Vec3 along_a, along_b;  // places of the closest points: this . (from apex to apex)
        std::int8_t edge_a, edge_b;

        LineParameters at(const Vec3& between) const {
            return {along_a.dot(between), along_b.dot(between)};
        }
    };
    // One of these with its sign and the gap along it.
    struct DirectedEdgeAxis {
        const EdgeAxis* axis;
        double sign, gap;  // 1 or -1, so that sign normal is from a to b; [m]
    };
    static inline const Gap kNone{Vec3::UnitZ(), 0.0, 0.0, true, false};

    void list_faces();
    void list_edge_axes();
    void add_edge_axis(int edge_a, int edge_b);
    // measure() by its rule: along the only face axis; along all axes; by measure_gap_surface().
    Gap measure_face_axis(const Vec3& center_a, const Vec3& center_b) const;
    Gap measure_all_axes(const Vec3& center_a, const Vec3& center_b) const;
    Gap measure_in_full(const Vec3& center_a, const Vec3& center_b) const;
    template <class Visit>
    void for_each_across(const Vec3& d, const Vec3& between, const double& least,
                         const Visit& visit) const;
    // The axis with the largest gap above `least`; none: null.
    DirectedEdgeAxis best_edge_axis(const Vec3& d, const Vec3& between, double least) const;
    // The axis of the edges that cross nearest to the two spheres, within both patch radii; none:
    // null.
    DirectedEdgeAxis nearest_edge_axis(const Vec3& d, const Vec3& between) const;
    Gap gap_across(const DirectedEdgeAxis& across, const Vec3& between) const;
    bool meet(const EdgeAxis& c, const Vec3& between) const;
    bool meet_elsewhere(const Vec3& between, double gap) const;

    const Feature *a_, *b_;
    bool prefer_reference_a_, reference_is_a_;
    AxisRule rule_;
    std::uint8_t faces_ = 0, edge_axes_ = 0;  // that may separate them
    Vec3 offset_a_, offset_b_;                // from the centres to the foremost points [m]
    std::array<FaceAxis, 6> face_;            // the first one is the only one of rule `face_axis`
    std::array<EdgeAxis, 9> edge_axis_;
};

/// The rule of two feature types, and the axis where there is only one.
struct AxisChoice {
    AxisRule rule;
    bool reference_is_a;
    Vec3 normal;  ///< of rule `face_axis`
};
/// @param slack  widens all bounds [rad], >= 0: with it `never` holds for any rotation up to it
AxisChoice choose_axis_rule(const Feature& a, const Feature& b, bool prefer_reference_a,
                            double slack = 0.0);

}  // namespace ice
