// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/broad/find_pairs.hpp"

#include <algorithm>
#include <span>

#include "common/base/assert.hpp"

namespace ice {

namespace {

constexpr auto kShipId = static_cast<std::int32_t>(kShip);

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

double largest_radius(const Scene& scene) {
    double largest = 0.0;
    for (std::size_t k = 1; k < scene.shapes.size(); ++k)
        largest = std::max(largest, scene.shapes[k].bounding_radius);
    return largest;
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by) {
    return {box.min().array() - by, box.max().array() + by};
}

BodyPair make_pair(std::size_t a, std::size_t b) {
    return {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)};
}

// A box with the centres of all floes that may come within `margin` of a body that moves.
Eigen::AlignedBox3d reach_of_motion(const Scene& scene, double margin) {
    const Bodies& b = scene.bodies;
    const double largest = largest_radius(scene);
    Eigen::AlignedBox3d ship, floes;
    for (int k = 0; k < 8; ++k) {
        const auto corner = scene.shapes[0].box.corner(Eigen::AlignedBox3d::CornerType(k));
        ship.extend(Vec3(b.position[kShip] + b.rotation[kShip] * corner));
    }
    // a position that is not a number would make the box one, too, and hide all floes
    for (const std::int32_t i : b.moving)
        if (b.position[i].allFinite()) floes.extend(b.position[i]);
    ship = grown(ship, largest + margin);
    return floes.isEmpty() ? ship : ship.merged(grown(floes, 2.0 * largest + margin));
}

void find_floes(const Scene& scene, const Eigen::AlignedBox3d& box,
                std::vector<std::int32_t>& out) {
    out.clear();
    const Bodies& b = scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i)
        if (box.contains(b.position[i])) out.push_back(static_cast<std::int32_t>(i));
}

// The pairs of the ship and `floes`, those within reach_of_motion() and perhaps others.
void find_pairs_among(const Scene& scene, double margin, std::span<const std::int32_t> floes,
                      PlacedFloes& work, std::vector<BodyPair>& out) {
    out.clear();
    const Bodies& b = scene.bodies;
    // The ship is one long body: its box against each floe. Floes are many of about one size: a
    // grid of their bounding spheres, with cells as large as the farthest pair.
    for (const std::int32_t i : floes)
        if (near_ship(scene, static_cast<std::size_t>(i), margin)) out.push_back({kShipId, i});

    std::vector<std::int32_t>& placed = work.floes;
    placed.clear();
    work.places.clear();
    for (const std::int32_t i : floes) {
        if (!b.position[i].allFinite()) continue;  // a run that fails says so after the step
        placed.push_back(i);
        work.places.push_back(b.position[i]);
    }
    const double largest = largest_radius(scene);
    work.grid.build(work.places, 2.0 * largest + margin);
    for (const std::int32_t i : placed) {
        if (b.held[i]) continue;  // two held floes are no pair: moving ones search
        const double range = bounding_radius(scene, static_cast<std::size_t>(i)) + largest + margin;
        work.grid.for_each_near(b.position[i], range, [&](std::int32_t item) {
            const std::int32_t j = placed[static_cast<std::size_t>(item)];
            // a pair of two moving ones is reported by the lower
            if (j == i || (!b.held[j] && j < i)) return;
            if (near_floes(scene, static_cast<std::size_t>(i), static_cast<std::size_t>(j), margin))
                out.push_back({std::min(i, j), std::max(i, j)});
        });
    }
    std::sort(out.begin(), out.end());
}

}  // namespace

void find_pairs(const Scene& scene, double margin, std::vector<BodyPair>& out) {
    ICE_ASSERT(std::is_sorted(scene.bodies.moving.begin(), scene.bodies.moving.end()));
    std::vector<std::int32_t> floes;
    PlacedFloes work;
    find_floes(scene, reach_of_motion(scene, margin), floes);
    find_pairs_among(scene, margin, floes, work, out);
}

namespace {

// The list is valid until a body has moved this far [m]. More makes the list longer, less renews it
// more often; the contacts are the same.
constexpr double kSkin = 0.1;

// The held floe that drifts fastest, or -1 where none does: its path bounds those of all
// others.
std::int32_t fastest_held(const Bodies& b) {
    std::int32_t found = -1;
    double most = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        const double speed = b.held[i] ? b.velocity[i].norm() : 0.0;
        if (speed <= most) continue;
        most = speed;
        found = static_cast<std::int32_t>(i);
    }
    return found;
}

// The vicinity is larger than the moving bodies' reach by this [m]. More puts more floes in the
// list's grid, less has all floes looked through more often: with 5 m a ship at 2 m/s every 2.5 s.
// Only time depends on it. Before, runs with 100 000 held floes took up to three times as long.
constexpr double kVicinityRoom = 5.0;

}  // namespace

bool PairList::is_good(const Scene& scene, const MotionBounds& motion) const {
    // other bodies, or other ones that move: the list lacks their pairs
    if (bodies_ != scene.bodies.size() || moving_ != scene.bodies.moving) return false;
    // not-a-number never passes
    const auto stays = [&](std::int32_t i, double path) {
        // the path at the end of the coming step, so that the step itself is covered
        return motion.path_after_step(i) <= path + kSkin;
    };
    if (!stays(kShipId, ship_path_)) return false;
    for (std::size_t k = 0; k < moving_.size(); ++k)
        if (!stays(moving_[k], path_[k])) return false;
    return drifting_ < 0 || stays(drifting_, drift_path_);
}

void PairList::update(const Scene& scene, const MotionBounds& motion, double margin) {
    if (is_good(scene, motion)) return;
    // A pair may come nearer by both bodies' skins before the list is renewed.
    const double reach = margin + 2.0 * kSkin;  // both bodies of a pair may move as far
    const Eigen::AlignedBox3d box = reach_of_motion(scene, reach);
    drifting_ = fastest_held(scene.bodies);
    // Two levels: the floes in the vicinity change seldom, the pairs among them more often.
    // Drifting floes come into the vicinity by themselves, so it is looked through each time.
    if (bodies_ != scene.bodies.size() || !vicinity_.contains(box) || drifting_ >= 0) {
        vicinity_ = grown(box, kVicinityRoom);
        find_floes(scene, vicinity_, floes_);
        bodies_ = scene.bodies.size();
    }
    find_pairs_among(scene, reach, floes_, placed_, pairs_);
    moving_ = scene.bodies.moving;
    ship_path_ = motion.path(kShipId);
    if (drifting_ >= 0) drift_path_ = motion.path(drifting_);
    path_.resize(moving_.size());
    for (std::size_t k = 0; k < path_.size(); ++k) path_[k] = motion.path(moving_[k]);
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
