// SPDX-License-Identifier: GPL-3.0-or-later
/// `*.flow.h5`: the water's velocity around a moving hull (docs/contract.md, section 10).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Flow around a hull on a grid, for a speed of 1 m/s along +x, in the earth frame: 0 far away.
///
/// Axes are the hull mesh's with z = 0 in the water's surface; the topmost nodes lie there. A
/// symmetric table has y >= 0 only. A section (2D) has one row of nodes, at y = 0.
struct FlowTable {
    std::array<std::int64_t, 3> nodes{0, 0, 0};  ///< counts nx, ny, nz
    Vec3 origin = Vec3::Zero();                  ///< of the first node [m]
    double spacing = 0.0;                        ///< between nodes, along all axes [m]
    std::vector<float> velocity;                 ///< [nz,ny,nx,3], over the ship's speed [-]
    std::vector<float> potential;  ///< [nz,ny,nx], over the speed [m]; velocity is its gradient

    bool symmetric = false;        ///< in y
    double draught = 0.0;          ///< from the hull's lowest point to the water [m]
    double reference_speed = 1.0;  ///< speed for which a field from elsewhere was made [m/s]
    std::int64_t panels = 0;       ///< that it was made with; 0: from elsewhere
    double residual = 0.0;         ///< area-rms of the normal velocity left on the hull [1]
    std::string source_sha256;     ///< of the hull's mesh file
    std::string created_by, command_line;

    /// Count of nodes.
    std::size_t size() const {
        return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]) *
               static_cast<std::size_t>(nodes[2]);
    }
};

/// Datasets `/velocity` f32 [nz, ny, nx, 3] and `/potential` f32 [nz, ny, nx], the rest attributes.
/// Equal tables give equal bytes.
/// @throws Error (exit code 1) when the file cannot be written; nothing half-written stays behind
void write_flow(const std::filesystem::path& path, const FlowTable& table);

/// Reads and checks a table: format and version, sizes, finite numbers, two nodes or more along x
/// and z, topmost nodes in the water's surface, the seal (sealed_file.hpp).
/// @throws Error (exit code 2) naming the file and the dataset
FlowTable read_flow(const std::filesystem::path& path);

}  // namespace ice
