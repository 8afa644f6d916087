// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/clear_near.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "common/base/parallel.hpp"
#include "preprocess/fill/triangle_distances.hpp"
#include "preprocess/measure/closest_on_triangle.hpp"

namespace ice {

namespace {

constexpr std::size_t kSerialTriangles = 1000;  // below, waking threads costs more than it saves
constexpr double kPiece = 32.0;                 // pitches: longer triangles visit in pieces
constexpr double kMostPieces = 1000.0;          // along the box
constexpr double kDoubt = 1e-5;      // of the squared distance: what quick answers must leave
constexpr double kSlack = 1e-6;      // of the distance, pitch: by how much ranges are widened
constexpr double kSteep = 1e-3;      // |n_x| from which a plane cuts a row within reach
constexpr double kRounding = 1e-15;  // of a cross product's factors: a few units in the last place

// A triangle that knows the part of a row it is near to, and what is near it there.
class Near {
public:
    Near(const Vec3& a, const Vec3& b, const Vec3& c, double distance)
        : sides_{{a, b, c}, {b - a, c - b, a - c}, {}, {}, {}, 0.0}, distance_(distance) {
        sides_.normal = sides_.edge[0].cross(sides_.edge[1]);
        const double area_sq = sides_.normal.squaredNorm();
        double longest_sq = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length_sq = sides_.edge[k].squaredNorm();
            sides_.per_edge_sq[k] = 1.0 / length_sq;
            longest_sq = std::max(longest_sq, length_sq);
        }
        // the normal of a sliver is rounding: then only the exact answer counts
        const double turn = kRounding * longest_sq, most = 0.1 * kSlack * distance;
        has_plane_ = turn * turn * (longest_sq + 4.0 * distance * distance) < most * most * area_sq;
        if (!has_plane_) return;
        for (std::size_t k = 0; k < 3; ++k) sides_.inward[k] = sides_.normal.cross(sides_.edge[k]);
        sides_.per_area_sq = 1.0 / area_sq;
        reach_ = distance * (1.0 + kSlack) * std::sqrt(area_sq);
        above_ = kSlack * reach_;
        steep_ = std::abs(sides_.normal.x()) * distance > kSteep * reach_;
        per_x_ = steep_ ? 1.0 / sides_.normal.x() : 0.0;
    }

    /// Narrows the part [from, to] of the row at y, z to the inner half of the plane's slab: the
    /// nearest triangle of a point inside the solid has the point on its inner side, or shares the
    /// nearest corner or edge with one that has.
    void narrow(double y, double z, double& from, double& to) const {
        if (!has_plane_) return;
        const Vec3 &a = sides_.corner[0], &n = sides_.normal;
        const double height = n.y() * (y - a.y()) + n.z() * (z - a.z());
        if (steep_) {
            const double top = a.x() + (above_ - height) * per_x_;
            const double bottom = a.x() - (reach_ + height) * per_x_;
            from = std::max(from, std::min(top, bottom));
            to = std::min(to, std::max(top, bottom));
            return;
        }
        const double turn =
            std::abs(n.x()) * std::max(std::abs(from - a.x()), std::abs(to - a.x()));
        if (height - turn > above_ || height + turn < -reach_) to = from - 1.0;
    }

    /// found(k) for each point of a batch that is closer than the distance.
    template <class Found>
    void find(PointBatch& points, const Found& found) const {
        const double square = distance_ * distance_;
        double near = 0.0, far = std::numeric_limits<double>::infinity();
        std::array<double, PointBatch::kMost> distance_sq;
        if (has_plane_) {
            for (std::size_t k = points.count; k % PointBatch::kPadding != 0; ++k)
                points.x[k] = points.y[k] = points.z[k] = 0.0;
            measure_distances(sides_, points, distance_sq.data());
            near = square * (1.0 - kDoubt);
            far = square * (1.0 + kDoubt);
        } else {
            distance_sq.fill(square);
        }
        for (std::size_t k = 0; k < points.count; ++k) {
            if (distance_sq[k] > far) continue;
            if (distance_sq[k] < near || is_near({points.x[k], points.y[k], points.z[k]})) found(k);
        }
    }

