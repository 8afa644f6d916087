// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/lattice_frame.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Share of the pitch [-] by which an extent may miss a multiple of it: rounding of decimal sizes. A
// larger value adds rows that do not fit, a smaller one loses the last row to rounding.
constexpr double kMultiple = 1e-9;
// Rest over the pitch [-] up to which both ends count as tangent. With a larger value spheres stay
// away from a flat face by half of the rest, with a smaller one rounding decides which end they
// touch.
constexpr double kNoRest = 1e-6;
// Sine of the tilt [-] below which a face is square to an axis: single-precision files have 1e-7. A
// larger value lets rows begin at faces that are tilted, a smaller one misses faces in such files.
constexpr double kSquare = 1e-6;
// Lattice points of the box at most [-]: one bit each, 125 MB. A larger value takes more memory and
// time, a smaller one refuses fine lattices that have room.
constexpr double kMostPoints = 1e9;

// The flat faces square to an axis that lie at one height of it, together.
struct FlatFace {
    double at = 0.0;    // [m]
    double area = 0.0;  // [m2]
    double up = 0.0;    // of it the part along the axis less the part against it [m2]
};
using FlatFaces = std::map<std::int64_t, FlatFace>;  // by height, in grains above the box's low end

// Adds the faces of triangles [from, to) that are square to x, y or z.
void add_flat_faces(const TriangleMesh& mesh, std::size_t from, std::size_t to, const Vec3& low,
                    double grain, std::array<FlatFaces, 3>& out) {
    for (std::size_t t = from; t < to; ++t) {
        const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
        const Vec3 spread = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
        // most triangles end here; a square face cannot be higher than its tilt allows
        if (spread.minCoeff() > kSquare * spread.sum()) continue;
        const Vec3 n = mesh.area_vector(t);
        int axis = 0;
        n.cwiseAbs().maxCoeff(&axis);
        const double across = n.squaredNorm() - n[axis] * n[axis];
        if (!(across <= kSquare * kSquare * n.squaredNorm()) || n[axis] == 0.0) continue;
        FlatFace& face =
            out[static_cast<std::size_t>(axis)][std::llround((a[axis] - low[axis]) / grain)];
        face.at = a[axis];
        face.area += n.norm();
        face.up += n[axis];
    }
}

// Faces square to x, y, z, heights nearer than the grain taken for one.
std::array<FlatFaces, 3> flat_faces(const TriangleMesh& mesh, const Vec3& low, double grain) {
    // triangles summed together [-], in a fixed order: another size changes the last digits of the
    // areas
    constexpr std::size_t kChunk = 1024;
    std::vector<std::array<FlatFaces, 3>> chunks((mesh.triangles.size() + kChunk - 1) / kChunk);
    parallel_for(chunks.size(), 16, [&](std::size_t k) {
        add_flat_faces(mesh, k * kChunk, std::min((k + 1) * kChunk, mesh.triangles.size()), low,
                       grain, chunks[k]);
    });
    // in order, so that the sums do not depend on the threads
    std::array<FlatFaces, 3> out;
    for (const auto& chunk : chunks)
        for (std::size_t d = 0; d < 3; ++d)
            for (const auto& [height, part] : chunk[d]) {
                FlatFace& face = out[d][height];
                face.at = part.at;
                face.area += part.area;
                face.up += part.up;
            }
    return out;
}

// Lattice points along one axis: first, first + pitch, ...
struct Row {
    double first = 0.0;
    double count = 1.0;
};

Row row_along(const FlatFaces& faces, double low, double extent, double radius, double pitch,
              bool centred) {
    const auto fitting = [&](double length) {
        return std::floor((length - 2.0 * radius) / pitch + kMultiple) + 1.0;
    };
    Row row;
    // If the extent is no multiple of the pitch, a rest remains at one end: the one without the
    // largest flat face, which gets tangent spheres.
    row.count = std::max(1.0, fitting(extent));
    // spheres from end to end, or the same remainder at both ends
    row.first = low + 0.5 * (extent - pitch * (row.count - 1.0));
    if (centred || faces.empty()) return row;
    const double rest = extent - 2.0 * radius - pitch * (row.count - 1.0);
    if (rest <= kNoRest * pitch) return row;

    const auto largest = std::max_element(
        faces.begin(), faces.end(),
        [](const auto& l, const auto& r) { return l.second.area < r.second.area; });
    const double least = largest->second.area * (1.0 - 1e-9);
    if (std::count_if(faces.begin(), faces.end(),
                      [&](const auto& face) { return face.second.area >= least; }) > 1)
        return row;
    // tangent to that face from within the solid
    const double tangent = largest->second.at + (largest->second.up > 0.0 ? -radius : radius);
    const double below = std::floor((tangent - radius - low) / pitch + kMultiple);
    row.first = tangent - below * pitch;
    row.count = fitting(low + extent - row.first + radius);
    return row;
}

// Rows that reach past both ends of the box: shifted rows may begin lower than the placed one.
Row cover(const Row& row, double low, double extent, double pitch) {
    const double below = std::ceil((row.first - low) / pitch);
    return {row.first - below * pitch,
            below + std::max(0.0, std::ceil((low + extent - row.first) / pitch)) + 1.0};
}

}  // namespace

LatticeFrame place_lattice(const TriangleMesh& mesh, LatticeKind kind, double radius, int dimension,
                           bool mirror) {
    LatticeFrame frame;
    frame.kind = kind;
    const bool hexagonal = kind == LatticeKind::hexagonal;
    const double pitch = 2.0 * radius;
    frame.step = hexagonal ? Vec3(pitch, pitch * std::sqrt(2.0 / 3.0), radius * std::numbers::sqrt3)
                           : Vec3::Constant(pitch);
    if (mesh.triangles.empty()) return frame;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const auto faces = flat_faces(mesh, box.min(), 1e-9 * box.diagonal().norm());

    std::array<Row, 3> rows;
    for (int d = 0; d < 3; ++d) {
        if (dimension == 2 && d == 1) continue;
        const auto dd = static_cast<std::size_t>(d);
        const double low = box.min()[d], extent = box.sizes()[d];
        const bool symmetric = mirror && d == 1;
        rows[dd] = row_along(faces[dd], low, extent, radius, frame.step[d], symmetric);
        if (hexagonal && symmetric) rows[dd].first = 0.0;
        if (hexagonal) rows[dd] = cover(rows[dd], low, extent, frame.step[d]);
        if (hexagonal && symmetric)  // as many layers on either side of y = 0
            rows[dd].count = 2.0 * std::floor(box.max()[d] / frame.step[d] + 1.0) + 1.0;
    }
    const double total = rows[0].count * rows[1].count * rows[2].count;
    if (!(total <= kMostPoints))
        throw bad_input("--radius",
                        fmt::format("the solid's box holds {:.2g} lattice points", total),
                        "use a larger radius, or --mode surface; are the mesh's --units right?");
    for (std::size_t d = 0; d < 3; ++d) {
        frame.first[static_cast<Eigen::Index>(d)] = rows[d].first;
        frame.count[d] = static_cast<std::int64_t>(rows[d].count);
    }
    if (mirror) {
        // measured from the middle, so that images differ in the sign alone
        frame.first.y() = 0.0;
        frame.middle = 0.5 * static_cast<double>(frame.count[1] - 1);
    }
    return frame;
}

}  // namespace ice
