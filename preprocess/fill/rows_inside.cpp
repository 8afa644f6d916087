// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/rows_inside.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "preprocess/fill/lattice_range.hpp"

namespace ice {

namespace {

using detail::Range;

// Triangles that share a list of crossings [-], and triangles below which waking threads costs more
// than it saves. They change the time alone.
constexpr std::size_t kChunk = 256;
constexpr std::size_t kSerialTriangles = 4000;

// The surface crosses a row; the winding number changes by `sign` on the way along x.
struct Crossing {
    double x;
    std::uint32_t row;
    std::int32_t sign;

    bool operator<(const Crossing& other) const {
        return x < other.x || (x == other.x && sign < other.sign);
    }
};

// Where an edge meets the plane at height z.
struct Cut {
    double x, y;
};

// a before b in (z, y, x): neighbours then compute the same bits.
Cut cut_edge(const Vec3& a, const Vec3& b, double z) {
    const double part = (z - a.z()) / (b.z() - a.z());
    return {a.x() + part * (b.x() - a.x()), a.y() + part * (b.y() - a.y())};
}

class Scanner {
public:
    explicit Scanner(const LatticeFrame& frame)
        : frame_(frame), per_y_(1.0 / frame.step.y()), per_z_(1.0 / frame.step.z()) {}

    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c,
                      std::vector<Crossing>& out) const {
        // most triangles of a fine mesh end here, between the rows
        const Range js =
            rows_between(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}));
        if (js.from > js.to) return;
        const double low = std::min({a.z(), b.z(), c.z()}), high = std::max({a.z(), b.z(), c.z()});
        for (int family = 0; family < frame_.families(); ++family) {
            const double base = frame_.height(family);
            const Range ks((low - base) * per_z_, (high - base) * per_z_, frame_.count[2]);
            if (ks.from <= ks.to) cut_triangle({a, b, c}, family, ks, out);
        }
    }

private:
    Range rows_between(double low, double high) const {
        return {(low - frame_.first.y()) * per_y_ + frame_.middle,
                (high - frame_.first.y()) * per_y_ + frame_.middle, frame_.count[1]};
    }

    void cut_triangle(const std::array<Vec3, 3>& corners, int family, const Range& ks,
                      std::vector<Crossing>& out) const {
        // by (z, y, x); each exchange turns the triangle over
        const Vec3 *a = &corners[0], *b = &corners[1], *c = &corners[2];
        int sign = 1;
        const auto order = [&](const Vec3*& l, const Vec3*& r) {
            if (!before(*r, *l)) return;
            std::swap(l, r);
            sign = -sign;
        };
        order(a, b);
        order(b, c);
        order(a, b);
        for (std::int64_t k = ks.from; k <= ks.to; ++k) {
            const double z = frame_.z(family, k);
            if (z < a->z()) continue;
            if (!(z < c->z())) break;
            // the plane z cuts the triangle in a segment between its longest edge and a shorter
            // one
            const Cut longer = cut_edge(*a, *c, z);
            const Cut shorter = z < b->z() ? cut_edge(*a, *b, z) : cut_edge(*b, *c, z);
            // a, b, c run up the shorter edges and down the longer one
            if (longer.y < shorter.y)
                add_cut(longer, shorter, family, k, sign, out);
            else if (shorter.y < longer.y)
                add_cut(shorter, longer, family, k, -sign, out);
        }
    }

    static bool before(const Vec3& l, const Vec3& r) {
        if (l.z() != r.z()) return l.z() < r.z();
        if (l.y() != r.y()) return l.y() < r.y();
        return l.x() < r.x();
    }

    void add_cut(const Cut& low, const Cut& high, int family, std::int64_t k, int sign,
                 std::vector<Crossing>& out) const {
        const std::int64_t apart = frame_.families();
        const Range js = rows_between(low.y, high.y);
        const std::int64_t first = apart == 2 ? js.from + ((js.from ^ family) & 1) : js.from;
        for (std::int64_t j = first; j <= js.to; j += apart) {
            const double y = frame_.y(j);
            if (y < low.y) continue;
            if (!(y < high.y)) return;
            // between the two cuts: a face seen edge-on cannot throw the crossing far away
            const double part = (y - low.y) / (high.y - low.y);
            out.push_back({low.x + part * (high.x - low.x),
                           static_cast<std::uint32_t>(frame_.row(j, k)), sign});
        }
    }

    const LatticeFrame& frame_;
    double per_y_, per_z_;
};

