// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/row_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ice {

namespace {

struct Crossing {
    double depth;
    std::int32_t row;
    std::int32_t sign;  // +1: the row enters the solid
};

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
    const double decided = area == 0.0 ? 1e-300 : area;
    return swapped ? -decided : decided;
}

class Rows {
public:
    Rows(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box, int axis, int rows)
        : mesh_(mesh), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), rows_(rows) {
        low_ = box.min();
        step_ = box.sizes() / rows;
        for (std::size_t k = 0; k < mesh.triangles.size(); ++k) cast(k);
        std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& l, const Crossing& r) {
            return l.row < r.row || (l.row == r.row && l.depth < r.depth);
        });
    }

    RowVolume integrate() const {
        RowVolume out;
        const double area = step_[u_] * step_[v_];
        for (std::size_t k = 0; k < crossings_.size();) {
            int winding = 0, count = 0;
            const std::int32_t row = crossings_[k].row;
            for (; k < crossings_.size() && crossings_[k].row == row; ++k) {
                const Crossing& c = crossings_[k];
                const double behind = count == 0 ? 0.0 : c.depth - crossings_[k - 1].depth;
                out.by_sign += area * winding * behind;
                if (winding > 0) out.by_winding += area * behind;
                if (count % 2 == 1) out.by_parity += area * behind;
                winding += c.sign;
                ++count;
            }
            if (winding != 0) ++out.open_rows;
        }
        return out;
    }

private:
    int cell(double x, int d) const {
        return std::clamp(static_cast<int>((x - low_[d]) / step_[d]), 0, rows_ - 1);
    }

    void cast(std::size_t t) {
        const Vec3 a = mesh_.corner(t, 0), b = mesh_.corner(t, 1), c = mesh_.corner(t, 2);
        const auto range = [&](int d) {
            return std::pair(cell(std::min({a[d], b[d], c[d]}), d),
                             cell(std::max({a[d], b[d], c[d]}), d));
        };
        const auto [u0, u1] = range(u_);
        const auto [v0, v1] = range(v_);
        for (int i = u0; i <= u1; ++i)
            for (int j = v0; j <= v1; ++j) {
                const std::int32_t row = i * rows_ + j;
                const auto key = static_cast<std::uint64_t>(row) * 6u + 2u * axis_;
                const double pu = low_[u_] + (i + hashed(key)) * step_[u_];
                const double pv = low_[v_] + (j + hashed(key + 1)) * step_[v_];
                const double wa = side_of(b, c, pu, pv, u_, v_);
                const double wb = side_of(c, a, pu, pv, u_, v_);
                const double wc = side_of(a, b, pu, pv, u_, v_);
                if ((wa > 0) != (wb > 0) || (wb > 0) != (wc > 0)) continue;
                const double depth =
                    (wa * a[axis_] + wb * b[axis_] + wc * c[axis_]) / (wa + wb + wc);
                // anticlockwise across the row: the normal points along it, the row leaves
                crossings_.push_back({depth, row, wa > 0 ? -1 : 1});
            }
    }

    const TriangleMesh& mesh_;
    int axis_, u_, v_, rows_;
    Vec3 low_, step_;
    std::vector<Crossing> crossings_;
};

}  // namespace

std::array<RowVolume, 3> measure_rows(const TriangleMesh& mesh, int rows) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    std::array<RowVolume, 3> out;
    if (mesh.triangles.empty() || box.sizes().minCoeff() <= 0.0) return out;
    for (std::size_t axis = 0; axis < 3; ++axis)
        out[axis] = Rows(mesh, box, static_cast<int>(axis), rows).integrate();
    return out;
}

}  // namespace ice
