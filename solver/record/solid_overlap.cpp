// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/solid_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/feature/way_out.hpp"

namespace ice {

namespace {

// With more vertices than this [-] the seats represent them: those of a fine hull are as close as
// its seats. More takes longer for each check; fewer may miss corners of coarse hulls.
constexpr std::size_t kMostVertices = 1000;

// A point this near to a surface is on it, and in the body [m]: rounding. Larger counts bodies that
// touch as overlapping.
constexpr double kOnSurface = 1e-9;

const Shape& shape_of(const Scene& scene, std::int32_t body) { return scene.shape_of(body); }

// What floes have left of a body's solid in a pair with another one; null where it is whole. The
// ship and floes that are not convex meet the whole solid.
const ConvexPiece* left_of(const Scene& scene, std::int32_t body, std::int32_t other) {
    const bool meets =
        other != static_cast<std::int32_t>(kShip) && !shape_of(scene, other).convex.empty();
    return meets ? scene.crushed_solids.solid_of(body) : nullptr;
}

// Depth of a point below the nearest plane of a solid [m]; negative outside.
double depth_in(const ConvexPiece& solid, const Vec3& p) {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < solid.plane_count(); ++k)
        depth = std::min(depth, solid.offsets[k] - solid.normals[k].dot(p));
    return depth;
}

// A body's box in another one's axes, or in the world's for other < 0.
Eigen::AlignedBox3d box_in(const Scene& scene, std::int32_t body, std::int32_t other) {
    const Bodies& b = scene.bodies;
    Mat3 rotation = b.rotation[body];
    Vec3 translation = b.position[body];
    if (other >= 0) {
        rotation = b.rotation[other].transpose() * rotation;
        translation = b.rotation[other].transpose() * (translation - b.position[other]);
    }
    const Eigen::AlignedBox3d& box = shape_of(scene, body).box;
    const Vec3 middle = rotation * box.center() + translation;
    const Vec3 half = rotation.cwiseAbs() * (0.5 * box.sizes());
    return {middle - half, middle + half};
}

// Pairs of bodies whose boxes meet, one of them movable: neighbours along x are compared.
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
            // sorted by their lower ends: all that follow begin farther ahead
            if (order[n].first > box[order[k].second].max().x()) break;
            // neither moves, so their overlap is that of the start
            const bool held = (a == 0 || scene.bodies.held[a]) && scene.bodies.held[b];
            if (!held && box[a].intersects(box[b])) pairs.emplace_back(a, b);
        }
    return pairs;
}

// True where a plane of b's bounds, which has all of b's mesh behind it, has all of a's corners
// before it.
bool parted_by(const Scene& scene, std::int32_t a, std::int32_t b) {
    const ConvexBounds &of_a = shape_of(scene, a).bounds, &of_b = shape_of(scene, b).bounds;
    if (!of_a.known() || !of_b.known()) return false;
    const Bodies& bodies = scene.bodies;
    // b's plane n . x = offset in a's axes, with all of a's corners before it
    const Mat3 rotation = bodies.rotation[b].transpose() * bodies.rotation[a];
    const Vec3 translation =
        bodies.rotation[b].transpose() * (bodies.position[a] - bodies.position[b]);
    for (std::size_t k = 0; k < of_b.normals.size(); ++k) {
        const Vec3 n = rotation.transpose() * of_b.normals[k];
        const double beyond = of_b.offset[k] - of_b.normals[k].dot(translation);
        if (std::all_of(of_a.corners.begin(), of_a.corners.end(),
                        [&](const Vec3& p) { return n.dot(p) > beyond; }))
            return true;
    }
    return false;
}

struct Deepest {
    double depth;  // [m]
    Vec3 at;       // world axes
};

