// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/lattice.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"

namespace ice {

namespace {

constexpr double kRounding = 1e-9;   // of the clearance
constexpr double kMultiple = 1e-9;   // of the pitch: by how much an extent may miss a multiple
constexpr double kNoRest = 1e-6;     // of the pitch: a rest this small leaves both ends tangent
constexpr std::int64_t kBlock = 32;  // lattice points along a block's edge
constexpr double kSquare = 1e-6;     // sine of the tilt below which a face is square to an axis
constexpr double kMostPoints = 1e9;  // lattice points of the box: memory for one byte each

// Lattice points along one axis: first, first + pitch, ...
struct Row {
    double first = 0.0;
    std::int64_t count = 1;
};

// The flat faces square to an axis that lie at one height of it, together.
struct FlatFace {
    double at = 0.0;    // [m]
    double area = 0.0;  // [m2]
};

// Flat faces by their height, heights nearer than the grain taken for one.
std::vector<FlatFace> flat_faces(const SurfaceTree& tree, int axis, double low, double grain) {
    std::map<std::int64_t, FlatFace> faces;
    const TriangleMesh& mesh = tree.mesh();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3& n = tree.normal(static_cast<std::int32_t>(t));
        if (std::abs(n[axis]) < 1.0 - 0.5 * kSquare * kSquare) continue;
        const double at = mesh.corner(t, 0)[axis];
        FlatFace& face = faces[std::llround((at - low) / grain)];
        face.at = at;
        face.area += mesh.area_vector(t).norm();
    }
    std::vector<FlatFace> out;
    for (const auto& [height, face] : faces) out.push_back(face);
    return out;
}

Row row_along(const SurfaceTree& tree, const Eigen::AlignedBox3d& box, int axis, double radius,
              bool centred) {
    const double pitch = 2.0 * radius, grain = 1e-9 * box.diagonal().norm();
    const double low = box.min()[axis], extent = box.sizes()[axis];
    Row row;
    row.count = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::floor(extent / pitch + kMultiple)));
    // spheres from end to end, or the same remainder at both ends
    row.first = low + 0.5 * (extent - pitch * static_cast<double>(row.count - 1));
    const auto faces = flat_faces(tree, axis, low, grain);
    if (centred || faces.empty()) return row;
    const double rest = extent - pitch * static_cast<double>(row.count);
    if (rest <= kNoRest * pitch) return row;

    const auto largest =
        std::max_element(faces.begin(), faces.end(),
                         [](const FlatFace& l, const FlatFace& r) { return l.area < r.area; });
    const auto equal = std::count_if(faces.begin(), faces.end(), [&](const FlatFace& face) {
        return face.area >= largest->area * (1.0 - 1e-9);
    });
    if (equal > 1) return row;
    const double at = largest->at;
    // tangent to that face on either side of it: a multiple of the pitch from face + R
    const double below = std::floor((at - low) / pitch + kMultiple);
    row.first = at + radius - below * pitch;
    row.count = static_cast<std::int64_t>(
                    std::floor((low + extent - row.first - radius) / pitch + kMultiple)) +
                1;
    return row;
}

// Decides blocks of lattice points by one distance where that is enough.
class Decider {
public:
    Decider(const SurfaceTree& tree, double clearance, const std::array<Row, 3>& rows, double pitch)
        : tree_(tree),
          clearance_(clearance * (1.0 - kRounding)),
          rows_(rows),
          pitch_(pitch),
          full_(static_cast<std::size_t>(rows[0].count * rows[1].count * rows[2].count)) {}

    std::vector<std::uint8_t> decide() {
        std::array<std::int64_t, 3> blocks;
        for (std::size_t d = 0; d < 3; ++d) blocks[d] = (rows_[d].count + kBlock - 1) / kBlock;
        const auto count = static_cast<std::size_t>(blocks[0] * blocks[1] * blocks[2]);
        parallel_for(count, 8, [&](std::size_t k) {
            const auto i = static_cast<std::int64_t>(k);
            std::array<std::int64_t, 3> from{i % blocks[0], i / blocks[0] % blocks[1],
                                             i / (blocks[0] * blocks[1])};
            std::array<std::int64_t, 3> size;
            for (std::size_t d = 0; d < 3; ++d) {
                from[d] *= kBlock;
                size[d] = std::min(kBlock, rows_[d].count - from[d]);
            }
            decide_block(from, size);
        });
        return std::move(full_);
    }

