// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/layer_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/parallel.hpp"
#include "preprocess/fill/mirror_seat.hpp"

namespace ice {

namespace {

constexpr double kPi = std::numbers::pi;

// All in spacings [-]. In a layer of perfect hexagons the neighbours of a seat lie at 1,
// the next ones at sqrt(3) = 1.73, and the corners of its Voronoi cells at 1 / sqrt(3) = 0.577
// from the nearest seats. The certificate's covering radius is the largest such
// distance in the layer: it can be no less than 0.577, and kGap and kCovered lie just above. Lower
// ones need seats where the separations below leave no room; higher ones leave larger gaps.
//
// The separations are below 1, because fronts that meet do not fit: a lower one puts more seats
// into their seams, a higher one leaves gaps there for the next stage.
constexpr double kHalo = 2.0;             // how far beyond the tile seats matter: over kCellReach
constexpr double kBeyond = 1.2;           // how far beyond it gaps are closed
constexpr double kStretch = 1.02;         // of a front's hexagons
constexpr double kReach = 1.4;            // neighbours that take part in a hexagon: 1, not 1.73
constexpr double kSeparation = 0.74;      // a hexagon's seams: nearer than this is not placed
constexpr double kMirrorGap = 0.37;       // half of it: a sphere and its image
constexpr double kTaken = 0.6;            // a start this near to a seat is not settled
constexpr double kUnreached = 0.9;        // a seed this far from all seats starts a front
constexpr double kGap = 0.635;            // corners of Voronoi cells farther away are gaps
constexpr double kGapSeparation = 0.61;   // a gap's seat: nearer than this is not placed
constexpr double kGapMirror = 0.15;       // from a gap's seat to the centre plane, at least
constexpr double kCovered = 0.62;         // a seed farther from all seats gets one
constexpr double kCoverSeparation = 0.4;  // where it had to move into the centre plane
constexpr double kAlike = 0.25;           // cube of seeds that end alike, of radius and spacing
constexpr double kCellReach = 1.75;       // neighbours that bound a Voronoi cell: 1.73, too
constexpr double kCellSize = 0.9;         // half the edge of the square a cell starts as
constexpr double kOutside = 0.02;         // beyond a plane: not settled in a convex solid

// Seats of a fine mesh [-] below which one thread settles them alone: waking others costs more. It
// changes the time alone.
constexpr std::size_t kFewFine = 16;
// Faces times vertices [-] up to which a mesh is tested for being convex: floes are, hulls are not.
// A larger value tests more meshes without use, a smaller one settles starts outside convex solids.
constexpr std::size_t kMostConvexTests = 10000;
// Height over the largest extent [-] up to which vertices lie in a face's plane. A larger value
// takes hollow solids for convex ones, a smaller one convex solids for hollow ones by rounding.
constexpr double kCoplanar = 1e-9;

Eigen::AlignedBox3d around(const Eigen::AlignedBox3d& box, double halo) {
    return {box.min() - Vec3::Constant(halo), box.max() + Vec3::Constant(halo)};
}

}  // namespace

LayerSolid::LayerSolid(const SurfaceTree& whole) : tree(whole), convex(true) {
    // every vertex behind every face's plane; tested for small meshes only
    const TriangleMesh& mesh = tree.mesh();
    for (const Vec3& v : mesh.vertices) box.extend(v);
    if (mesh.triangles.size() * mesh.vertices.size() > kMostConvexTests) convex = false;
    const double flat = kCoplanar * box.sizes().maxCoeff();
    for (std::size_t t = 0; convex && t < mesh.triangles.size(); ++t) {
        const Vec3& normal = tree.normal(static_cast<std::int32_t>(t));
        const double height = normal.dot(mesh.corner(t, 0)) + flat;
        convex = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                             [&](const Vec3& v) { return normal.dot(v) <= height; });
    }
}

LayerTile::LayerTile(const LayerSolid& solid, const LayerOptions& options,
                     const Eigen::AlignedBox3d& box)
    : tree_(solid.tree),
      convex_(solid.convex),
      fine_(is_fine_for(solid.tree, options.radius)),
      o_(options),
      box_(box),
      grid_(around(box, kHalo * options.spacing).intersection(solid.box),
            kCellReach * options.spacing) {}

void LayerTile::take_seat(const Seat& seat) {
    const double halo = kHalo * o_.spacing;
    if (o_.mirror && seat.center.y() > 0.0 && seat.center.y() < halo) {
        const Seat image = image_of(seat);
        if (box_.exteriorDistance(image.center) < halo) grid_.add(image);
    }
    if (box_.exteriorDistance(seat.center) < halo) grid_.add(seat);
}

void LayerTile::add(const Seat& seat) {
    placed_.push_back(seat);
    take_seat(seat);
}

