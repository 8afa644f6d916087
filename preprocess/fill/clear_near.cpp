// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/clear_near.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

#include "common/base/parallel.hpp"
#include "preprocess/fill/near_triangle.hpp"

namespace ice {

namespace {

// None of these numbers changes a bit of the result; they set the time alone.
constexpr std::size_t kSerialClearing = 1000;  // triangles [-]: of fewer, waking threads costs more
constexpr std::size_t kGroup = 16;             // triangles worked at together [-]
constexpr double kPiece = 32.0;                // [pitches]: longer triangles visit in pieces
constexpr double kMostPieces = 1000.0;  // along the box [-]: of a coarse mesh in a fine lattice
using detail::Corners;
using detail::Range;
using Near = detail::NearTriangle;

// A triangle and the lattice points that wait for their distance from it.
struct Visit {
    Near triangle;
    PointBatch points;
    std::array<std::size_t, PointBatch::kMost> word;
    std::array<std::uint8_t, PointBatch::kMost> bit;
    std::array<double, PointBatch::kMost> distance_sq;

    void add(double x, double y, double z, std::size_t at_word, int at_bit) {
        const std::size_t k = points.count++;
        points.x[k] = x;
        points.y[k] = y;
        points.z[k] = z;
        word[k] = at_word;
        bit[k] = static_cast<std::uint8_t>(at_bit);
    }

    void measure() {
        if (points.count > 0) triangle.measure(points, distance_sq.data());
    }

    void clear(LatticeBits& bits) {
        for (std::size_t k = 0; k < points.count; ++k) {
            if (!triangle.is_near(points, k, distance_sq[k])) continue;
            // threads share words, and only ever clear bits of them
            const std::atomic_ref<std::uint64_t> shared(bits[word[k]]);
            shared.fetch_and(~(std::uint64_t{1} << bit[k]), std::memory_order_relaxed);
        }
        points.count = 0;
    }
};

class Clearer {
public:
    Clearer(const LatticeFrame& frame, LatticeBits& bits)
        : frame_(frame), bits_(bits), per_(frame.step.cwiseInverse()) {}

    // Visits the points within reach of the box of a triangle or of a piece of it.
    void ask(Visit& visit, const Vec3& low, const Vec3& high) const {
        const Near& triangle = visit.triangle;
        const Vec3 from = low - triangle.reach(-1), to = high + triangle.reach(1);
        const double y = frame_.first.y();
        const Range js((from.y() - y) * per_.y() + frame_.middle,
                       (to.y() - y) * per_.y() + frame_.middle, frame_.count[1]);
        const std::array<Range, 2> ks{heights(from.z(), to.z(), 0), heights(from.z(), to.z(), 1)};
        // rows of one j have one of two sets of heights: the close packing's layers alternate
        for (std::int64_t j = js.from; j <= js.to; ++j) {
            const Range& rows = ks[static_cast<std::size_t>(j & 1)];
            for (std::int64_t k = rows.from; k <= rows.to; ++k) {
                const Vec3 start = frame_.point(0, j, k);
                double left = from.x(), right = to.x();
                triangle.narrow(start.y(), start.z(), left, right);
                if (left <= right) ask_row(visit, left, right, start, frame_.row(j, k));
            }
        }
    }

private:
    // The rows k of a family between two z.
    Range heights(double low, double high, int family) const {
        const double base = frame_.height(family);
        return {(low - base) * per_.z(), (high - base) * per_.z(), frame_.count[2]};
    }

    // Takes down the set points of a row between two x.
    void ask_row(Visit& visit, double from, double to, const Vec3& start, std::size_t row) const {
        const Range is((from - start.x()) * per_.x(), (to - start.x()) * per_.x(), frame_.count[0]);
        if (is.from > is.to) return;
        // 64 points per word; bits outside the range are masked, and only set bits are read
        for (std::int64_t w = is.from >> 6; w <= is.to >> 6; ++w) {
            std::uint64_t mask = ~std::uint64_t{0};
            if (w == is.from >> 6) mask <<= is.from & 63;
            if (w == is.to >> 6) mask &= ~std::uint64_t{0} >> (63 - (is.to & 63));
            const std::size_t at = row * frame_.words() + static_cast<std::size_t>(w);
            const std::atomic_ref<std::uint64_t> word(bits_[at]);
            std::uint64_t asked = word.load(std::memory_order_relaxed) & mask;
            for (; asked != 0; asked &= asked - 1) {
                const int bit = std::countr_zero(asked);
                const double along = frame_.step.x() * static_cast<double>(64 * w + bit);
                // a full batch is measured before it takes more
                if (visit.points.count == PointBatch::kMost) {
                    visit.measure();
                    visit.clear(bits_);
                }
                visit.add(start.x() + along, start.y(), start.z(), at, bit);
            }
        }
    }

    const LatticeFrame& frame_;
    LatticeBits& bits_;
    Vec3 per_;
};

struct Piece {
    Corners whole, part;
};

// Halves a triangle across its longest edge until none is longer than `most`.
void split(const Corners& whole, double most, std::vector<Piece>& out) {
    std::vector<Corners> open{whole};
    while (!open.empty()) {
        // small pieces have tight boxes: fewer points of the lattice are measured without need
        const Corners corner = open.back();
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
            out.push_back({whole, corner});
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
        return Corners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    };
    // step by step for a group of triangles, so that the machine works at several at a time
    const auto clear = [&](std::size_t count, const auto& whole, const auto& part) {
        std::array<Visit, kGroup> visits;
        for (std::size_t n = 0; n < count; ++n) {
            const Corners& c = whole(n);
            visits[n].triangle.prepare(c[0], c[1], c[2], distance);
        }
        for (std::size_t n = 0; n < count; ++n) {
            const Corners& c = part(n);
            clearer.ask(visits[n], c[0].cwiseMin(c[1]).cwiseMin(c[2]),
                        c[0].cwiseMax(c[1]).cwiseMax(c[2]));
        }
        for (std::size_t n = 0; n < count; ++n) visits[n].measure();
        for (std::size_t n = 0; n < count; ++n) visits[n].clear(bits);
    };
    const std::size_t count = mesh.triangles.size(), groups = (count + kGroup - 1) / kGroup;
    std::vector<std::uint8_t> large(count, 0);
    parallel_for(groups, kSerialClearing / kGroup, [&](std::size_t g) {
        std::array<Corners, kGroup> group;
        std::size_t n = 0;
        for (std::size_t t = g * kGroup; t < std::min(count, (g + 1) * kGroup); ++t) {
            const Corners c = corners(t);
            const Vec3 size =
                c[0].cwiseMax(c[1]).cwiseMax(c[2]) - c[0].cwiseMin(c[1]).cwiseMin(c[2]);
            large[t] = size.maxCoeff() > most;
            if (!large[t]) group[n++] = c;
        }
        const auto whole = [&](std::size_t k) -> const Corners& { return group[k]; };
        clear(n, whole, whole);
    });
    // Long triangles afterwards and in pieces: the box of a whole one would hold most of the
    // lattice. Their pieces differ in cost, so each is its own task.
    std::vector<Piece> pieces;
    for (std::size_t t = 0; t < count; ++t)
        if (large[t]) split(corners(t), most, pieces);
    parallel_for(pieces.size(), 2, [&](std::size_t k) {
        clear(
            1, [&](std::size_t) -> const Corners& { return pieces[k].whole; },
            [&](std::size_t) -> const Corners& { return pieces[k].part; });
    });
}

}  // namespace ice
