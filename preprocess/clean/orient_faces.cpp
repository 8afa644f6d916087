// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/orient_faces.hpp"

#include <algorithm>

#include "common/geometry/edge_table.hpp"

namespace ice {

namespace {

struct Neighbour {
    std::int32_t triangle = -1;
    bool opposed = false;  // the two face opposite sides
};

std::vector<std::array<Neighbour, 3>> find_neighbours(const TriangleMesh& mesh,
                                                      const std::vector<MeshEdge>& edges) {
    std::vector<std::array<Neighbour, 3>> out(mesh.triangles.size());
    // a triangle has at most three such neighbours, one per edge, so that a free place is found
    const auto attach = [&](std::int32_t t, std::int32_t other, bool opposed) {
        for (Neighbour& slot : out[static_cast<std::size_t>(t)])
            if (slot.triangle < 0) {
                slot = {other, opposed};
                return;
            }
    };
    for (const MeshEdge& edge : edges) {
        if (edge.count != 2) continue;
        attach(edge.triangles[0], edge.triangles[1], !edge.regular());
        attach(edge.triangles[1], edge.triangles[0], !edge.regular());
    }
    return out;
}

}  // namespace

void flip(TriangleMesh& mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

std::int64_t orient_faces(TriangleMesh& mesh) {
    const auto edges = edge_table(mesh);
    // nearly all files are consistent: the table of neighbours is made for the others only
    if (std::none_of(edges.begin(), edges.end(),
                     [](const MeshEdge& edge) { return edge.count == 2 && !edge.regular(); }))
        return 0;
    const auto neighbours = find_neighbours(mesh, edges);
    enum : std::uint8_t { unseen, as_is, turned };
    std::vector<std::uint8_t> side(mesh.triangles.size(), unseen);
    std::vector<std::int32_t> part;
    std::int64_t count = 0;
    for (std::size_t seed = 0; seed < side.size(); ++seed) {
        if (side[seed] != unseen) continue;
        part.assign(1, static_cast<std::int32_t>(seed));
        side[seed] = as_is;
        double balance = 0.0;  // area that stays minus area that turns
        // breadth first through the part: each neighbour turns to agree with the one that found
        // it
        for (std::size_t k = 0; k < part.size(); ++k) {
            const auto t = static_cast<std::size_t>(part[k]);
            balance += (side[t] == as_is ? 1.0 : -1.0) * mesh.area_vector(t).norm();
            for (const Neighbour& n : neighbours[t]) {
                if (n.triangle < 0 || side[static_cast<std::size_t>(n.triangle)] != unseen)
                    continue;
                side[static_cast<std::size_t>(n.triangle)] =
                    (side[t] == as_is) != n.opposed ? as_is : turned;
                part.push_back(n.triangle);
            }
        }
        // Which side is out is decided later, by the volume. Here the smaller area turns, so that a
        // few wrong triangles do not turn a whole ship.
        const std::uint8_t minority = balance >= 0.0 ? turned : as_is;
        for (const std::int32_t t : part) {
            if (side[static_cast<std::size_t>(t)] != minority) continue;
            auto& corner = mesh.triangles[static_cast<std::size_t>(t)];
            std::swap(corner[1], corner[2]);
            ++count;
        }
    }
    return count;
}

}  // namespace ice
