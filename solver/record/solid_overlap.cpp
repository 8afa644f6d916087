// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/solid_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ice {

namespace {

// Vertices of a fine hull are as close as its seats, which stand for them.
constexpr std::size_t kMostVertices = 1000;

const Shape& shape_of(const Scene& scene, std::int32_t body) {
    return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
}

// A body's box in another one's axes, or in the world's for other < 0.
Eigen::AlignedBox3d box_in(const Scene& scene, std::int32_t body, std::int32_t other) {
    const Bodies& b = scene.bodies;
    Mat3 turn = b.rotation[body];
    Vec3 shift = b.position[body];
    if (other >= 0) {
        turn = b.rotation[other].transpose() * turn;
        shift = b.rotation[other].transpose() * (shift - b.position[other]);
    }
    const Eigen::AlignedBox3d& box = shape_of(scene, body).box;
    const Vec3 middle = turn * box.center() + shift;
    const Vec3 half = turn.cwiseAbs() * (0.5 * box.sizes());
    return {middle - half, middle + half};
}

// Pairs of bodies whose boxes meet, of which one can move: neighbours along x are compared.
std::vector<std::pair<std::int32_t, std::int32_t>> close_pairs(const Scene& scene) {
    const auto count = static_cast<std::int32_t>(scene.bodies.size());
    std::vector<std::pair<double, std::int32_t>> order;
    std::vector<Eigen::AlignedBox3d> box;
    for (std::int32_t i = 0; i < count; ++i) {
        box.push_back(box_in(scene, i, -1));
        order.emplace_back(box.back().min().x(), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::size_t k = 0; k < order.size(); ++k)
        for (std::size_t n = k + 1; n < order.size(); ++n) {
            const auto [a, b] = std::minmax(order[k].second, order[n].second);
            if (order[n].first > box[order[k].second].max().x()) break;
            const bool held = (a == 0 || scene.bodies.held[a]) && scene.bodies.held[b];
            if (!held && box[a].intersects(box[b])) pairs.emplace_back(a, b);
        }
    return pairs;
}

// Is a plane of b's bounds, of which all of its mesh is behind, before all of a's corners?
bool parted_by(const Scene& scene, std::int32_t a, std::int32_t b) {
    const ConvexBounds &of_a = shape_of(scene, a).bounds, &of_b = shape_of(scene, b).bounds;
    if (!of_a.known() || !of_b.known()) return false;
    const Bodies& bodies = scene.bodies;
    const Mat3 turn = bodies.rotation[b].transpose() * bodies.rotation[a];
    const Vec3 shift = bodies.rotation[b].transpose() * (bodies.position[a] - bodies.position[b]);
    for (std::size_t k = 0; k < of_b.normals.size(); ++k) {
        const Vec3 n = turn.transpose() * of_b.normals[k];
        const double beyond = of_b.offset[k] - of_b.normals[k].dot(shift);
        if (std::all_of(of_a.corners.begin(), of_a.corners.end(),
                        [&](const Vec3& p) { return n.dot(p) > beyond; }))
            return true;
    }
    return false;
}

}  // namespace

SolidOverlap::SolidOverlap(const Scene& scene) {
    for (const Shape& shape : scene.shapes) {
        Form form{{}, {}, WindingNumber(shape.mesh), shape.bounds.hold_spheres};
        for (std::size_t k = 0; k < shape.center.size(); ++k)
            form.seats.push_back({shape.center[k] + shape.radius[k] * shape.normal[k],
                                  static_cast<std::int32_t>(k), shape.normal[k]});
        form.points = form.seats;
        if (shape.mesh.vertices.size() <= kMostVertices)
            for (const Vec3& v : shape.mesh.vertices) form.points.push_back({v, -1, Vec3::Zero()});
        for (auto* list : {&form.seats, &form.points})
            std::stable_sort(list->begin(), list->end(),
                             [](const Point& l, const Point& r) { return l.at.x() < r.at.x(); });
        forms_.push_back(std::move(form));
    }
}

const SolidOverlap::Form& SolidOverlap::form_of(const Scene& scene, std::int32_t body) const {
    return forms_[static_cast<std::size_t>(scene.bodies.shape[body])];
}

// From p's place along x both ways, as far as a nearer one may be.
SolidOverlap::Nearest SolidOverlap::nearest_seat(const Form& form, const Vec3& p) const {
    const auto middle = std::lower_bound(form.seats.begin(), form.seats.end(), p.x(),
                                         [](const Point& s, double x) { return s.at.x() < x; });
    double least = std::numeric_limits<double>::infinity();
    const Point* best = nullptr;
    const auto try_seat = [&](const Point& s) {
        const double dx = s.at.x() - p.x();
        if (dx * dx >= least) return false;
        const double distance = (s.at - p).squaredNorm();
        if (distance < least) {
            least = distance;
            best = &s;
        }
        return true;
    };
    for (auto s = middle; s != form.seats.end() && try_seat(*s);) ++s;
    for (auto s = middle; s != form.seats.begin() && try_seat(*(s - 1));) --s;
    return {best, std::sqrt(least)};
}

double SolidOverlap::depth_in(const Scene& scene, std::int32_t b, const Vec3& p, double least,
                              double& clear) const {
    const Form& form = form_of(scene, b);
    const Shape& shape = shape_of(scene, b);
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shape.bounds.normals.size(); ++k) {
        depth = std::min(depth, shape.bounds.offset[k] - shape.bounds.normals[k].dot(p));
        if (depth <= least) return least;
    }
    if (form.convex && scene.crushed.is_whole(b)) return depth;
    const Nearest near = nearest_seat(form, p);
    const Vec3& outward = near.seat->normal;
    const double height = outward.dot(p - near.seat->at);
    if (!form.convex) {
        if (height > 0.0) clear = near.distance - shape.spacing;
        depth = std::min(depth, -height);
    }
    depth += scene.crushed.recess_of(b, near.seat->seat).dot(outward);
    return depth > least && (form.convex || form.inside.contains(p)) ? depth : least;
}

