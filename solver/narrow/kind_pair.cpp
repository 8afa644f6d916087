// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/kind_pair.hpp"

#include <Eigen/Geometry>

namespace ice {

KindMeeting find_meeting(const SphereSurface& a, const SphereSurface& b, bool prefer_a,
                         double slack) {
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    KindMeeting out{KindRule::never, same || a.spread_cos > b.spread_cos, Vec3::Zero()};
    if (a.faces.count > 0 && b.faces.count > 0) {
        out.rule = KindRule::edges;
        return out;
    }
    const bool mean = same && !prefer_a;
    out.rule = KindRule::afresh;
    if ((out.a_is_surface ? a : b).spread_cos != 1.0 || (mean && b.spread_cos != 1.0)) return out;
    out.rule = KindRule::never;
    out.normal = out.a_is_surface ? a.normal : Vec3(-b.normal);
    if (mean) {
        out.normal = a.normal - b.normal;
        const double length = out.normal.norm();
        if (length < 1.0 - slack) return out;  // the faces look away
        out.normal /= length;
    }
    if (belongs(a, out.normal, slack) && belongs(b, -out.normal, slack))
        out.rule = KindRule::direction;
    return out;
}

KindPair::KindPair(const SphereSurface& a, const SphereSurface& b, bool prefer_a)
    : a_(&a), b_(&b), prefer_a_(prefer_a) {
    const KindMeeting meeting = find_meeting(a, b, prefer_a);
    rule_ = meeting.rule;
    a_is_surface_ = meeting.a_is_surface;
    const Vec3 n = rule_ == KindRule::edges ? Vec3(-b.normal) : meeting.normal;
    offset_a_ = support_offset(a, n);
    offset_b_ = support_offset(b, -n);
    if (rule_ == KindRule::direction) face_[0].normal = meeting.normal;
    if (rule_ != KindRule::edges) return;
    list_faces();
    list_crossings();
    if (faces_ + crossings_ == 0) rule_ = KindRule::never;
}

// A face's normal is one of its own edge's or corner's.
void KindPair::list_faces() {
    const auto add = [&](const Vec3& n, const Faces& other, const Vec3& outward) {
        if (!other.have(outward, kSlantOnEdge)) return;
        face_[faces_++] = {n, foothold(*a_, n), foothold(*b_, n)};
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(a_->faces.count); ++k)
        add(a_->faces.normal[k], b_->faces, -a_->faces.normal[k]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(b_->faces.count); ++k)
        add(-b_->faces.normal[k], a_->faces, -b_->faces.normal[k]);
}

void KindPair::list_crossings() {
    for (int ka = 0; ka < a_->faces.edges(); ++ka)
        for (int kb = 0; kb < b_->faces.edges(); ++kb) add_crossing(ka, kb);
}

void KindPair::add_crossing(int edge_a, int edge_b) {
    const Faces &fa = a_->faces, &fb = b_->faces;
    const Vec3 ea = fa.edge(edge_a), eb = fb.edge(edge_b);
    const Vec3 across = ea.cross(eb);
    const double sine = across.norm();
    if (sine <= kParallel) return;
    Crossing c;
    c.normal = 1.0 / sine * across;
    const Faces::Ways of_a = fa.have_either(c.normal, kSlantOnEdge);
    if (!of_a.forth && !of_a.back) return;
    const Faces::Ways of_b = fb.have_either(c.normal, kSlantOnEdge);
    c.forth = of_a.forth && of_b.back;
    c.back = of_a.back && of_b.forth;
    if (!c.forth && !c.back) return;
    c.ends = fa.ends() || fb.ends();
    // find_crossing's (between x eb) . across / square, turned round
    const double square = across.squaredNorm();
    c.along_a = eb.cross(across) / square;
    c.along_b = ea.cross(across) / square;
    c.edge_a = static_cast<std::int8_t>(edge_a);
    c.edge_b = static_cast<std::int8_t>(edge_b);
    crossing_[crossings_++] = c;
}

Gap KindPair::measure_direction(const Vec3& center_a, const Vec3& center_b) const {
    const Vec3& n = face_[0].normal;
    if (n.dot(center_b - center_a) <= 0.0) return kNone;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const double gap = n.dot(point_b - point_a);
    const Vec3 at =
        part_across(a_is_surface_ ? Vec3(point_b - center_a) : Vec3(point_a - center_b), n);
    return {n, gap, at.squaredNorm(), a_is_surface_, true};
}

// Do the edges meet on what there is of them?
bool KindPair::meet(const Crossing& c, const Vec3& between) const {
    if (!c.ends) return true;
    return !(a_->faces.ends() && c.along_a.dot(between) < -kBeyond * a_->radius) &&
           !(b_->faces.ends() && c.along_b.dot(between) < -kBeyond * b_->radius);
}

// Calls visit(across) for the normals across two edges whose gap is more than `least`, which may
// change, and that meet.
template <class Visit>
void KindPair::for_each_across(const Vec3& d, const Vec3& between, const double& least,
                               const Visit& visit) const {
    for (std::uint8_t k = 0; k < crossings_; ++k) {
        const Crossing& c = crossing_[k];
        const double along = c.normal.dot(d), way = along < 0.0 ? -1.0 : 1.0;
        const double now = way * c.normal.dot(between);
        if (now <= least || along == 0.0 || !(along < 0.0 ? c.back : c.forth) || !meet(c, between))
            continue;
        visit(Across{&c, way, now});
    }
}

KindPair::Across KindPair::largest_across(const Vec3& d, const Vec3& between, double least) const {
    Across largest{nullptr, 1.0, least};
    for_each_across(d, between, largest.gap, [&](const Across& now) { largest = now; });
    return largest;
}

KindPair::Across KindPair::nearest_across(const Vec3& d, const Vec3& between) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Across nearest{nullptr, 1.0, 0.0};
    double least = kInfinity;
    for_each_across(d, between, -kInfinity, [&](const Across& now) {
        const ice::Crossing at = now.crossing->at(between);
        const double beside = distance_sq(at);
        if (beside >= least || !is_in_reach(at, *a_, *b_)) return;
        least = beside;
        nearest = now;
    });
    return nearest;
}