    Vec3 point(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {rows_[0].first + pitch_ * static_cast<double>(i),
                rows_[1].first + pitch_ * static_cast<double>(j),
                rows_[2].first + pitch_ * static_cast<double>(k)};
    }

private:
    void decide_block(const std::array<std::int64_t, 3>& from,
                      const std::array<std::int64_t, 3>& size) {
        const Vec3 low = point(from[0], from[1], from[2]);
        const Vec3 high =
            point(from[0] + size[0] - 1, from[1] + size[1] - 1, from[2] + size[2] - 1);
        const double reach = 0.5 * (high - low).norm();
        const Foot foot = tree_.closest(0.5 * (low + high));
        const double depth = foot.inside ? foot.distance : -foot.distance;
        if (depth + reach < clearance_) return;
        if (depth - reach >= clearance_) {
            fill(from, size);
            return;
        }
        const auto longest =
            static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
        if (size[longest] == 1) return;  // reach is zero: one of the two held
        auto half = size, rest = size, middle = from;
        half[longest] = size[longest] / 2;
        rest[longest] = size[longest] - half[longest];
        middle[longest] += half[longest];
        decide_block(from, half);
        decide_block(middle, rest);
    }

    void fill(const std::array<std::int64_t, 3>& from, const std::array<std::int64_t, 3>& size) {
        for (std::int64_t k = from[2]; k < from[2] + size[2]; ++k)
            for (std::int64_t j = from[1]; j < from[1] + size[1]; ++j) {
                const std::int64_t start = (k * rows_[1].count + j) * rows_[0].count + from[0];
                std::fill_n(full_.begin() + start, size[0], std::uint8_t{1});
            }
    }

    const SurfaceTree& tree_;
    double clearance_;
    std::array<Row, 3> rows_;
    double pitch_;
    std::vector<std::uint8_t> full_;
};

// A point stays only with its mirror image: rounding could let one of the two in.
void keep_pairs(std::vector<std::uint8_t>& full, std::size_t nx, std::size_t ny) {
    for (std::size_t k = 0; k < full.size(); ++k) {
        const std::size_t j = k / nx % ny;
        const std::size_t image = k + (ny - 1 - j) * nx - j * nx;
        if (!full[image]) full[k] = 0;
    }
}

}  // namespace

Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension,
                     bool mirror) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : tree.mesh().vertices) box.extend(v);
    std::array<Row, 3> rows;
    for (int d = 0; d < 3; ++d)
        if (dimension == 3 || d != 1)
            rows[static_cast<std::size_t>(d)] = row_along(tree, box, d, radius, mirror && d == 1);
    const double total = static_cast<double>(rows[0].count) * static_cast<double>(rows[1].count) *
                         static_cast<double>(rows[2].count);
    if (total > kMostPoints)
        throw bad_input("--radius",
                        fmt::format("the solid's box holds {:.2g} lattice points", total),
                        "use a larger radius, or --mode surface; are the mesh's --units right?");
    // y = -y of the image, exactly
    if (mirror) rows[1].first = -radius * static_cast<double>(rows[1].count - 1);

    Decider decider(tree, clearance, rows, 2.0 * radius);
    std::vector<std::uint8_t> full = decider.decide();
    const auto nx = static_cast<std::size_t>(rows[0].count);
    const auto ny = static_cast<std::size_t>(rows[1].count);
    if (mirror) keep_pairs(full, nx, ny);

    Lattice out;
    const std::size_t stride[3] = {1, nx, nx * ny};
    for (std::size_t k = 0; k < full.size(); ++k) {
        if (!full[k]) continue;
        bool outer = false;
        for (std::size_t d = 0; d < 3; ++d) {
            if (dimension == 2 && d == 1) continue;
            const auto count = static_cast<std::size_t>(rows[d].count);
            const std::size_t at = k / stride[d] % count;
            outer =
                outer || at == 0 || at + 1 == count || !full[k - stride[d]] || !full[k + stride[d]];
        }
        Vec3 center =
            decider.point(static_cast<std::int64_t>(k % nx), static_cast<std::int64_t>(k / nx % ny),
                          static_cast<std::int64_t>(k / (nx * ny)));
        // measured from the middle, so that images differ in the sign alone
        if (mirror)
            center.y() =
                radius * (2.0 * static_cast<double>(k / nx % ny) - static_cast<double>(ny - 1));
        out.centers.push_back(center);
        out.outer.push_back(outer ? 1 : 0);
    }
    return out;
}

}  // namespace ice