// Sets bits [from, to) of a row.
void set_bits(std::uint64_t* row, std::int64_t from, std::int64_t to) {
    if (from >= to) return;
    const std::int64_t first = from >> 6, last = (to - 1) >> 6;
    // masks of the first and the last word; whole words lie between
    const std::uint64_t head = ~std::uint64_t{0} << (from & 63);
    const std::uint64_t tail = ~std::uint64_t{0} >> (63 - ((to - 1) & 63));
    if (first == last) {
        row[first] |= head & tail;
        return;
    }
    row[first] |= head;
    std::fill(row + first + 1, row + last, ~std::uint64_t{0});
    row[last] |= tail;
}

// Crossings row by row: those of row r are [offset[r], offset[r + 1]).
struct SortedCrossings {
    std::vector<std::uint32_t> offset;
    std::vector<Crossing> all;
};

SortedCrossings sort_crossings(const std::vector<std::vector<Crossing>>& chunks, std::size_t rows) {
    SortedCrossings out;
    out.offset.assign(rows + 2, 0);
    std::uint32_t* const next = out.offset.data() + 1;
    // a counting sort by row: one count, one place for each crossing
    for (const auto& chunk : chunks)
        for (const Crossing& c : chunk) ++next[c.row + 1];
    for (std::size_t r = 0; r < rows; ++r) next[r + 1] += next[r];
    out.all.resize(next[rows]);
    for (const auto& chunk : chunks)
        for (const Crossing& c : chunk) out.all[next[c.row]++] = c;
    return out;
}

}  // namespace

LatticeBits rows_inside(const TriangleMesh& mesh, const LatticeFrame& frame) {
    const Scanner scanner(frame);
    const std::size_t count = mesh.triangles.size();
    std::vector<std::vector<Crossing>> chunks((count + kChunk - 1) / kChunk);
    parallel_for(chunks.size(), kSerialTriangles / kChunk, [&](std::size_t chunk) {
        // Chunks of triangles, not threads, own the lists: their order is the same for any number
        // of threads.
        const std::size_t end = std::min(count, (chunk + 1) * kChunk);
        for (std::size_t t = chunk * kChunk; t < end; ++t)
            scanner.add_triangle(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2),
                                 chunks[chunk]);
    });
    SortedCrossings crossings = sort_crossings(chunks, frame.rows());

    LatticeBits bits(frame.rows() * frame.words(), 0);
    const double per_x = 1.0 / frame.step.x();
    parallel_for(static_cast<std::size_t>(frame.count[2]), 16, [&](std::size_t k) {
        for (std::int64_t j = 0; j < frame.count[1]; ++j) {
            const std::size_t row = frame.row(j, static_cast<std::int64_t>(k));
            Crossing* const begin = crossings.all.data() + crossings.offset[row];
            Crossing* const end = crossings.all.data() + crossings.offset[row + 1];
            std::sort(begin, end);
            const double start = frame.start(j, static_cast<std::int64_t>(k));
            const auto index = [&](double x) {  // first point not before x
                const double at = std::ceil((x - start) * per_x);
                return static_cast<std::int64_t>(
                    std::clamp(at, 0.0, static_cast<double>(frame.count[0])));
            };
            int winding = 0;
            for (const Crossing* c = begin; c != end; ++c) {
                // a ray along x is inside where the sum of its crossings' signs is not zero, also
                // where parts overlap
                winding += c->sign;
                if (winding != 0 && c + 1 != end)
                    set_bits(bits.data() + row * frame.words(), index(c->x), index((c + 1)->x));
            }
        }
    });
    return bits;
}

}  // namespace ice