Gap KindPair::gap_across(const Across& across, const Vec3& between) const {
    const Crossing& c = *across.crossing;
    if (meet_elsewhere(between, across.gap)) return kNone;
    return crossing_gap(across.way * c.normal, across.gap, c.at(between), a_is_surface_, c.edge_a,
                        c.edge_b);
}

bool KindPair::meet_elsewhere(const Vec3& between, double gap) const {
    return gap < 0.0 &&
           (is_less_deep(*a_, *b_, between, gap) || is_less_deep(*b_, *a_, -between, gap));
}

Gap KindPair::measure_edges(const Vec3& center_a, const Vec3& center_b) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const Vec3 d = center_b - center_a;
    const Vec3 point_a = center_a + offset_a_, point_b = center_b + offset_b_;
    const Vec3 between = point_b - point_a;
    const KindDirection* face = nullptr;
    double gap = -kInfinity;
    for (std::uint8_t k = 0; k < faces_; ++k) {
        const double now = face_[k].normal.dot(between);
        if (now <= gap || face_[k].normal.dot(d) <= 0.0) continue;
        face = &face_[k];
        gap = now;
    }
    const Across across = largest_across(d, between, gap);
    if (across.crossing) return gap_across(across, between);
    if (!face || meet_elsewhere(between, gap)) return kNone;
    const Vec3& n = face->normal;
    const double under_a =
        distance_from(face->under_a, a_->radius, part_across(point_b - center_a, n), 0.0);
    const double under_b =
        distance_from(face->under_b, b_->radius, part_across(point_a - center_b, n), 0.0);
    const bool on_a = under_a <= under_b + kFlush * a_->radius * a_->radius;
    const bool over = on_a ? under_a <= a_->reach * a_->reach : under_b <= b_->reach * b_->reach;
    const Across nearest = nearest_across(d, between);
    if (nearest.crossing &&
        (!over || (nearest.gap < gap - kFlush * std::min(a_->radius, b_->radius) &&
                   nearest.way * nearest.crossing->normal.dot(n) > kSameFace)))
        return gap_across(nearest, between);
    if (!over) return kNone;
    return {n, gap, on_a ? under_a : under_b, on_a, true};
}

Gap KindPair::measure_afresh(const Vec3& center_a, const Vec3& center_b) const {
    SphereSurface a = *a_, b = *b_;
    a.center = center_a;
    b.center = center_b;
    return measure_gap_surface(a, b, prefer_a_);
}

}  // namespace ice