SolidOverlap::Deepest SolidOverlap::deepest_point(const Scene& scene, std::int32_t a,
                                                  std::int32_t b, const Deepest& least) const {
    Deepest out = least;
    const Form& form = form_of(scene, a);
    const Bodies& bodies = scene.bodies;
    const Mat3 turn = bodies.rotation[b].transpose() * bodies.rotation[a];
    const Vec3 shift = bodies.rotation[b].transpose() * (bodies.position[a] - bodies.position[b]);
    const Eigen::AlignedBox3d& target = shape_of(scene, b).box;
    const Eigen::AlignedBox3d seen = box_in(scene, b, a);
    const double crushed = scene.crushed.deepest_of(a);
    auto k = std::lower_bound(form.points.begin(), form.points.end(), seen.min().x() - crushed,
                              [](const Point& s, double x) { return s.at.x() < x; });
    Vec3 outside = Vec3::Zero();  // a point of b's axes that is outside, by `clear`
    double clear = 0.0;
    for (; k != form.points.end() && k->at.x() <= seen.max().x() + crushed; ++k) {
        if (k->seat < 0 && !scene.crushed.is_whole(a)) continue;  // it may be gone
        Vec3 at = k->at;
        if (k->seat >= 0) at += scene.crushed.recess_of(a, k->seat);
        const Vec3 p = turn * at + shift;
        if (!target.contains(p) || (clear > 0.0 && (p - outside).norm() < clear)) continue;
        double now = 0.0;
        const double depth = depth_in(scene, b, p, out.depth, now);
        if (depth > out.depth) out = {depth, bodies.position[b] + bodies.rotation[b] * p};
        if (now <= 0.0) continue;
        outside = p;
        clear = now;
    }
    return out;
}

bool SolidOverlap::contains(const Scene& scene, std::int32_t body, const Vec3& point) const {
    const Bodies& b = scene.bodies;
    const Vec3 p = b.rotation[body].transpose() * (point - b.position[body]);
    return shape_of(scene, body).box.contains(p) && form_of(scene, body).inside.contains(p);
}

bool SolidOverlap::lies_in(const Scene& scene, std::int32_t a, std::int32_t b) const {
    const Bodies& bodies = scene.bodies;
    const std::vector<Vec3>& centers = shape_of(scene, a).center;
    return std::all_of(centers.begin(), centers.end(), [&](const Vec3& c) {
        return contains(scene, b, bodies.position[a] + bodies.rotation[a] * c);
    });
}

PairOverlap SolidOverlap::measure_pair(const Scene& scene, std::int32_t a, std::int32_t b) const {
    PairOverlap out;
    if (!parted_by(scene, a, b) && !parted_by(scene, b, a)) {
        Deepest found = deepest_point(scene, a, b, {0.0, Vec3::Zero()});
        found = deepest_point(scene, b, a, found);
        out.depth = found.depth;
        out.point = found.at;
        out.inside = lies_in(scene, a, b) ? a : lies_in(scene, b, a) ? b : -1;
    }
    if (out.inside < 0) return out;
    // of two equal bodies in one place every point is on the other's surface
    const Shape& shape = shape_of(scene, out.inside);
    const double radius = *std::min_element(shape.radius.begin(), shape.radius.end());
    if (radius > out.depth) {
        out.depth = radius;
        out.point = scene.bodies.position[out.inside];
    }
    return out;
}

OverlapFound SolidOverlap::measure(const Scene& scene, const std::vector<Contact>& contacts) const {
    OverlapFound out;
    auto contact = contacts.begin();  // ordered by pair
    auto pairs = close_pairs(scene);
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [a, b] : pairs) {
        if (parted_by(scene, a, b) || parted_by(scene, b, a)) continue;
        const std::pair<std::int32_t, std::int32_t> pair(a, b);
        while (contact != contacts.end() && std::pair(contact->a, contact->b) < pair) ++contact;
        double known = 0.0;
        for (auto c = contact; c != contacts.end() && std::pair(c->a, c->b) == pair; ++c)
            known = std::max(known, -c->gap);
        const Deepest found = deepest_point(scene, a, b, {known, Vec3::Zero()});
        const double depth = deepest_point(scene, b, a, found).depth;
        out.deepest = std::max(out.deepest, depth);
        if (depth - known <= out.unseen) continue;
        out.unseen = depth - known;
        out.a = a;
        out.b = b;
    }
    return out;
}

}  // namespace ice
