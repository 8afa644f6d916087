// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/clear_near.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "common/base/parallel.hpp"
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

// A triangle that knows what is quick to say about its distance from a point.
class Near {
public:
    Near(const Vec3& a, const Vec3& b, const Vec3& c, double distance)
        : a_(a), b_(b), c_(c), distance_(distance) {
        const double square = distance * distance;
        near_ = square * (1.0 - kDoubt);
        far_ = square * (1.0 + kDoubt);
        edge_[0] = b - a;
        edge_[1] = c - b;
        edge_[2] = a - c;
        normal_ = edge_[0].cross(edge_[1]);
        const double area = normal_.norm();
        double longest = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            length_sq_[k] = edge_[k].squaredNorm();
            longest = std::max(longest, length_sq_[k]);
        }
        // the normal of a sliver is rounding: then only the exact answer counts
        const double turn = kRounding * longest;
        has_plane_ = turn * (std::sqrt(longest) + 2.0 * distance) < 0.1 * kSlack * distance * area;
        if (!has_plane_) return;
        normal_ /= area;
        for (std::size_t k = 0; k < 3; ++k) inward_[k] = normal_.cross(edge_[k]);
    }

    bool is_near(const Vec3& p) const {
        if (has_plane_) {
            const Vec3 ap = p - a_;
            const double h = normal_.dot(ap), height_sq = h * h;
            if (height_sq > far_) return false;
            const double e0 = inward_[0].dot(ap), e1 = inward_[1].dot(p - b_),
                         e2 = inward_[2].dot(ap);
            if (e0 >= 0.0 && e1 >= 0.0 && e2 >= 0.0) {
                if (height_sq < near_) return true;
            } else if ((e0 < 0.0 && e0 * e0 > (far_ - height_sq) * length_sq_[0]) ||
                       (e1 < 0.0 && e1 * e1 > (far_ - height_sq) * length_sq_[1]) ||
                       (e2 < 0.0 && e2 * e2 > (far_ - height_sq) * length_sq_[2])) {
                return false;
            }
        }
        return (p - closest_on_triangle(p, a_, b_, c_).point).norm() < distance_;
    }

    bool has_plane() const { return has_plane_; }
    const Vec3& normal() const { return normal_; }
    const Vec3& corner() const { return a_; }
    double distance() const { return distance_; }

private:
    Vec3 a_, b_, c_, normal_;
    std::array<Vec3, 3> edge_, inward_;  // inward: in the plane, as long as the edge
    std::array<double, 3> length_sq_;
    double distance_, near_, far_;
    bool has_plane_;
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

class Clearer {
public:
    Clearer(const LatticeFrame& frame, LatticeBits& bits)
        : frame_(frame), bits_(bits), per_(frame.step.cwiseInverse()) {}

    // Visits the points within reach of the box of a triangle or of a piece of it.
    void clear(const Near& triangle, const Vec3& low, const Vec3& high) const {
        const double reach = triangle.distance() * (1.0 + kSlack);
        for (int family = 0; family < frame_.families(); ++family) {
            const double base = frame_.height(family);
            const Range ks((low.z() - reach - base) * per_.z(),
                           (high.z() + reach - base) * per_.z(), frame_.count[2]);
            const double y = frame_.first.y();
            const Range js((low.y() - reach - y) * per_.y() + frame_.middle,
                           (high.y() + reach - y) * per_.y() + frame_.middle, frame_.count[1]);
            const std::int64_t apart = frame_.families();
            const std::int64_t first = apart == 2 ? js.from + ((js.from ^ family) & 1) : js.from;
            for (std::int64_t k = ks.from; k <= ks.to; ++k)
                for (std::int64_t j = first; j <= js.to; j += apart)
                    clear_row(triangle, low.x() - reach, high.x() + reach, j, k);
        }
    }

private:
    // The part of a row between two x that lies in the slab of the triangle's plane.
    void clear_row(const Near& triangle, double from, double to, std::int64_t j,
                   std::int64_t k) const {
        const double start = frame_.start(j, k), y = frame_.y(j), z = frame_.z(j, k);
        if (triangle.has_plane()) {
            const Vec3 &n = triangle.normal(), &a = triangle.corner();
            const double reach = triangle.distance() * (1.0 + kSlack);
            const double height = n.y() * (y - a.y()) + n.z() * (z - a.z());
            if (std::abs(n.x()) > kSteep) {
                const double per = 1.0 / n.x();
                const double middle = a.x() - height * per, half = reach * std::abs(per);
                from = std::max(from, middle - half);
                to = std::min(to, middle + half);
            } else {
                const double most = std::max(std::abs(from - a.x()), std::abs(to - a.x()));
                if (std::abs(height) > reach + std::abs(n.x()) * most) return;
            }
        }
        const Range is((from - start) * per_.x(), (to - start) * per_.x(), frame_.count[0]);
        if (is.from > is.to) return;
        std::uint64_t* const row = bits_.data() + frame_.row(j, k) * frame_.words();
        for (std::int64_t w = is.from >> 6; w <= is.to >> 6; ++w) {
            std::uint64_t mask = ~std::uint64_t{0};
            if (w == is.from >> 6) mask <<= is.from & 63;
            if (w == is.to >> 6) mask &= ~std::uint64_t{0} >> (63 - (is.to & 63));
            // threads share words, and only ever clear bits of them
            const std::atomic_ref<std::uint64_t> word(row[w]);
            std::uint64_t asked = word.load(std::memory_order_relaxed) & mask, gone = 0;
            for (; asked != 0; asked &= asked - 1) {
                const std::int64_t i = 64 * w + std::countr_zero(asked);
                const double x = start + frame_.step.x() * static_cast<double>(i);
                if (triangle.is_near({x, y, z})) gone |= asked & (~asked + 1);
            }
            if (gone != 0) word.fetch_and(~gone, std::memory_order_relaxed);
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
