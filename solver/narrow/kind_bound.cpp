// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/kind_bound.hpp"

#include <Eigen/Geometry>
#include <limits>

namespace ice {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// More than any two directions differ by [rad]: every normal is possible, nothing is known.
constexpr double kMostTurn = 4.0;

}  // namespace

KindBound::KindBound(const SphereSurface& a, const SphereSurface& b, bool prefer_a, double reach,
                     const Leeway& leeway)
    : a_(&a), b_(&b), far_(reach + leeway.distance), leeway_(leeway) {
    const KindMeeting meeting = find_meeting(a, b, prefer_a, leeway.angle);
    rule_ = meeting.rule;
    a_is_surface_ = meeting.a_is_surface;
    const Vec3 n = rule_ == KindRule::edges ? Vec3(-b.normal) : meeting.normal;
    offset_a_ = support_offset(a, n);
    offset_b_ = support_offset(b, -n);
    if (rule_ == KindRule::direction) face_[0].normal = meeting.normal;
    if (rule_ == KindRule::edges) list_faces();
}

void KindBound::list_faces() {
    const auto add = [&](bool of_a, std::size_t k) {
        const Faces &own = (of_a ? a_ : b_)->faces, &other = (of_a ? b_ : a_)->faces;
        const Vec3 outward = -own.normal[k];  // of the other
        if (!other.have(outward, kSlantOnEdge, leeway_.angle)) return;
        certain_[faces_] = other.have(outward, kSlantOnEdge, -leeway_.angle);
        const Vec3 n = of_a ? own.normal[k] : outward;
        face_[faces_++] = {n, foothold(*a_, n), foothold(*b_, n)};
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(a_->faces.count); ++k) add(true, k);
    for (std::size_t k = 0; k < static_cast<std::size_t>(b_->faces.count); ++k) add(false, k);
}

// The normal across two edges turns by an angle / sine.
void KindBound::list_crossings() {
    const Faces &a = a_->faces, &b = b_->faces;
    crossings_ = 0;
    for (int ka = 0; ka < a.edges(); ++ka)
        for (int kb = 0; kb < b.edges(); ++kb) {
            const Vec3 ea = a.edge(ka), eb = b.edge(kb), across = ea.cross(eb);
            const double sine = across.norm();
            if (sine <= kParallel - leeway_.angle) continue;
            // a turn without bound where it might become any
            const double turn =
                sine <= 2.0 * leeway_.angle ? kMostTurn : leeway_.angle / (sine - leeway_.angle);
            // each as far from where they cross: apart by the sum of two vectors at their angle
            const double cosine = std::abs(ea.dot(eb));
            const double skew = std::sqrt(2.0 + 2.0 * std::min(1.0, cosine + leeway_.angle));
            const Vec3 n = 1.0 / sine * across;
            const Faces::Ways of_a = a.have_either(n, kSlantOnEdge, turn);
            const Faces::Ways of_b = b.have_either(n, kSlantOnEdge, turn);
            const bool forth = of_a.forth && of_b.back, back = of_a.back && of_b.forth;
            if (back) crossing_[crossings_++] = {-n, turn, skew, ea};
            if (forth) crossing_[crossings_++] = {n, turn, skew, ea};
        }
}

double KindBound::least(const Vec3& center_a, const Vec3& center_b) {
    if (rule_ == KindRule::edges) return least_of_edges(center_a, center_b);
    if (rule_ == KindRule::direction) return least_along(center_a, center_b);
    return rule_ == KindRule::never ? kUnbounded : -kUnbounded;
}

double KindBound::least_along(const Vec3& center_a, const Vec3& center_b) const {
    const Vec3& n = face_[0].normal;
    if (n.dot(center_b - center_a) <= -leeway_.distance) return kUnbounded;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 at =
        part_across(a_is_surface_ ? Vec3(point_b - center_a) : Vec3(point_a - center_b), n);
    return at.squaredNorm() > far_ * far_ ? kUnbounded : n.dot(point_b - point_a);
}

double KindBound::least_across(const Vec3& d, const Vec3& between) {
    if (crossings_ < 0) list_crossings();
    double least = kUnbounded;
    const double apart = d.norm(), length = between.norm();
    for (std::int8_t k = 0; k < crossings_; ++k) {
        const auto& [n, turn, skew, edge] = crossing_[k];
        if (n.dot(d) <= -leeway_.distance - turn * apart) continue;
        const double gap = n.dot(between);
        // nearly parallel edges may part the bodies any way across them, but not far along them
        if (turn == kMostTurn && std::abs(edge.dot(between)) > 2.0 * far_) continue;
        const double beside = skew * far_ + 2.0 * turn * length;
        if (length * length - gap * gap > beside * beside) continue;
        least = std::min(least, gap - turn * length);
    }
    return least;
}

// The largest gap of all normals that may part them wins, so one normal that will surely be among
// them is a bound; without one, the least of those that might be. Where each of these leaves the
// other's edge beyond what a sphere stands for there will be no gap. A face's normal gives way to
// edges that cross near the spheres, deeper or where no corner is over the face: they count always.
double KindBound::least_of_edges(const Vec3& center_a, const Vec3& center_b) {
    const Vec3 d = center_b - center_a;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 between = point_b - point_a;
    double certain = -kUnbounded, possible = kUnbounded;
    bool near = false;
    for (std::uint8_t k = 0; k < faces_; ++k) {
        const Vec3& n = face_[k].normal;
        const double along = n.dot(d), gap = n.dot(between);
        if (along <= -leeway_.distance) continue;
        possible = std::min(possible, gap);
        if (along > leeway_.distance && certain_[k]) certain = std::max(certain, gap);
        const auto is_near = [&](const Foothold& foot, double radius, const Vec3& v) {
            return distance_from(foot, radius, part_across(v, n), leeway_.distance) <= far_ * far_;
        };
        near = near || is_near(face_[k].under_a, a_->radius, point_b - center_a) ||
               is_near(face_[k].under_b, b_->radius, point_a - center_b);
    }
    const double across = least_across(d, between);
    if (!near && across == kUnbounded) return kUnbounded;
    return std::min(certain > -kUnbounded ? certain : possible, across);
}

}  // namespace ice
