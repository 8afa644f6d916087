// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/level_ice/break_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/bending/convex_corners.hpp"

namespace ice {

namespace {

constexpr double kStep = 1.0 / 25.0;    // of the ship, in radii at rest
constexpr double kSample = 1.0 / 10.0;  // between places on the outline, in radii at rest

// A place on the outline and its normal.
struct Place {
    Vec2 at, outwards;
};

Vec2 outwards_of(const Loop& outline, std::size_t side) {
    const Vec2 along = outline[(side + 1) % outline.size()] - outline[side];
    return Vec2(along.y(), -along.x()).normalized();
}

// Places along the sides that move into the ice; a corner, as the stem, has both sides' normal.
std::vector<Place> places_on(const Loop& outline, double spacing) {
    std::vector<Place> out;
    const std::size_t n = outline.size();
    const auto add = [&](const Vec2& at, const Vec2& outwards) {
        if (outwards.x() > 0.0) out.push_back({at, outwards});
    };
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 here = outwards_of(outline, k), before = outwards_of(outline, (k + n - 1) % n);
        add(outline[k], (here + before).normalized());
        const Vec2 side = outline[(k + 1) % n] - outline[k];
        const int pieces = static_cast<int>(std::ceil(side.norm() / spacing));
        for (int p = 1; p < pieces; ++p)
            add(outline[k] + static_cast<double>(p) / pieces * side, here);
    }
    return out;
}

double distance_to(const Vec2& point, const Vec2& a, const Vec2& b) {
    const Vec2 side = b - a;
    const double along = std::clamp((point - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
    return (point - a - along * side).norm();
}

// How far a point lies in the ice [m]; 0 outside.
double depth_in(const IceSheet& sheet, const Vec2& point) {
    if (!sheet.contains(point)) return 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Loop& loop : sheet.loops())
        for (std::size_t k = 0; k < loop.size(); ++k)
            nearest = std::min(nearest, distance_to(point, loop[k], loop[(k + 1) % loop.size()]));
    return nearest;
}

// The place deepest in the ice, with the ship `moved`; the first of equal ones. Null where none is
// in it.
const Place* deepest_of(const std::vector<Place>& places, const Vec2& moved,
                        const IceSheet& sheet) {
    const Place* out = nullptr;
    double most = 0.0;
    for (const Place& place : places) {
        const double depth = depth_in(sheet, place.at + moved);
        if (depth <= most) continue;
        most = depth;
        out = &place;
    }
    return out;
}

}  // namespace

Loop section_outline(const TriangleMesh& mesh, double z) {
    std::vector<Vec2> points;
    for (const auto& triangle : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const Vec3& a = mesh.vertices[static_cast<std::size_t>(triangle[k])];
            const Vec3& b = mesh.vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
            if ((a.z() < z) == (b.z() < z)) continue;
            const double share = (z - a.z()) / (b.z() - a.z());
            points.emplace_back(a.x() + share * (b.x() - a.x()), a.y() + share * (b.y() - a.y()));
        }
    return convex_corners(std::move(points));
}

BrokenSheet break_sheet(IceSheet sheet, const Passage& passage) {
    BrokenSheet out{{}, std::move(sheet), 0.0};
    const double rest = cusp_radius({passage.law.length_factor}, passage.length, 0.0, 0);
    const std::vector<Place> places = places_on(passage.outline, kSample * rest);
    const auto steps = static_cast<int>(std::ceil(passage.distance / (kStep * rest)));
    std::uint64_t cusp = 0;
    for (int k = 0; k <= steps; ++k) {
        const double gone = passage.distance * k / std::max(steps, 1);
        const Vec2 moved(gone, 0.0);
        while (const Place* place = deepest_of(places, moved, out.rest)) {
            const double speed = passage.speed_at(gone) * place->outwards.x();
            const double radius = cusp_radius(passage.law, passage.length, speed, cusp++);
            const double before = out.rest.area();
            IceSheet::Broken broken =
                out.rest.break_off(crack_outline(place->at + moved, place->outwards, radius));
            out.brash += broken.brash;
            for (Loop& piece : broken.pieces) out.pieces.push_back(std::move(piece));
            if (out.rest.area() >= before) break;  // a ring: the next step tries again
        }
    }
    return out;
}

std::vector<Loop> tile_rest(IceSheet sheet, const std::vector<Loop>& pieces, double margin,
                            double tile) {
    Eigen::AlignedBox2d box;
    for (const Loop& piece : pieces)
        for (const Vec2& p : piece) box.extend(p);
    std::vector<Loop> tiles;
    if (pieces.empty()) return tiles;
    const Vec2 low = box.min() - Vec2(margin, margin), high = box.max() + Vec2(margin, margin);
    const double middle = box.center().y();
    const int count = std::max(1, static_cast<int>(std::lround((high.x() - low.x()) / tile)));
    for (int k = 0; k < count; ++k) {
        const double from = low.x() + (high.x() - low.x()) * k / count;
        const double to = low.x() + (high.x() - low.x()) * (k + 1) / count;
        for (const auto& [below, above] :
             {std::pair(low.y(), middle), std::pair(middle, high.y())}) {
            // of a copy: what a tile cuts off behind it is no tile
            IceSheet copy = sheet;
            const Loop window{{from, below}, {to, below}, {to, above}, {from, above}};
            for (Loop& part : copy.break_off(window).pieces) {
                const bool inside = std::all_of(part.begin(), part.end(), [&](const Vec2& p) {
                    return p.x() > from - 1e-6 && p.x() < to + 1e-6 && p.y() > below - 1e-6 &&
                           p.y() < above + 1e-6;
                });
                if (inside) tiles.push_back(std::move(part));
            }
        }
    }
    return tiles;
}

}  // namespace ice