    double distance() const { return distance_; }

private:
    bool is_near(const Vec3& p) const {
        const auto& c = sides_.corner;
        return (p - closest_on_triangle(p, c[0], c[1], c[2]).point).norm() < distance_;
    }

    TriangleSides sides_;
    double distance_;
    // heights over the plane are measured in units of the normal's length
    double reach_ = 0.0, above_ = 0.0, per_x_ = 0.0;
    bool has_plane_ = false, steep_ = false;
};

// Indices of lattice points between two reals, ends included.
struct Range {
    std::int64_t from, to;

    Range(double low, double high, std::int64_t count) {
        const double last = static_cast<double>(count - 1);
        from =
            low > 0.0 ? static_cast<std::int64_t>(std::min(low + (1.0 - kSlack), last + 1.0)) : 0;
        to = high >= -kSlack ? static_cast<std::int64_t>(std::min(high + kSlack, last)) : -1;
    }
};

// Lattice points waiting for their distance from a triangle.
class Queue {
public:
    Queue(const Near& triangle, LatticeBits& bits) : triangle_(triangle), bits_(bits) {}

    void add(double x, double y, double z, std::size_t word, int bit) {
        if (points_.count == PointBatch::kMost) flush();
        const std::size_t k = points_.count++;
        points_.x[k] = x;
        points_.y[k] = y;
        points_.z[k] = z;
        word_[k] = word;
        bit_[k] = static_cast<std::uint8_t>(bit);
    }

    void flush() {
        if (points_.count == 0) return;
        triangle_.find(points_, [&](std::size_t k) {
            // threads share words, and only ever clear bits of them
            const std::atomic_ref<std::uint64_t> word(bits_[word_[k]]);
            word.fetch_and(~(std::uint64_t{1} << bit_[k]), std::memory_order_relaxed);
        });
        points_.count = 0;
    }

private:
    const Near& triangle_;
    LatticeBits& bits_;
    PointBatch points_;
    std::array<std::size_t, PointBatch::kMost> word_;
    std::array<std::uint8_t, PointBatch::kMost> bit_;
};

class Clearer {
public:
    Clearer(const LatticeFrame& frame, LatticeBits& bits)
        : frame_(frame), bits_(bits), per_(frame.step.cwiseInverse()) {}

    // Visits the points within reach of the box of a triangle or of a piece of it.
    void clear(const Near& triangle, const Vec3& low, const Vec3& high) const {
        const double reach = triangle.distance() * (1.0 + kSlack);
        const double y = frame_.first.y();
        const Range js((low.y() - reach - y) * per_.y() + frame_.middle,
                       (high.y() + reach - y) * per_.y() + frame_.middle, frame_.count[1]);
        const std::int64_t apart = frame_.families();
        Queue queue(triangle, bits_);
        for (int family = 0; family < apart; ++family) {
            const double base = frame_.height(family);
            const Range ks((low.z() - reach - base) * per_.z(),
                           (high.z() + reach - base) * per_.z(), frame_.count[2]);
            const std::int64_t first = apart == 2 ? js.from + ((js.from ^ family) & 1) : js.from;
            for (std::int64_t k = ks.from; k <= ks.to; ++k)
                for (std::int64_t j = first; j <= js.to; j += apart) {
                    double from = low.x() - reach, to = high.x() + reach;
                    triangle.narrow(frame_.y(j), frame_.z(j, k), from, to);
                    if (from <= to) ask_row(queue, from, to, j, k);
                }
        }
        queue.flush();
    }

private:
    // Queues the set points of a row between two x.
    void ask_row(Queue& queue, double from, double to, std::int64_t j, std::int64_t k) const {
        const double start = frame_.start(j, k);
        const Range is((from - start) * per_.x(), (to - start) * per_.x(), frame_.count[0]);
        if (is.from > is.to) return;
        const std::size_t row = frame_.row(j, k) * frame_.words();
        for (std::int64_t w = is.from >> 6; w <= is.to >> 6; ++w) {
            std::uint64_t mask = ~std::uint64_t{0};
            if (w == is.from >> 6) mask <<= is.from & 63;
            if (w == is.to >> 6) mask &= ~std::uint64_t{0} >> (63 - (is.to & 63));
            const std::size_t at = row + static_cast<std::size_t>(w);
            const std::atomic_ref<std::uint64_t> word(bits_[at]);
            std::uint64_t asked = word.load(std::memory_order_relaxed) & mask;
            for (; asked != 0; asked &= asked - 1) {
                const int bit = std::countr_zero(asked);
                const double x = start + frame_.step.x() * static_cast<double>(64 * w + bit);
                queue.add(x, frame_.y(j), frame_.z(j, k), at, bit);
            }
        }
    }

