// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/checkpoint_file.hpp"
#include "solver/scene/crushed_solids.hpp"

namespace ice {

void CrushedSolids::carry(CheckpointFile& file) {
    // one row for each solid, plane, corner and edge, in the order of the bodies
    struct Row {
        std::int32_t body, planes, corners, edges;
    };
    std::vector<Row> rows;
    std::vector<HalfSpace> planes;
    std::vector<Vec3> corners;
    std::vector<SolidEdge> edges;
    if (file.reading()) solids_.clear();
    for (std::size_t i = 0; i < solids_.size(); ++i) {
        const ConvexPiece& solid = solids_[i];
        if (solid.empty()) continue;
        rows.push_back({static_cast<std::int32_t>(i),
                        static_cast<std::int32_t>(solid.plane_count()),
                        static_cast<std::int32_t>(solid.corners.size()),
                        static_cast<std::int32_t>(solid.edges.size())});
        for (std::size_t k = 0; k < solid.plane_count(); ++k)
            planes.push_back({solid.normals[k], solid.offsets[k]});
        for (std::size_t k = 0; k < solid.corners.size(); ++k) corners.push_back(solid.corners[k]);
        edges.insert(edges.end(), solid.edges.begin(), solid.edges.end());
    }
    file.column("crushed_solids.body", rows, &Row::body);
    file.column("crushed_solids.planes", rows, &Row::planes);
    file.column("crushed_solids.corners", rows, &Row::corners);
    file.column("crushed_solids.edges", rows, &Row::edges);
    file.column("crushed_solids.normal", planes, &HalfSpace::normal);
    file.column("crushed_solids.offset", planes, &HalfSpace::offset);
    file.carry("crushed_solids.corner", corners);
    file.column("crushed_solids.edge_begin", edges, &SolidEdge::begin);
    file.column("crushed_solids.edge_end", edges, &SolidEdge::end);
    file.column("crushed_solids.edge_left", edges, &SolidEdge::left);
    file.column("crushed_solids.edge_right", edges, &SolidEdge::right);
    if (!file.reading()) return;
    auto plane = planes.begin();
    auto corner = corners.begin();
    auto edge = edges.begin();
    for (const Row& row : rows) {
        const auto i = static_cast<std::size_t>(row.body);
        if (i >= solids_.size()) solids_.resize(i + 1);
        solids_[i] = piece_of({plane, plane + row.planes}, {corner, corner + row.corners},
                              {edge, edge + row.edges});
        plane += row.planes;
        corner += row.corners;
        edge += row.edges;
    }
}

}  // namespace ice
