// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/row_crossings.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// splitmix64 to a number in [0, 1): the place of a row in its cell.
double hashed(std::uint64_t key) {
    key += 0x9e3779b97f4a7c15ull;
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((key ^ (key >> 31)) >> 11) * 0x1p-53;
}

// Twice the area of (a, b, p) in the plane across the rows, computed from the edge's ends in a
// fixed order: the two triangles of an edge get the same bits with opposite signs.
double side_of(const Vec3& a, const Vec3& b, double pu, double pv, int u, int v) {
    const bool swapped = std::pair(b[u], b[v]) < std::pair(a[u], a[v]);
    const Vec3 &lo = swapped ? b : a, &hi = swapped ? a : b;
    const double area = (hi[u] - lo[u]) * (pv - lo[v]) - (hi[v] - lo[v]) * (pu - lo[u]);
    // A row through an edge or corner is decided to one side. Both triangles of the edge compute
    // the same bits, so that exactly one of them is met.
    const double decided = area == 0.0 ? 1e-300 : area;
    return swapped ? -decided : decided;
}

class Caster {
public:
    Caster(const TriangleMesh& mesh, const RowGrid& grid)
        : mesh_(mesh), grid_(grid), u_((grid.axis + 1) % 3), v_((grid.axis + 2) % 3) {}

    std::vector<RowCrossing> cast() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) cast(t);
        std::sort(crossings_.begin(), crossings_.end(),
                  [](const RowCrossing& l, const RowCrossing& r) {
                      return l.row < r.row || (l.row == r.row && l.depth < r.depth);
                  });
        return std::move(crossings_);
    }

private:
    // Cells whose rows may lie between two coordinates.
    std::pair<std::int32_t, std::int32_t> cells(double low, double high, int d,
                                                std::int32_t count) const {
        const auto cell = [&](double x) {
            const double at = std::floor((x - grid_.low[d]) / grid_.step[d]);
            return static_cast<std::int32_t>(std::clamp(at, 0.0, count - 1.0));
        };
        return {cell(low), cell(high)};
    }

    void cast(std::size_t t) {
        const Vec3 a = mesh_.corner(t, 0), b = mesh_.corner(t, 1), c = mesh_.corner(t, 2);
        const auto [u0, u1] = cells(std::min({a[u_], b[u_], c[u_]}),
                                    std::max({a[u_], b[u_], c[u_]}), u_, grid_.count_u);
        const auto [v0, v1] = cells(std::min({a[v_], b[v_], c[v_]}),
                                    std::max({a[v_], b[v_], c[v_]}), v_, grid_.count_v);
        for (std::int32_t i = u0; i <= u1; ++i)
            for (std::int32_t j = v0; j <= v1; ++j) meet(a, b, c, i, j);
    }

    void meet(const Vec3& a, const Vec3& b, const Vec3& c, std::int32_t i, std::int32_t j) {
        const std::int32_t row = i * grid_.count_v + j;
        // two numbers for each row and axis, so that no two rows are scattered alike
        const auto key =
            static_cast<std::uint64_t>(row) * 6u + 2u * static_cast<std::uint64_t>(grid_.axis);
        const double du = grid_.scattered ? hashed(key) : 0.0;
        const double dv = grid_.scattered ? hashed(key + 1) : 0.0;
        const double pu = grid_.low[u_] + (i + du) * grid_.step[u_];
        const double pv = grid_.low[v_] + (j + dv) * grid_.step[v_];
        const double wa = side_of(b, c, pu, pv, u_, v_);
        const double wb = side_of(c, a, pu, pv, u_, v_);
        const double wc = side_of(a, b, pu, pv, u_, v_);
        // inside the triangle all three areas have one sign
        if ((wa > 0) != (wb > 0) || (wb > 0) != (wc > 0)) return;
        const int d = grid_.axis;
        const double depth = (wa * a[d] + wb * b[d] + wc * c[d]) / (wa + wb + wc);
        // anticlockwise across the row: the normal points along it, the row leaves
        crossings_.push_back({depth, row, wa > 0 ? -1 : 1});
    }

    const TriangleMesh& mesh_;
    const RowGrid& grid_;
    int u_, v_;
    std::vector<RowCrossing> crossings_;
};

}  // namespace

std::vector<RowCrossing> cross_rows(const TriangleMesh& mesh, const RowGrid& grid) {
    return Caster(mesh, grid).cast();
}

}  // namespace ice
