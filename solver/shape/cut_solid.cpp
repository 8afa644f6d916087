// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/cut_solid.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "common/geometry/plane_crossing.hpp"

namespace ice {

namespace {

// Least distance of a cut from the corners of the piece [m]. A larger value leaves ice that was
// crushed, a smaller one makes edges as short as rounding.
constexpr double kClearCorner = 1e-4;

// Planes whose normals are this near (cosine [-]; 2e-3 rad) become one. A larger angle takes off
// too much or too little where a long face is crushed at a small angle; a smaller one gives a
// piece more planes.
constexpr double kSameCut = 1.0 - 2e-6;

// Planes of a piece [-] from which on a cut moves the nearest one. More take longer in each
// contact search; fewer make round corners coarse. A solid has at most twice as many corners, less
// four (Euler's formula), for which there must be room.
constexpr std::size_t kMostPlanes = 34;
static_assert(2 * kMostPlanes - 4 <= ConvexPiece::kMost);

// The offset of a plane that keeps clear of all corners, outward of the given one.
double clear_offset(const ConvexPiece& piece, const HalfSpace& within) {
    std::vector<double> heights;
    for (std::size_t k = 0; k < piece.corners.size(); ++k)
        heights.push_back(within.normal.dot(piece.corners[k]));
    std::sort(heights.begin(), heights.end());
    double offset = within.offset;
    for (const double height : heights)
        if (height > offset - kClearCorner && height < offset + kClearCorner)
            offset = height + kClearCorner;
    return offset;
}

// A piece while it is cut. Corners and planes have the old numbers, new corners follow, and the cut
// is the plane behind the last.
class Cutting {
public:
    Cutting(const ConvexPiece& piece, const HalfSpace& within) : piece_(piece), within_(within) {
        for (std::size_t k = 0; k < piece.corners.size(); ++k) {
            corners_.push_back(piece.corners[k]);
            height_.push_back(within.normal.dot(corners_.back()) - within.offset);
        }
        for (const SolidEdge& e : piece.edges) cut_edge(e);
        // In each plane that is cut, the new edge leads from where its outline leaves to where it
        // comes back.
        const auto cut = static_cast<std::int32_t>(piece.plane_count());
        for (const auto& [plane, at] : crossings_) edges_.push_back({at[0], at[1], plane, cut});
    }

    // The planes and corners that are left keep their order: numbers name contacts from step to
    // step.
    ConvexPiece piece() const {
        std::vector<HalfSpace> planes;
        std::vector<Vec3> corners;
        const std::vector<std::int32_t> plane_number = left_planes(planes),
                                        corner_number = left_corners(corners);
        std::vector<SolidEdge> edges;
        for (const SolidEdge& e : edges_)
            edges.push_back({corner_number[static_cast<std::size_t>(e.begin)],
                             corner_number[static_cast<std::size_t>(e.end)],
                             plane_number[static_cast<std::size_t>(e.left)],
                             plane_number[static_cast<std::size_t>(e.right)]});
        return piece_of(planes, corners, std::move(edges));
    }

private:
    bool is_in(std::int32_t corner) const {
        return height_[static_cast<std::size_t>(corner)] <= 0.0;
    }

    void cut_edge(const SolidEdge& e) {
        if (!is_in(e.begin) && !is_in(e.end)) return;
        if (is_in(e.begin) && is_in(e.end)) return edges_.push_back(e);
        const Vec3 &p = corners_[static_cast<std::size_t>(e.begin)],
                   &q = corners_[static_cast<std::size_t>(e.end)];
        const double hp = height_[static_cast<std::size_t>(e.begin)],
                     hq = height_[static_cast<std::size_t>(e.end)];
        const auto at = static_cast<std::int32_t>(corners_.size());
        corners_.push_back(plane_crossing(p, hp, q, hq));
        height_.push_back(0.0);
        // the outline of `left` runs from begin to end, that of `right` back
        const bool leaves_left = is_in(e.begin);
        edges_.push_back(leaves_left ? SolidEdge{e.begin, at, e.left, e.right}
                                     : SolidEdge{at, e.end, e.left, e.right});
        crossings_[e.left][leaves_left ? 0 : 1] = at;
        crossings_[e.right][leaves_left ? 1 : 0] = at;
    }

    // The planes that have edges, and the new numbers of all.
    std::vector<std::int32_t> left_planes(std::vector<HalfSpace>& out) const {
        std::vector<HalfSpace> planes;
        for (std::size_t k = 0; k < piece_.plane_count(); ++k)
            planes.push_back({piece_.normals[k], piece_.offsets[k]});
        planes.push_back(within_);
        std::vector<bool> used(planes.size(), false);
        for (const SolidEdge& e : edges_) {
            used[static_cast<std::size_t>(e.left)] = true;
            used[static_cast<std::size_t>(e.right)] = true;
        }
        return left(planes, used, out);
    }
    std::vector<std::int32_t> left_corners(std::vector<Vec3>& out) const {
        std::vector<bool> used;
        for (const double height : height_) used.push_back(height <= 0.0);
        return left(corners_, used, out);
    }
    template <class T>
    static std::vector<std::int32_t> left(const std::vector<T>& all, const std::vector<bool>& used,
                                          std::vector<T>& out) {
        std::vector<std::int32_t> number(all.size(), -1);
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (!used[k]) continue;
            number[k] = static_cast<std::int32_t>(out.size());
            out.push_back(all[k]);
        }
        return number;
    }

    const ConvexPiece& piece_;
    HalfSpace within_;
    std::vector<Vec3> corners_;
    std::vector<double> height_;  // of the corners over the cut [m]
    std::vector<SolidEdge> edges_;
    // by plane: the corners where its outline leaves the half-space, and where it comes back
    std::map<std::int32_t, std::array<std::int32_t, 2>> crossings_;
};

}  // namespace

ConvexPiece cut_piece(const ConvexPiece& piece, HalfSpace within) {
    within.offset = clear_offset(piece, within);
    double highest = within.normal.dot(piece.corners[0]), lowest = highest;
    for (std::size_t k = 1; k < piece.corners.size(); ++k) {
        highest = std::max(highest, within.normal.dot(piece.corners[k]));
        lowest = std::min(lowest, within.normal.dot(piece.corners[k]));
    }
    if (highest <= within.offset) return piece;
    if (lowest > within.offset) return {};
    ConvexPiece out = Cutting(piece, within).piece();
    return out.corners.size() <= ConvexPiece::kMost ? out : ConvexPiece{};
}

bool crush_solid(ConvexPiece& solid, const Vec3& outward, const Vec3& point) {
    Vec3 normal = outward;
    double nearest = -1.0;
    for (std::size_t k = 0; k < solid.plane_count(); ++k) {
        const double facing = solid.normals[k].dot(outward);
        if (facing <= nearest) continue;
        nearest = facing;
        normal = solid.normals[k];
    }
    if (nearest < kSameCut && solid.plane_count() < kMostPlanes) normal = outward;
    ConvexPiece left = cut_piece(solid, {normal, normal.dot(point)});
    if (left.empty()) return false;
    solid = std::move(left);
    return true;
}

}  // namespace ice
