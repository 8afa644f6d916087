// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/feature_pair.hpp"

#include <Eigen/Geometry>

#include "solver/narrow/feature/edge_crossings.hpp"

namespace ice {

AxisChoice choose_axis_rule(const Feature& a, const Feature& b, bool prefer_reference_a,
                            double slack) {
    // The flatter feature is the reference: the one with the smaller half angle, a where both
    // are equal. Two edges or vertices compare all their axes instead.
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    AxisChoice out{AxisRule::never, same || a.spread_cos > b.spread_cos, Vec3::Zero()};
    if (a.cone.count > 0 && b.cone.count > 0) {
        out.rule = AxisRule::all_axes;
        return out;
    }
    // A reference with a spread of its own turns its normal with the line of centres: no axis
    // is common to all spheres of the types.
    const bool mean = same && !prefer_reference_a;
    out.rule = AxisRule::in_full;
    if ((out.reference_is_a ? a : b).spread_cos != 1.0 || (mean && b.spread_cos != 1.0)) return out;
    out.rule = AxisRule::never;
    // from here on one axis, fixed in one body, serves all spheres of both types
    out.normal = out.reference_is_a ? a.normal : Vec3(-b.normal);
    if (mean) {
        out.normal = a.normal - b.normal;
        const double length = out.normal.norm();
        if (length < 1.0 - slack) return out;  // the faces are turned away
        out.normal /= length;
    }
    if (belongs(a, out.normal, slack) && belongs(b, -out.normal, slack))
        out.rule = AxisRule::face_axis;
    return out;
}

FeaturePair::FeaturePair(const Feature& a, const Feature& b, bool prefer_reference_a)
    : a_(&a), b_(&b), prefer_reference_a_(prefer_reference_a) {
    const AxisChoice meeting = choose_axis_rule(a, b, prefer_reference_a);
    rule_ = meeting.rule;
    reference_is_a_ = meeting.reference_is_a;
    // The support point of an edge or vertex is its apex in any direction; that of a face
    // depends on n.
    const Vec3 n = rule_ == AxisRule::all_axes ? Vec3(-b.normal) : meeting.normal;
    offset_a_ = support_offset(a, n);
    offset_b_ = support_offset(b, -n);
    if (rule_ == AxisRule::face_axis) face_[0].normal = meeting.normal;
    if (rule_ != AxisRule::all_axes) return;
    list_faces();
    list_edge_axes();
    if (faces_ + edge_axes_ == 0) rule_ = AxisRule::never;
}

// A face's normal is one of its own edge's or corner's.
void FeaturePair::list_faces() {
    const auto add = [&](const Vec3& n, const NormalCone& other, const Vec3& outward) {
        if (!other.contains(outward, kSlantOnEdge)) return;
        face_[faces_++] = {n, footprint(*a_, n), footprint(*b_, n)};
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(a_->cone.count); ++k)
        add(a_->cone.normal[k], b_->cone, -a_->cone.normal[k]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(b_->cone.count); ++k)
        add(-b_->cone.normal[k], a_->cone, -b_->cone.normal[k]);
}

void FeaturePair::list_edge_axes() {
    for_each_crossing(a_->cone, b_->cone, 0.0,
                      [&](int edge_a, int edge_b) { add_edge_axis(edge_a, edge_b); });
}

void FeaturePair::add_edge_axis(int edge_a, int edge_b) {
    const NormalCone &fa = a_->cone, &fb = b_->cone;
    const Vec3 ea = fa.edge(edge_a), eb = fb.edge(edge_b);
    const Vec3 across = ea.cross(eb);
    const double sine = across.norm();
    if (sine <= kParallel) return;
    // parallel edges: kSlantOnEdge leaves them a face axis
    EdgeAxis c;
    c.normal = 1.0 / sine * across;
    // The cross product has no sign of its own: both senses are tried. An axis separates two edges
    // if it lies in the normal cone of one and its opposite in that of the other (Gauss map).
    const NormalCone::Signs of_a = fa.contains_either_sign(c.normal, kSlantOnEdge);
    if (!of_a.forth && !of_a.back) return;
    const NormalCone::Signs of_b = fb.contains_either_sign(c.normal, kSlantOnEdge);
    c.forth = of_a.forth && of_b.back;
    c.back = of_a.back && of_b.forth;
    if (!c.forth && !c.back) return;
    c.ends = fa.ends() || fb.ends();
    // closest_on_lines's (between x eb) . across / square, turned round
    const double square = across.squaredNorm();
    c.along_a = eb.cross(across) / square;
    c.along_b = ea.cross(across) / square;
    c.edge_a = static_cast<std::int8_t>(edge_a);
    c.edge_b = static_cast<std::int8_t>(edge_b);
    edge_axis_[edge_axes_++] = c;
}

Gap FeaturePair::measure_face_axis(const Vec3& center_a, const Vec3& center_b) const {
    const Vec3& n = face_[0].normal;
    // the axis would push the bodies into each other
    if (n.dot(center_b - center_a) <= 0.0) return kNone;
    // equation (3), with the support points of both spheres
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const double gap = n.dot(point_b - point_a);
    const Vec3 at =
        part_across(reference_is_a_ ? Vec3(point_b - center_a) : Vec3(point_a - center_b), n);
    return {n, gap, at.squaredNorm(), reference_is_a_, true};
}

// Do the edges meet before their ends?
bool FeaturePair::meet(const EdgeAxis& c, const Vec3& between) const {
    if (!c.ends) return true;
    return !(a_->cone.ends() && c.along_a.dot(between) < -kBeyond * a_->radius) &&
           !(b_->cone.ends() && c.along_b.dot(between) < -kBeyond * b_->radius);
}

// Calls visit(across) for the normals across two edges whose gap is more than `least`, which may
// change, and that meet.
template <class Visit>
void FeaturePair::for_each_across(const Vec3& d, const Vec3& between, const double& least,
                                  const Visit& visit) const {
    for (std::uint8_t k = 0; k < edge_axes_; ++k) {
        const EdgeAxis& c = edge_axis_[k];
        // of the two senses of the cross product the one from a to b
        const double along = c.normal.dot(d), sign = along < 0.0 ? -1.0 : 1.0;
        const double now = sign * c.normal.dot(between);
        if (now <= least || along == 0.0 || !(along < 0.0 ? c.back : c.forth) || !meet(c, between))
            continue;
        visit(DirectedEdgeAxis{&c, sign, now});
    }
}

FeaturePair::DirectedEdgeAxis FeaturePair::best_edge_axis(const Vec3& d, const Vec3& between,
                                                          double least) const {
    DirectedEdgeAxis largest{nullptr, 1.0, least};
    for_each_across(d, between, largest.gap, [&](const DirectedEdgeAxis& now) { largest = now; });
    return largest;
}

FeaturePair::DirectedEdgeAxis FeaturePair::nearest_edge_axis(const Vec3& d,
                                                             const Vec3& between) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    DirectedEdgeAxis nearest{nullptr, 1.0, 0.0};
    double least = kInfinity;
    for_each_across(d, between, -kInfinity, [&](const DirectedEdgeAxis& now) {
        const LineParameters at = now.axis->at(between);
        const double beside = distance_sq(at);
        if (beside >= least || !is_within_patches(at, *a_, *b_)) return;
        least = beside;
        nearest = now;
    });
    return nearest;
}