// In a fine mesh: a seed as this one was tried before; from now on this one was.
bool LayerTile::tried_near(const Seed& seed) {
    if (!fine_) return false;
    const double cube = kAlike * std::min(o_.spacing, o_.radius);
    const Vec3& normal = tree_.normal(seed.triangle);
    std::array<std::int32_t, 4> key{};
    for (int d = 0; d < 3; ++d)
        key[static_cast<std::size_t>(d)] =
            static_cast<std::int32_t>(std::floor((seed.seat[d] - box_.min()[d]) / cube));
    // Alike: in the same small cube, and facing the same of six directions, so that both sides of a
    // thin plate stay apart.
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    key[3] = normal[axis] > 0.0 ? axis : -1 - axis;
    return !tried_.insert(key).second;
}

bool LayerTile::place(const Vec3& start, std::int32_t hint, double separation, double mirror_gap,
                      bool outside_too) {
    const double s = o_.spacing;
    Vec3 from = start;
    if (o_.mirror && from.y() < 0.0) from.y() = -from.y();
    auto seat = settle(tree_, from, o_.radius, hint);
    // settle on the offset surface, then keep to the half y >= 0
    if (seat && o_.mirror) seat = mirror_seat(tree_, *seat, o_.radius, mirror_gap * s);
    if (!seat) return false;
    // a front places seats in its own tile only; gaps are closed a little beyond it, too
    if (outside_too ? box_.exteriorDistance(seat->center) >= kBeyond * s
                    : !box_.contains(seat->center))
        return false;
    const bool taken = seat->in_crease
                           ? grid_.any_within(seat->center, separation * s,
                                              normals_at(tree_, o_.radius, *seat, found_))
                           : grid_.any_within(seat->center, separation * s, seat->normal);
    if (taken) return false;
    add(*seat);
    return true;
}

// The planes in which a seat has neighbours: one, or one for each face met in a crease.
const std::vector<LayerTile::Plane>& LayerTile::planes_at(const Seat& seat) {
    const auto plane = [&](const Vec3& normal) {
        // fronts that start apart on one flat face get rows along the same direction
        const Vec3 axis = std::abs(normal.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitZ();
        const Vec3 e1 = (axis - axis.dot(normal) * normal).normalized();
        return Plane{seat.center, normal, e1, normal.cross(e1)};
    };
    planes_.clear();
    for (const Vec3& normal : normals_at(tree_, o_.radius, seat, found_))
        planes_.push_back(plane(normal));
    return planes_;
}

// Is a start beside the seat of planes_ beyond one of the faces that it touches? In a convex solid
// that is outside, where nothing settles. The touches may lean by sqrt(2e-5) from the faces'
// normals (two distances within 1e-5 count as touches), a hundredth of a spacing at a start.
bool LayerTile::is_outside(const Vec3& start) const {
    const double most = o_.radius + kOutside * o_.spacing;
    return convex_ && std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
               return plane.normal.dot(start - plane.centre) > most;
           });
}

// The seats that represent the same face, so that those of the other side of a thin part neither
// count nor are in the way.
void LayerTile::neighbours_in(const Plane& plane, double range) {
    neighbours_.clear();
    grid_.visit(plane.centre, range, [&](std::int32_t k, double sq) {
        if (sq < 1e-12 * range * range) return false;  // itself
        const Seat& other = grid_.seats()[static_cast<std::size_t>(k)];
        if (!other.agrees(plane.normal)) return false;
        const Vec3 d = other.center - plane.centre;
        neighbours_.push_back({d.dot(plane.e1), d.dot(plane.e2), std::sqrt(sq), 0.0});
        return false;
    });
}

void LayerTile::surround_in(const Plane& plane, std::int32_t hint) {
    const double s = kStretch * o_.spacing;
    neighbours_in(plane, kReach * s);
    for (Neighbour& n : neighbours_) n.angle = std::atan2(n.v, n.u);
    std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& l, const Neighbour& r) {
        return l.angle < r.angle || (l.angle == r.angle && l.distance < r.distance);
    });
    const auto try_at = [&](double angle) {
        const Vec3 start = plane.at(s * std::cos(angle), s * std::sin(angle));
        // where it will end is not far: most places that are taken are seen before settling
        if (is_outside(start) || grid_.any_within(start, kTaken * o_.spacing, plane.normal)) return;
        place(start, hint, kSeparation, kMirrorGap, false);
    };
    if (neighbours_.empty()) {
        try_at(0.0);
        neighbours_.push_back({s, 0.0, s, 0.0});
    }
    const std::size_t count = neighbours_.size();
    for (std::size_t k = 0; k < count; ++k) {
        // Six neighbours of a hexagon are 60 degrees apart: a gap of more than 90 degrees
        // takes another one, or several.
        const double end =
            k + 1 < count ? neighbours_[k + 1].angle : neighbours_.front().angle + 2.0 * kPi;
        double angle = neighbours_[k].angle, distance = neighbours_[k].distance;
        while (end - angle > kPi / 2.0) {
            // one place between two neighbours is midway; of more, the first is at the
            // spacing from both the centre and the neighbour
            const bool last = end - angle < 5.0 / 6.0 * kPi;
            angle += last ? 0.5 * (end - angle)
                          : std::clamp(std::acos(std::min(0.5 * distance / s, 1.0)), kPi / 4.0,
                                       5.0 / 12.0 * kPi);
            distance = s;
            try_at(angle);
        }
    }
}

