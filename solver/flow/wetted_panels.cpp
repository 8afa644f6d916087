// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/wetted_panels.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"

namespace ice {

namespace {

using Triangle = std::array<Vec3, 3>;

// Share of the hull's length [-]: vertices so near to a cutting plane lie in it, and mirrored
// vertices so near to each other are one. Larger moves corners, smaller sees slivers at the water.
constexpr double kSame = 1e-6;

// A hull of this many panels along its length [-] has its flow to 1 % of the speed. Twice as many
// make four times the panels and sixteen times the matrix.
constexpr double kPanelsAlong = 15.0;

// Triangles smaller than this share [-] of the largest panels allowed add nothing to the flow, but
// their normals are rounding. Larger would leave openings.
constexpr double kSliver = 1e-9;

// How far the surface of a fine mesh may shift where it is simplified, over its extent [-]: 1 m on
// a ship of 100 m, less than a panel. Larger bends the hull's form; with less a fine mesh keeps too
// many triangles for the bound on panels.
constexpr float kSimplified = 0.01f;

// Step by which the panels' size grows until their number is within the bound [-]. A larger one
// leaves more of the bound unused, a smaller one tries more sizes.
constexpr double kCoarser = 1.2;

// Part of the triangles where sign * p[axis] <= 0.
std::vector<Triangle> cut(const std::vector<Triangle>& from, int axis, double sign, double same) {
    std::vector<Triangle> out;
    for (Triangle t : from) {
        std::array<double, 3> d;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(t[k][axis]) < same) t[k][axis] = 0.0;
            d[k] = sign * t[k][axis];
        }
        if (d[0] >= 0.0 && d[1] >= 0.0 && d[2] >= 0.0) continue;  // beyond, or in the plane
        std::vector<Vec3> kept;
        // Sutherland and Hodgman: corners inside stay, crossing edges give a new corner in the
        // plane.
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t n = (k + 1) % 3;
            if (d[k] <= 0.0) kept.push_back(t[k]);
            if ((d[k] < 0.0 && d[n] > 0.0) || (d[k] > 0.0 && d[n] < 0.0)) {
                Vec3 p = t[k] + d[k] / (d[k] - d[n]) * (t[n] - t[k]);
                p[axis] = 0.0;
                kept.push_back(p);
            }
        }
        // a fan: the part of a triangle on one side of a plane is convex, with four corners at most
        for (std::size_t k = 2; k < kept.size(); ++k)
            out.push_back({kept[0], kept[k - 1], kept[k]});
    }
    return out;
}

// Has each vertex a mirror image?
bool is_symmetric(const TriangleMesh& mesh, double same) {
    // sorted by x, so that only vertices of nearly the same x are compared
    std::vector<Vec3> sorted = mesh.vertices;
    std::sort(sorted.begin(), sorted.end(),
              [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    return std::all_of(sorted.begin(), sorted.end(), [&](const Vec3& v) {
        const Vec3 image(v.x(), -v.y(), v.z());
        auto near = std::lower_bound(sorted.begin(), sorted.end(), v.x() - same,
                                     [](const Vec3& a, double x) { return a.x() < x; });
        for (; near != sorted.end() && near->x() <= v.x() + same; ++near)
            if ((*near - image).norm() < same) return true;
        return false;
    });
}

// At most `most` triangles; open edges keep their places.
std::vector<Triangle> simplified(const std::vector<Triangle>& from, std::size_t most) {
    // meshopt works on floats and indices; corners of the result are the doubles they came from
    std::vector<float> soup;
    for (const Triangle& t : from)
        for (const Vec3& p : t)
            for (int axis = 0; axis < 3; ++axis) soup.push_back(static_cast<float>(p[axis]));
    const std::size_t corners = soup.size() / 3, stride = 3 * sizeof(float);
    std::vector<unsigned> index(corners), kept(corners);
    // corners in one place become one vertex, or the mesh would fall apart into triangles
    const std::size_t count =
        meshopt_generateVertexRemap(index.data(), nullptr, corners, soup.data(), corners, stride);
    std::vector<float> points(3 * count);
    std::vector<Vec3> vertex(count);
    for (std::size_t k = 0; k < corners; ++k) {
        vertex[index[k]] = from[k / 3][k % 3];
        std::copy_n(soup.data() + 3 * k, 3, points.data() + std::size_t{3} * index[k]);
    }
    const std::size_t size =
        meshopt_simplify(kept.data(), index.data(), corners, points.data(), count, stride, 3 * most,
                         kSimplified, meshopt_SimplifyLockBorder);
    std::vector<Triangle> out;
    for (std::size_t k = 0; k + 2 < size; k += 3)
        out.push_back({vertex[kept[k]], vertex[kept[k + 1]], vertex[kept[k + 2]]});
    return out;
}

// Splits longest edges; empty where more than `most` triangles would come of it.
std::vector<Triangle> split(std::vector<Triangle> open, double longest, std::size_t most) {
    std::vector<Triangle> done;
    while (!open.empty()) {
        // the number of those open only grows: no need to go on to the end
        if (open.size() + done.size() > most) return {};
        const Triangle t = open.back();
        open.pop_back();
        std::size_t edge = 0;
        double length = 0.0;
        // halving the longest edge keeps triangles from becoming needles
        for (std::size_t k = 0; k < 3; ++k)
            if (const double l = (t[(k + 1) % 3] - t[k]).norm(); l > length) {
                length = l;
                edge = k;
            }
        if (length <= longest) {
            done.push_back(t);
            continue;
        }
        const Vec3 &a = t[edge], &b = t[(edge + 1) % 3], &c = t[(edge + 2) % 3];
        const Vec3 middle = 0.5 * (a + b);
        open.push_back({a, middle, c});
        open.push_back({middle, b, c});
    }
    return done;
}

double area_of(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

std::vector<SourcePanel> panels_of(const std::vector<Triangle>& triangles, double longest_edge) {
    const double least = kSliver * longest_edge * longest_edge;
    std::vector<SourcePanel> out;
    for (const Triangle& t : triangles)
        if (area_of(t) > least) out.push_back(make_panel(t[0], t[1], t[2]));
    return out;
}

void measure(const std::vector<Triangle>& triangles, bool symmetric, WettedHull& out) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : triangles) {
        for (const Vec3& p : t) box.extend(p);
        // int x n_x dA: the planes that cut the body have n_x = 0
        const double nx = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).x();
        out.volume += nx * (t[0].x() + t[1].x() + t[2].x()) / 3.0;
    }
    if (symmetric) {
        // the half that was measured represents both
        out.volume *= 2.0;
        const double breadth = box.max().y();
        box.extend(Vec3(box.max().x(), -breadth, box.min().z()));
    }
    out.low = box.min();
    out.high = box.max();
}

}  // namespace

