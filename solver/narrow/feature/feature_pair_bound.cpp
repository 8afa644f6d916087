// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/feature_pair_bound.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "solver/narrow/feature/edge_crossings.hpp"

namespace ice {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// More than any two directions differ by [rad], pi: every normal is possible, nothing is known. Any
// number above pi does the same.
constexpr double kAnyTurn = 4.0;

}  // namespace

FeaturePairBound::FeaturePairBound(const Feature& a, const Feature& b, bool prefer_reference_a,
                                   double patch_radius, const Skin& skin)
    : a_(&a), b_(&b), far_(patch_radius + skin.distance), skin_(skin) {
    // All bounds are widened by the skin's angle, so that no spheres are left out that may come to
    // touch. Edge axes are listed when they are first needed.
    const AxisChoice meeting = choose_axis_rule(a, b, prefer_reference_a, skin.angle);
    rule_ = meeting.rule;
    reference_is_a_ = meeting.reference_is_a;
    const Vec3 n = rule_ == AxisRule::all_axes ? Vec3(-b.normal) : meeting.normal;
    offset_a_ = support_offset(a, n);
    offset_b_ = support_offset(b, -n);
    if (rule_ == AxisRule::face_axis) face_[0].normal = meeting.normal;
    if (rule_ == AxisRule::all_axes) list_faces();
}

void FeaturePairBound::list_faces() {
    const auto add = [&](bool of_a, std::size_t k) {
        const NormalCone &own = (of_a ? a_ : b_)->cone, &other = (of_a ? b_ : a_)->cone;
        const Vec3 outward = -own.normal[k];  // of the other
        // Widened by the skin's angle: an axis that may become valid. Narrowed by it: one that
        // stays valid wherever the bodies turn within the skin.
        if (!other.contains(outward, kSlantOnEdge, skin_.angle)) return;
        certain_[faces_] = other.contains(outward, kSlantOnEdge, -skin_.angle);
        const Vec3 n = of_a ? own.normal[k] : outward;
        face_[faces_++] = {n, footprint(*a_, n), footprint(*b_, n)};
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(a_->cone.count); ++k) add(true, k);
    for (std::size_t k = 0; k < static_cast<std::size_t>(b_->cone.count); ++k) add(false, k);
}

// Both edges turn by at most skin.angle, so their cross product turns by at most angle / sine.
// Times the product's length this is at most 2 angle; where the product itself is shorter than
// that, no normal excludes it.
void FeaturePairBound::list_edge_axes() {
    edge_axes_ = 0;
    for_each_crossing(a_->cone, b_->cone, 2.0 * skin_.angle,
                      [&](int edge_a, int edge_b) { add_edge_axis(edge_a, edge_b); });
}

void FeaturePairBound::add_edge_axis(int edge_a, int edge_b) {
    const NormalCone &a = a_->cone, &b = b_->cone;
    const Vec3 ea = a.edge(edge_a), eb = b.edge(edge_b), across = ea.cross(eb);
    const double sine = across.norm();
    if (sine <= kParallel - skin_.angle) return;
    // nearly parallel edges: their cross product may take any direction within the skin
    const double turn = sine <= 2.0 * skin_.angle ? kAnyTurn : skin_.angle / (sine - skin_.angle);
    // both apexes one patch radius from the crossing: the sum of two vectors at the edges' angle is
    // their largest distance
    const double cosine = std::abs(ea.dot(eb));
    const double skew = std::sqrt(2.0 + 2.0 * std::min(1.0, cosine + skin_.angle));
    const Vec3 n = 1.0 / sine * across;
    const NormalCone::Signs of_a = a.contains_either_sign(n, kSlantOnEdge, turn);
    const NormalCone::Signs of_b = b.contains_either_sign(n, kSlantOnEdge, turn);
    const bool forth = of_a.forth && of_b.back, back = of_a.back && of_b.forth;
    if (back) edge_axis_[edge_axes_++] = {-n, turn, skew, ea};
    if (forth) edge_axis_[edge_axes_++] = {n, turn, skew, ea};
}

double FeaturePairBound::least(const Vec3& center_a, const Vec3& center_b) {
    if (rule_ == AxisRule::all_axes) return least_of_edges(center_a, center_b);
    if (rule_ == AxisRule::face_axis) return least_along(center_a, center_b);
    // in_full: the normal turns with the centres, and nothing is known of later gaps
    return rule_ == AxisRule::never ? kUnbounded : -kUnbounded;
}

double FeaturePairBound::least_along(const Vec3& center_a, const Vec3& center_b) const {
    const Vec3& n = face_[0].normal;
    // n . d changes by at most the skin's distance: the axis stays invalid until the list is
    // renewed
    if (n.dot(center_b - center_a) <= -skin_.distance) return kUnbounded;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 at =
        part_across(reference_is_a_ ? Vec3(point_b - center_a) : Vec3(point_a - center_b), n);
    // farther across the axis than the patch radius and the skin: no contact within the skin
    return at.squaredNorm() > far_ * far_ ? kUnbounded : n.dot(point_b - point_a);
}

double FeaturePairBound::least_across(const Vec3& d, const Vec3& between) {
    if (edge_axes_ < 0) list_edge_axes();
    double least = kUnbounded;
    const double apart = d.norm(), length = between.norm();
    for (std::int8_t k = 0; k < edge_axes_; ++k) {
        const auto& [n, turn, skew, edge] = edge_axis_[k];
        // the axis stays invalid: n . d changes by the motion and by the axis's own rotation
        if (n.dot(d) <= -skin_.distance - turn * apart) continue;
        const double gap = n.dot(between);
        // nearly parallel edges have no contact where their apexes are far apart along them
        if (turn == kAnyTurn && std::abs(edge.dot(between)) > 2.0 * far_) continue;
        // Apexes that are farther apart across the axis than two patch radii allow, motion and
        // rotation included, cannot meet where these edges cross.
        const double beside = skew * far_ + 2.0 * turn * length;
        if (length * length - gap * gap > beside * beside) continue;
        least = std::min(least, gap - turn * length);
    }
    return least;
}

// The final gap is the maximum over valid axes. An axis valid for every pose within the skin
// therefore gives a lower bound; without one, the minimum over axes that may become valid does.
// Where every axis leaves the other feature outside its footprint there is no contact. An edge axis
// may replace a face axis with a larger gap (measure_gap_surface), so edge axes always count.
double FeaturePairBound::least_of_edges(const Vec3& center_a, const Vec3& center_b) {
    const Vec3 d = center_b - center_a;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 between = point_b - point_a;
    double certain = -kUnbounded, possible = kUnbounded;
    bool near = false;
    for (std::uint8_t k = 0; k < faces_; ++k) {
        const Vec3& n = face_[k].normal;
        const double along = n.dot(d), gap = n.dot(between);
        // bodies move by at most the skin: the axis stays invalid until then
        if (along <= -skin_.distance) continue;
        possible = std::min(possible, gap);
        // valid wherever the bodies go within the skin
        if (along > skin_.distance && certain_[k]) certain = std::max(certain, gap);
        const auto is_near = [&](const Footprint& foot, double radius, const Vec3& v) {
            return distance_from(foot, radius, part_across(v, n), skin_.distance) <= far_ * far_;
        };
        near = near || is_near(face_[k].footprint_a, a_->radius, point_b - center_a) ||
               is_near(face_[k].footprint_b, b_->radius, point_a - center_b);
    }
    const double across = least_across(d, between);
    if (!near && across == kUnbounded) return kUnbounded;
    return std::min(certain > -kUnbounded ? certain : possible, across);
}

}  // namespace ice