// The deepest of a's points in b if deeper than `least`; else `least`.
Deepest deepest_point(const Scene& scene, std::int32_t a, std::int32_t b, const Deepest& least) {
    Deepest out = least;
    const Bodies& bodies = scene.bodies;
    const Mat3 rotation = bodies.rotation[b].transpose() * bodies.rotation[a];
    const Vec3 translation =
        bodies.rotation[b].transpose() * (bodies.position[a] - bodies.position[b]);
    const Shape &points = shape_of(scene, a), &solid = shape_of(scene, b);
    const Eigen::AlignedBox3d seen = box_in(scene, b, a);
    const ConvexPiece *left_a = left_of(scene, a, b), *left_b = left_of(scene, b, a);
    Vec3 shallow = Vec3::Zero();  // a point in b's axes; none within `room` of it is deeper
    double room = 0.0;
    const auto add_point = [&](const Vec3& at, std::int32_t sphere) {  // -1: a vertex
        // two cheap tests first; a point within `room` of a shallow one is no deeper than the
        // best
        if (!seen.contains(at) || (left_a && depth_in(*left_a, at) < -kOnSurface)) return;
        const Vec3 p = rotation * at + translation;
        if (!solid.box.contains(p) || (p - shallow).norm() < room) return;
        const Foot foot = solid.surface->closest(p);
        double depth = foot.inside ? foot.distance : -foot.distance;
        shallow = p;
        room = out.depth - depth;
        if (depth <= out.depth) return;
        if (sphere >= 0 && lies_in_notch(scene, a, sphere)) return;
        // crushing has driven it out of a hollow body on the other side
        if (sphere >= 0 && !scene.crushed.displacement_of(a, sphere).isZero(0.0) &&
            !is_inside(scene, a, bodies.position[a] + bodies.rotation[a] * at))
            return;
        // ice that contacts have crushed there is left out
        depth = way_out(scene, b, p, foot).depth;
        if (left_b) depth = std::min(depth, depth_in(*left_b, p));
        if (depth > out.depth) out = {depth, bodies.position[b] + bodies.rotation[b] * p};
    };
    for (std::int32_t k = 0; k < std::ssize(points.center); ++k) {
        const Vec3 center = points.center[k] + scene.crushed.displacement_of(a, k);
        // crushing has driven it right through its body
        if (!scene.crushed.is_whole(a) && !points.box.contains(center)) continue;
        add_point(center + points.radius[k] * points.normal[k], k);
    }
    if (left_a)
        for (std::size_t k = 0; k < left_a->corners.size(); ++k) add_point(left_a->corners[k], -1);
    // a vertex of crushed ice may be crushed away
    if (scene.crushed.is_whole(a) && points.mesh.vertices.size() <= kMostVertices)
        for (const Vec3& v : points.mesh.vertices) add_point(v, -1);
    return out;
}

// Do the centres of all of a's spheres lie in b?
bool lies_in(const Scene& scene, std::int32_t a, std::int32_t b) {
    const Bodies& bodies = scene.bodies;
    const std::vector<Vec3>& centers = shape_of(scene, a).center;
    return std::all_of(centers.begin(), centers.end(), [&](const Vec3& c) {
        return is_inside(scene, b, bodies.position[a] + bodies.rotation[a] * c);
    });
}

}  // namespace

bool is_inside(const Scene& scene, std::int32_t body, const Vec3& point) {
    const Bodies& b = scene.bodies;
    const Vec3 p = b.rotation[body].transpose() * (point - b.position[body]);
    const Shape& shape = shape_of(scene, body);
    if (!shape.box.contains(p)) return false;
    const Foot foot = shape.surface->closest(p);
    return foot.inside || foot.distance < kOnSurface;
}

PairOverlap measure_overlap(const Scene& scene, std::int32_t a, std::int32_t b) {
    PairOverlap out;
    if (!parted_by(scene, a, b) && !parted_by(scene, b, a)) {
        Deepest found = deepest_point(scene, a, b, {0.0, Vec3::Zero()});
        found = deepest_point(scene, b, a, found);
        out.depth = found.depth;
        // where one body lies in the other the depth of its points says little
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

OverlapFound measure_overlaps(const Scene& scene, const std::vector<Contact>& contacts) {
    OverlapFound out;
    auto contact = contacts.begin();  // ordered by pair
    auto pairs = close_pairs(scene);
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [a, b] : pairs) {
        // separated solids have no overlap that contacts could miss
        if (parted_by(scene, a, b) || parted_by(scene, b, a)) continue;
        const std::pair<std::int32_t, std::int32_t> pair(a, b);
        while (contact != contacts.end() && std::pair(contact->a, contact->b) < pair) ++contact;
        // the overlap of this pair's contacts; only more counts as unseen
        double known = 0.0;
        for (auto c = contact; c != contacts.end() && std::pair(c->a, c->b) == pair; ++c)
            known = std::max(known, -c->gap);
        const Deepest found = deepest_point(scene, a, b, {known, Vec3::Zero()});
        const double depth = deepest_point(scene, b, a, found).depth;
        out.deepest = std::max(out.deepest, depth);
        if (depth > known) out.unseen.push_back({a, b, depth - known});
    }
    return out;
}

}  // namespace ice