WettedHull make_wetted_hull(const TriangleMesh& mesh, double water, const PanelSize& size) {
    WettedHull out;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : mesh.vertices) {
        low = std::min(low, v.x());
        high = std::max(high, v.x());
    }
    const double same = kSame * (high - low);
    // A symmetric hull needs panels on one side only: an image in y = 0 takes the place of the
    // other.
    out.body.symmetric = is_symmetric(mesh, same);
    std::vector<Triangle> wet;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle corners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
        for (Vec3& p : corners) p.z() -= water;
        wet.push_back(corners);
    }
    // The waterline is cut exactly: panels that reach above it would let water through the surface.
    wet = cut(wet, 2, 1.0, same);
    if (out.body.symmetric) wet = cut(wet, 1, -1.0, same);
    if (wet.empty())
        throw bad_input("the hull", "has nothing under water",
                        "give a draught above 0, or a mesh that reaches below z = 0");
    measure(wet, out.body.symmetric, out);
    // The matrix is dense, its cost the square of the panels: a fine mesh is simplified first, with
    // room left for the split below.
    if (wet.size() > size.most) wet = simplified(wet, size.most * 3 / 4);

    out.longest_edge = size.longest_edge;
    std::vector<Triangle> panels;
    if (size.longest_edge > 0.0) {
        panels = split(wet, size.longest_edge, size.most);
        if (panels.empty())
            throw bad_input("panel size",
                            fmt::format("edges of {:g} m give more than {} panels",
                                        size.longest_edge, size.most),
                            "allow longer edges");
    } else {
        out.longest_edge = (out.high.x() - out.low.x()) / kPanelsAlong;
        // The finest panels that the bound on their number allows.
        while ((panels = split(wet, out.longest_edge, size.most)).empty())
            out.longest_edge *= kCoarser;
    }
    out.body.panels = panels_of(panels, out.longest_edge);
    return out;
}

TriangleMesh without_regions(const TriangleMesh& mesh, std::span<const std::string> names) {
    const auto& known = mesh.region_names;
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw bad_input(fmt::format("region \"{}\"", name), "the hull has none of that name",
                            fmt::format("its regions are {}", fmt::join(known, ", ")));
    // the opening that is left has no panels: water passes through the plate's place
    TriangleMesh out = mesh;
    out.triangles.clear();
    out.region.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::string& name = known[static_cast<std::size_t>(mesh.region[t])];
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        out.triangles.push_back(mesh.triangles[t]);
        out.region.push_back(mesh.region[t]);
    }
    if (out.triangles.empty())
        throw bad_input("the hull", "has nothing left without these regions", "leave out fewer");
    return out;
}

std::vector<SourcePanel> split_triangles(const TriangleMesh& mesh, double longest_edge,
                                         std::size_t most) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        triangles.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    return panels_of(split(triangles, longest_edge, most), longest_edge);
}

}  // namespace ice
