// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/contour_grid.hpp"

#include <algorithm>
#include <unordered_map>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Corners of a cube as bits x, y, z; each tetrahedron climbs from 000 to 111 one bit at a time.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                   {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

std::size_t offset_of(const Grid& grid, int corner) {
    const auto nx = static_cast<std::size_t>(grid.nodes[0]);
    const auto ny = static_cast<std::size_t>(grid.nodes[1]);
    return static_cast<std::size_t>(corner & 1) + static_cast<std::size_t>(corner >> 1 & 1) * nx +
           static_cast<std::size_t>(corner >> 2 & 1) * nx * ny;
}

// Marching tetrahedra, not cubes: a cube has ambiguous cases that can leave openings or edges of
// four triangles, a tetrahedron has none, at the price of more triangles.
class Contour {
public:
    Contour(const Grid& grid, const std::vector<std::uint8_t>& inside)
        : grid_(grid), inside_(inside) {
        for (int c = 0; c < 8; ++c) offset_[c] = offset_of(grid, c);
        for (std::int32_t z = 0; z + 1 < grid.nodes[2]; ++z)
            for (std::int32_t y = 0; y + 1 < grid.nodes[1]; ++y)
                for (std::int32_t x = 0; x + 1 < grid.nodes[0]; ++x) cut_cube(x, y, z);
    }

    TriangleMesh place(const std::function<double(const Vec3&, const Vec3&)>& cut) {
        mesh_.vertices.resize(edges_.size());
        parallel_for(edges_.size(), 100, [&](std::size_t k) {
            const Vec3 in = grid_.at(edges_[k].first), out = grid_.at(edges_[k].second);
            // vertices keep off the grid's nodes: cuts that meet in a node would make triangles
            // without area
            mesh_.vertices[k] = in + std::clamp(cut(in, out), 0.02, 0.98) * (out - in);
        });
        mesh_.region.assign(mesh_.triangles.size(), 0);
        return std::move(mesh_);
    }

private:
    void cut_cube(std::int32_t x, std::int32_t y, std::int32_t z) {
        const std::size_t base =
            static_cast<std::size_t>(x) +
            static_cast<std::size_t>(grid_.nodes[0]) *
                (static_cast<std::size_t>(y) +
                 static_cast<std::size_t>(grid_.nodes[1]) * static_cast<std::size_t>(z));
        int count = 0;
        for (const std::size_t o : offset_) count += inside_[base + o];
        if (count == 0 || count == 8) return;
        for (const auto& tetrahedron : kTetrahedra) cut_tetrahedron(base, tetrahedron);
    }

    void cut_tetrahedron(std::size_t base, const int (&corner)[4]) {
        // One corner alone is cut off by a triangle; two and two are separated by a quadrilateral.
        int in[4], out[4], in_count = 0, out_count = 0;
        for (const int c : corner)
            inside_[base + offset_[c]] ? in[in_count++] = c : out[out_count++] = c;
        if (in_count == 1)
            add(base, {in[0], out[0]}, {in[0], out[1]}, {in[0], out[2]}, in[0], out[0]);
        if (in_count == 3)
            add(base, {in[0], out[0]}, {in[1], out[0]}, {in[2], out[0]}, in[0], out[0]);
        if (in_count == 2) {
            add(base, {in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}, in[0], out[0]);
            add(base, {in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}, in[0], out[0]);
        }
    }

    using Cut = std::pair<int, int>;  // inner and outer corner

    // Orientation from the middles of the edges in units of the grid: exact.
    void add(std::size_t base, Cut a, Cut b, Cut c, int inner, int outer) {
        const auto corner = [](int k) { return Vec3(k & 1, k >> 1 & 1, k >> 2 & 1); };
        const auto middle = [&](Cut e) { return Vec3(corner(e.first) + corner(e.second)); };
        const Vec3 normal = (middle(b) - middle(a)).cross(middle(c) - middle(a));
        std::array<std::int32_t, 3> t{vertex(base, a), vertex(base, b), vertex(base, c)};
        // the plane of the middles separates the inner from the outer corners
        if (normal.dot(corner(outer) - corner(inner)) < 0.0) std::swap(t[1], t[2]);
        mesh_.triangles.push_back(t);
    }

    std::int32_t vertex(std::size_t base, Cut e) {
        const std::size_t in = base + offset_[e.first], out = base + offset_[e.second];
        // the lower end and which of the seven directions
        // an edge of the grid has one vertex, whichever of its tetrahedra comes first
        const std::size_t key =
            std::min(in, out) * 8 + static_cast<std::size_t>(e.first ^ e.second);
        const auto [at, fresh] = known_.try_emplace(key, static_cast<std::int32_t>(edges_.size()));
        if (fresh) edges_.emplace_back(in, out);
        return at->second;
    }

    const Grid& grid_;
    const std::vector<std::uint8_t>& inside_;
    std::size_t offset_[8];
    std::unordered_map<std::size_t, std::int32_t> known_;
    std::vector<std::pair<std::size_t, std::size_t>> edges_;
    TriangleMesh mesh_;
};

}  // namespace

void fill_voids(const Grid& grid, std::vector<std::uint8_t>& inside) {
    // Flood from the border through all nodes outside: a void is a node that is outside and not
    // reached.
    std::vector<std::uint8_t> reached(inside.size(), 0);
    std::vector<std::size_t> open;
    const auto reach = [&](std::size_t k) {
        if (inside[k] || reached[k]) return;
        reached[k] = 1;
        open.push_back(k);
    };
    const auto place = [&](std::size_t k) {
        const auto nx = static_cast<std::size_t>(grid.nodes[0]);
        const auto ny = static_cast<std::size_t>(grid.nodes[1]);
        return std::array{static_cast<std::int32_t>(k % nx), static_cast<std::int32_t>(k / nx % ny),
                          static_cast<std::int32_t>(k / (nx * ny))};
    };
    const auto on_border = [&](const std::array<std::int32_t, 3>& at) {
        for (std::size_t d = 0; d < 3; ++d)
            if (at[d] == 0 || at[d] == grid.nodes[d] - 1) return true;
        return false;
    };
    for (std::size_t k = 0; k < inside.size(); ++k)
        if (on_border(place(k))) reach(k);
    while (!open.empty()) {
        const std::size_t k = open.back();
        open.pop_back();
        const auto at = place(k);
        // The 14 neighbours along the edges and diagonals that the contour's tetrahedra use, so
        // that flood and contour agree on the cells that are connected.
        for (int direction = 1; direction < 8; ++direction)
            for (const std::int32_t sign : {-1, 1}) {
                bool within = true;
                for (std::size_t d = 0; d < 3; ++d) {
                    const std::int32_t next = at[d] + sign * (direction >> d & 1);
                    within = within && next >= 0 && next < grid.nodes[d];
                }
                const std::size_t offset = offset_of(grid, direction);
                if (within) reach(sign > 0 ? k + offset : k - offset);
            }
    }
    for (std::size_t k = 0; k < inside.size(); ++k) inside[k] = !reached[k];
}

TriangleMesh contour_grid(const Grid& grid, const std::vector<std::uint8_t>& inside,
                          const std::function<double(const Vec3& in, const Vec3& out)>& cut) {
    return Contour(grid, inside).place(cut);
}

}  // namespace ice
