// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/broad/find_pairs.hpp"

#include <algorithm>

#include "solver/shape/sphere_grid.hpp"

namespace ice {

namespace {

double bounding_radius(const Scene& scene, std::size_t i) {
    return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[i])].bounding_radius;
}

bool near_ship(const Scene& scene, std::size_t i, double margin) {
    const Bodies& b = scene.bodies;
    const Vec3 at = b.rotation[kShip].transpose() * (b.position[i] - b.position[kShip]);
    const double range = bounding_radius(scene, i) + margin;
    return scene.shapes[0].box.squaredExteriorDistance(at) <= range * range;
}

bool near_floes(const Scene& scene, std::size_t i, std::size_t j, double margin) {
    const Bodies& b = scene.bodies;
    const double range = bounding_radius(scene, i) + bounding_radius(scene, j) + margin;
    return (b.position[j] - b.position[i]).squaredNorm() <= range * range;
}

BodyPair make_pair(std::size_t a, std::size_t b) {
    return {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)};
}

}  // namespace

void find_pairs(const Scene& scene, double margin, std::vector<BodyPair>& out) {
    out.clear();
    const Bodies& b = scene.bodies;
    double largest = 0.0;
    // no part of the ship's box is farther than this from the ship's origin; most floes are
    const Eigen::AlignedBox3d& box = scene.shapes[0].box;
    const double corner = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
    for (std::size_t i = 1; i < b.size(); ++i) {
        largest = std::max(largest, bounding_radius(scene, i));
        const double range = corner + bounding_radius(scene, i) + margin;
        if ((b.position[i] - b.position[kShip]).squaredNorm() > 1.000001 * range * range) continue;
        if (near_ship(scene, i, margin)) out.push_back(make_pair(kShip, i));
    }
    if (largest == 0.0) return;

    // only moving floes ask: held ones beyond the box that they reach need no place in the grid
    Eigen::AlignedBox3d reached;
    for (std::size_t i = 1; i < b.size(); ++i)
        if (!b.held[i]) reached.extend(b.position[i]);
    reached.min().array() -= 2.0 * largest + margin;
    reached.max().array() += 2.0 * largest + margin;
    thread_local std::vector<std::int32_t> asked;
    thread_local std::vector<Vec3> places;
    thread_local SphereGrid grid;  // all keep their memory
    asked.clear();
    places.clear();
    for (std::size_t i = 1; i < b.size(); ++i) {
        if (!reached.contains(b.position[i])) continue;
        asked.push_back(static_cast<std::int32_t>(i));
        places.push_back(b.position[i]);
    }
    grid.build(places, 2.0 * largest + margin);
    for (const std::int32_t asking : asked) {
        const auto i = static_cast<std::size_t>(asking);
        if (b.held[i]) continue;
        const double range = bounding_radius(scene, i) + largest + margin;
        grid.for_each_near(b.position[i], range, [&](std::int32_t item) {
            const auto j = static_cast<std::size_t>(asked[static_cast<std::size_t>(item)]);
            // a pair of two moving ones is reported by the lower
            if (j == i || (!b.held[j] && j < i)) return;
            if (near_floes(scene, i, j, margin))
                out.push_back(make_pair(std::min(i, j), std::max(i, j)));
        });
    }
    std::sort(out.begin(), out.end());
}

namespace {

// The list is made for bodies that go this far [m]; more makes it longer, less makes it anew often.
constexpr double kSkin = 0.1;

}  // namespace

bool PairList::is_good(const Scene& scene, const Travel& travel) const {
    const Bodies& b = scene.bodies;
    if (way_.size() != b.size() || moving_ != b.moving) return false;
    const auto stayed = [&](std::int32_t i) { return travel.soon(i) <= way_[i] + kSkin; };
    return stayed(kShip) && std::all_of(moving_.begin(), moving_.end(), stayed);
}

void PairList::update(const Scene& scene, const Travel& travel, double margin) {
    if (is_good(scene, travel)) return;
    // both bodies of a pair may go as far
    find_pairs(scene, margin + 2.0 * kSkin, pairs_);
    moving_ = scene.bodies.moving;
    way_.resize(travel.size());
    for (std::size_t i = 0; i < way_.size(); ++i)
        way_[i] = travel.way(static_cast<std::int32_t>(i));
}

namespace reference {

void find_pairs(const Scene& scene, double margin, std::vector<BodyPair>& out) {
    out.clear();
    const Bodies& b = scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i)
        if (near_ship(scene, i, margin)) out.push_back(make_pair(kShip, i));
    for (std::size_t i = 1; i < b.size(); ++i)
        for (std::size_t j = i + 1; j < b.size(); ++j)
            if (!(b.held[i] && b.held[j]) && near_floes(scene, i, j, margin))
                out.push_back(make_pair(i, j));
}

}  // namespace reference

}  // namespace ice