Gap FeaturePair::gap_across(const DirectedEdgeAxis& across, const Vec3& between) const {
    const EdgeAxis& c = *across.axis;
    if (meet_elsewhere(between, across.gap)) return kNone;
    return crossing_gap(across.sign * c.normal, across.gap, c.at(between), reference_is_a_,
                        c.edge_a, c.edge_b);
}

bool FeaturePair::meet_elsewhere(const Vec3& between, double gap) const {
    return gap < 0.0 &&
           (is_less_deep(*a_, *b_, between, gap) || is_less_deep(*b_, *a_, -between, gap));
}

Gap FeaturePair::measure_all_axes(const Vec3& center_a, const Vec3& center_b) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    // equation (3) for all axes: both support points are the apexes, whatever the axis
    const Vec3 d = center_b - center_a;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 between = point_b - point_a;
    const FaceAxis* face = nullptr;
    double gap = -kInfinity;
    // The widest gap among the face axes that point from a to b.
    for (std::uint8_t k = 0; k < faces_; ++k) {
        const double now = face_[k].normal.dot(between);
        if (now <= gap || face_[k].normal.dot(d) <= 0.0) continue;
        face = &face_[k];
        gap = now;
    }
    const DirectedEdgeAxis across = best_edge_axis(d, between, gap);
    // An edge axis with a larger gap than any face axis separates the features: it decides alone.
    if (across.axis) return gap_across(across, between);
    if (!face || meet_elsewhere(between, gap)) return kNone;
    // The reference is the face over which the other's apex lies: a's unless b's apex misses it
    // by more than a's apex misses b's face. Farther out than the patch radius the apex belongs
    // to another sphere.
    const Vec3& n = face->normal;
    const double offset_a_sq =
        distance_from(face->footprint_a, a_->radius, part_across(point_b - center_a, n), 0.0);
    const double offset_b_sq =
        distance_from(face->footprint_b, b_->radius, part_across(point_a - center_b, n), 0.0);
    const bool on_a = offset_a_sq <= offset_b_sq + kFlush * a_->radius * a_->radius;
    const bool over = on_a ? offset_a_sq <= a_->patch_radius * a_->patch_radius
                           : offset_b_sq <= b_->patch_radius * b_->patch_radius;
    // The crossing replaces the face axis where the apex is not over the face, or where it is
    // deeper along nearly the same normal (measure_gap.hpp).
    const DirectedEdgeAxis nearest = nearest_edge_axis(d, between);
    if (nearest.axis && (!over || (nearest.gap < gap - kFlush * std::min(a_->radius, b_->radius) &&
                                   nearest.sign * nearest.axis->normal.dot(n) > kSameFace)))
        return gap_across(nearest, between);
    if (!over) return kNone;
    return {n, gap, on_a ? offset_a_sq : offset_b_sq, on_a, true};
}

Gap FeaturePair::measure_in_full(const Vec3& center_a, const Vec3& center_b) const {
    // the definition itself: centres enter the choice of the normal
    Feature a = *a_, b = *b_;
    a.center = center_a;
    b.center = center_b;
    return measure_gap_surface(a, b, prefer_reference_a_);
}

}  // namespace ice