    const LatticeFrame& frame_;
    LatticeBits& bits_;
    Vec3 per_;
};

struct Piece {
    std::size_t triangle;
    std::array<Vec3, 3> corner;
};

// Halves a triangle across its longest edge until none is longer than `most`.
void split(std::size_t triangle, const std::array<Vec3, 3>& whole, double most,
           std::vector<Piece>& out) {
    std::vector<std::array<Vec3, 3>> open{whole};
    while (!open.empty()) {
        const auto corner = open.back();
        open.pop_back();
        std::size_t edge = 0;
        double longest = -1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = (corner[(k + 1) % 3] - corner[k]).norm();
            if (length > longest) {
                longest = length;
                edge = k;
            }
        }
        if (longest <= most) {
            out.push_back({triangle, corner});
            continue;
        }
        const Vec3 &a = corner[edge], &b = corner[(edge + 1) % 3], &c = corner[(edge + 2) % 3];
        const Vec3 half = 0.5 * (a + b);
        open.push_back({a, half, c});
        open.push_back({half, b, c});
    }
}

}  // namespace

void clear_near(const TriangleMesh& mesh, const LatticeFrame& frame, double distance,
                LatticeBits& bits) {
    if (bits.empty()) return;
    const Clearer clearer(frame, bits);
    double most = kPiece * frame.step.x();
    for (int d = 0; d < 3; ++d)
        most = std::max(most, frame.step[d] *
                                  static_cast<double>(frame.count[static_cast<std::size_t>(d)]) /
                                  kMostPieces);
    const auto corners = [&](std::size_t t) {
        return std::array<Vec3, 3>{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    };
    const auto clear = [&](const std::array<Vec3, 3>& whole, const std::array<Vec3, 3>& piece) {
        const Near triangle(whole[0], whole[1], whole[2], distance);
        clearer.clear(triangle, piece[0].cwiseMin(piece[1]).cwiseMin(piece[2]),
                      piece[0].cwiseMax(piece[1]).cwiseMax(piece[2]));
    };
    std::vector<std::uint8_t> large(mesh.triangles.size(), 0);
    parallel_for(mesh.triangles.size(), kSerialTriangles, [&](std::size_t t) {
        const auto whole = corners(t);
        const Vec3 size = whole[0].cwiseMax(whole[1]).cwiseMax(whole[2]) -
                          whole[0].cwiseMin(whole[1]).cwiseMin(whole[2]);
        large[t] = size.maxCoeff() > most;
        if (!large[t]) clear(whole, whole);
    });
    std::vector<Piece> pieces;
    for (std::size_t t = 0; t < large.size(); ++t)
        if (large[t]) split(t, corners(t), most, pieces);
    parallel_for(pieces.size(), 2,
                 [&](std::size_t k) { clear(corners(pieces[k].triangle), pieces[k].corner); });
}

}  // namespace ice
