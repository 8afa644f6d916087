// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/read_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/import_scene.hpp"
#include "preprocess/load/symmetry.hpp"

namespace ice {

namespace {

void check_finite(const TriangleMesh& mesh, const std::filesystem::path& file) {
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
        if (!mesh.vertices[k].allFinite())
            throw bad_input(file.string(), fmt::format("vertex {} is not a finite number", k + 1),
                            "repair or export the mesh again");
}

void check_area(const TriangleMesh& mesh, const std::filesystem::path& file) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
    if (area == 0.0)
        throw bad_input(
            file.string(),
            fmt::format("has no area: its {} triangles are points or lines", mesh.triangles.size()),
            "export the surface of a body as a mesh");
}

// Share of the breadth beyond the centre plane [-] from which a hull lies on both sides of it. A
// larger value takes hulls beside the plane for halves, a smaller one halves with a rudder for
// whole hulls.
constexpr double kBothSides = 0.1;

// Half a hull may reach a little beyond its centre plane (a shaft, a rudder), a whole one does so
// by half its breadth.
bool lies_on_both_sides(const TriangleMesh& mesh) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    return std::min(-box.min().y(), box.max().y()) > kBothSides * box.sizes().y();
}

// assimp keeps coordinates as floats: far from the origin, in map coordinates say, they are too
// coarse for the shape.
void check_distance(const TriangleMesh& mesh, const std::filesystem::path& file, ReadNotes& notes) {
    // Shares [-]: the rounding of a float; the rounding over the mesh's size from which on it is
    // told (weld() merges vertices within as much), and from which on the mesh is refused (a step
    // of 1 cm on a ship of 100 m). Larger bounds accept meshes with steps in their surface.
    constexpr double kFloat = 6e-8, kWorthSaying = 1e-6, kTooCoarse = 1e-4;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const double size = box.diagonal().norm();
    const double far = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const double rounding = kFloat * far;
    const std::string what = fmt::format(
        "the mesh lies {:.3g} m from its origin, where coordinates are read to {:.2g} m only", far,
        rounding);
    const char* const remedy = "move it to the origin before exporting it";
    if (rounding > kTooCoarse * size) throw bad_input(file.string(), what, remedy);
    if (rounding > kWorthSaying * size) notes.warnings.push_back(what + ": " + remedy);
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
                       ReadNotes* notes) {
    // In the order of certainty: the file, its numbers, its area, then the guesses, which need all
    // three.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw bad_input(file.string(), "mesh file not found", "check the path");

    auto [mesh, said] = import_scene(file);
    check_finite(mesh, file);
    if (mesh.triangles.empty())
        throw bad_input(file.string(), "holds no triangles", "export the hull's surface as a mesh");
    check_area(mesh, file);
    ReadNotes unread;
    ReadNotes& noted = notes != nullptr ? *notes : unread;
    // from here on x forward, z up, metres
    const Mat3 turn = choose_frame(mesh, said, options, noted).matrix();
    for (Vec3& v : mesh.vertices) v = turn * v;
    check_distance(mesh, file, noted);
    if (options.mirror_y) {
        if (lies_on_both_sides(mesh))
            noted.warnings.emplace_back(
                "the mesh lies on both sides of y = 0 already: leave out --mirror y if it holds "
                "the whole hull");
        // walls in the centre plane would lie inside the whole hull
        noted.centre_plane_dropped = drop_centre_plane(mesh);
        add_mirror_image(mesh);
    }
    return std::move(mesh);
}

}  // namespace ice