void LayerTile::surround(const Seat& seat) {
    for (const Plane& plane : planes_at(seat)) surround_in(plane, seat.triangle);
}

void LayerTile::advance_front(const std::vector<Seed>& seeds) {
    auto run = [&, next = std::size_t{0}]() mutable {
        for (; next < grid_.seats().size(); ++next) {
            const Seat seat = grid_.seats()[next];
            if (o_.mirror && seat.center.y() < 0.0) continue;  // its image does it
            if (box_.exteriorDistance(seat.center) < kBeyond * o_.spacing) surround(seat);
        }
    };
    run();
    // seeds that no front reached: separate faces, and parts behind sharp edges
    for (const Seed& seed : seeds) {
        if (grid_.any_within(seed.seat, kUnreached * o_.spacing, tree_.normal(seed.triangle)))
            continue;
        if (tried_near(seed)) continue;
        if (place(seed.seat, seed.triangle, kSeparation, kMirrorGap, false)) run();
    }
}

void LayerTile::close_gaps_in(const Plane& plane, std::int32_t hint) {
    const double s = o_.spacing;
    neighbours_in(plane, kCellReach * s);
    std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& l, const Neighbour& r) {
        if (l.distance != r.distance) return l.distance < r.distance;
        return l.u < r.u || (l.u == r.u && l.v < r.v);
    });
    const double half = kCellSize * s;
    cell_ = {{half, half}, {-half, half}, {-half, -half}, {half, -half}};
    double far_sq = 2.0 * half * half;  // of the cell's farthest corner from the centre
    for (const Neighbour& n : neighbours_) {
        // the line half way to a neighbour is at least half its distance away: it and those after
        // it cut nothing off; 1e-9 covers rounding
        if (0.25 * n.distance * n.distance > far_sq * (1.0 + 1e-9)) break;
        // keep the points nearer to the centre than to its neighbour n: x . n <= |n|^2 / 2
        const double length = std::hypot(n.u, n.v);
        if (length < 1e-3 * n.distance) continue;  // straight above or below
        const double a = n.u / length, b = n.v / length,
                     bound = 0.5 * n.distance * n.distance / length;
        clipped_.clear();
        for (std::size_t k = 0; k < cell_.size(); ++k) {
            const auto& p = cell_[k];
            const auto& q = cell_[(k + 1) % cell_.size()];
            const double over_p = a * p[0] + b * p[1] - bound;
            const double over_q = a * q[0] + b * q[1] - bound;
            if (over_p <= 0.0) clipped_.push_back(p);
            if ((over_p <= 0.0) == (over_q <= 0.0)) continue;
            const double t = over_p / (over_p - over_q);
            clipped_.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
        }
        std::swap(cell_, clipped_);
        far_sq = 0.0;
        for (const auto& p : cell_) far_sq = std::max(far_sq, p[0] * p[0] + p[1] * p[1]);
    }
    // corners of a Voronoi cell are the points farthest from all seats around
    for (const auto& corner : cell_) {
        if (std::hypot(corner[0], corner[1]) <= kGap * s) continue;
        const Vec3 start = plane.at(corner[0], corner[1]);
        if (is_outside(start) || grid_.any_within(start, 0.5 * s, plane.normal)) continue;
        place(start, hint, kGapSeparation, kGapMirror, true);
    }
}

void LayerTile::close_gaps() {
    for (std::size_t k = 0; k < grid_.seats().size(); ++k) {
        const Seat seat = grid_.seats()[k];
        if (o_.mirror && seat.center.y() < 0.0) continue;
        if (box_.exteriorDistance(seat.center) >= kBeyond * o_.spacing) continue;
        for (const Plane& plane : planes_at(seat)) close_gaps_in(plane, seat.triangle);
    }
}

void LayerTile::cover(const std::vector<Seed>& seeds) {
    const double range = kCovered * o_.spacing;
    const auto is_covered = [&](const Seed& seed) {
        return grid_.any_within(seed.seat, range, tree_.normal(seed.triangle));
    };
    std::vector<const Seed*> open;
    for (const Seed& seed : seeds)
        // settled in parallel, placed one by one: a seat may cover the seeds after it
        if (!is_covered(seed) && !tried_near(seed)) open.push_back(&seed);
    std::vector<std::optional<Seat>> seats(open.size());
    parallel_for(open.size(), fine_ ? kFewFine : open.size() + 1, [&](std::size_t k) {
        seats[k] = settle(tree_, open[k]->seat, o_.radius, open[k]->triangle);
    });
    for (std::size_t k = 0; k < open.size(); ++k) {
        const auto& seat = seats[k];
        if (!seat || is_covered(*open[k]) ||
            grid_.any_within(seat->center, range, normals_at(tree_, o_.radius, *seat, found_)))
            continue;
        place(seat->center, seat->triangle, kCoverSeparation, kGapMirror, true);
    }
}

}  // namespace ice
