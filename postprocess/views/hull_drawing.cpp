// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/hull_drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "postprocess/views/depth_map.hpp"

namespace ice::views {

namespace {

// Triangles of the hull drawn in one picture [-]: a picture of 560 px shows no more. Each is about
// 30 bytes of the page, so twice as many would take the room of a view.
constexpr std::size_t kMostTriangles = 3000;
// Up to this number of visible faces [-] their edges are drawn; of more, edges would only blacken
// the hull.
constexpr std::size_t kEdgesShown = 400;

struct Painted {
    const Face* face;
    std::string color;
    double nearness;
};

std::vector<Painted> visible_faces(const std::vector<Face>& faces, const Eigen::Vector3i& color,
                                   const Projection& projection) {
    std::vector<Painted> painted;
    for (const Face& face : faces)
        if (face.normal.dot(projection.toward) > 1e-6)
            painted.push_back({&face, shade(color, brightness(face.normal, projection)),
                               projection.apply(face.center()).z()});
    return painted;
}

std::string outline(const std::vector<Vec3>& corners, const Projection& projection,
                    const PageScale& scale) {
    std::vector<Vec2> points;
    for (const Vec3& c : corners) {
        const Vec3 p = projection.apply(c);
        points.push_back(scale.pixel(p.x(), p.y()));
    }
    return path_data(points, true);
}

// edges between a face towards the viewer and one away from it
std::vector<std::pair<Vec3, Vec3>> turning_edges(const TriangleMesh& mesh,
                                                 const Projection& projection) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;  // faces towards the viewer
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const bool facing = mesh.area_vector(t).dot(projection.toward) > 1e-9;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}] += facing ? 1 : 0;
        }
    }
    std::vector<std::pair<Vec3, Vec3>> turning;
    for (const auto& [edge, facing] : edges)
        if (facing == 1)
            turning.emplace_back(
                projection.apply(mesh.vertices[static_cast<std::size_t>(edge.first)]),
                projection.apply(mesh.vertices[static_cast<std::size_t>(edge.second)]));
    return turning;
}

// The outline on the page. An edge inside it, where small facets turn to and fro, is no outline, so
// each piece of an edge counts only where the hull is on one of its sides.
std::string silhouette(const TriangleMesh& mesh, const Projection& projection,
                       const PageScale& scale) {
    // Length of the pieces of an edge that are tested, and distance of the test points from the
    // edge [px]. Longer pieces cut corners of the outline; points nearer than a cell of the depth
    // map would find the hull itself on both sides.
    constexpr double kPiece = 4.0, kBeside = 2.5;
    // 600 cells along the hull: about one per pixel of the picture
    const DepthMap seen(mesh, projection, 600);
    std::string data;
    for (const auto& [a, b] : turning_edges(mesh, projection)) {
        const Vec2 from = a.head<2>(), along = b.head<2>() - from;
        // each edge in pieces of some pixels; a piece is outline where one of its sides shows
        // no hull
        const double length = along.norm();
        const int pieces = std::max(1, static_cast<int>(length * scale.per_metre / kPiece));
        const Vec2 beside =
            Vec2(-along.y(), along.x()) / std::max(length, 1e-12) * kBeside / scale.per_metre;
        const auto bare = [&](const Vec2& p) {
            return !std::isfinite(seen.nearness(p.x(), p.y()));
        };
        // pieces in a row are one line
        for (int k = 0, end = 0; k < pieces; k = end) {
            const auto outside = [&](int piece) {
                const Vec2 middle = from + along * (piece + 0.5) / pieces;
                return bare(middle + beside) || bare(middle - beside);
            };
            for (end = k; end < pieces && outside(end);) ++end;
            const Vec2 p = from + along * k / pieces, q = from + along * end / pieces;
            if (end > k)
                data += path_data({scale.pixel(p.x(), p.y()), scale.pixel(q.x(), q.y())}, false);
            else
                end = k + 1;
        }
    }
    return data;
}

}  // namespace

double brightness(const Vec3& normal, const Projection& projection) {
    // Light from the viewer's side, a little from the left and from above. Rounded to 40 shades:
    // faces of equal shade share an SVG element.
    const Vec3 light =
        (projection.toward - 0.45 * projection.right + 0.5 * projection.up).normalized();
    const double value = 0.68 + 0.38 * std::max(0.0, normal.dot(light));
    return std::round(value * 40.0) / 40.0;
}

std::string draw_hull(const TriangleMesh& mesh, const Projection& projection,
                      const PageScale& scale, double waterline, const HullColours& colours) {
    return draw_hull_faces(mesh, projection, scale, waterline, colours) +
           draw_hull_lines(mesh, projection, scale, waterline);
}

std::string draw_hull_faces(const TriangleMesh& mesh, const Projection& projection,
                            const PageScale& scale, double waterline, const HullColours& colours) {
    const TriangleMesh simple = simplify_mesh(mesh, kMostTriangles);
    const CutMesh cut = cut_mesh(simple, waterline);
    const auto below = make_faces(cut.below), above = make_faces(cut.above);
    auto painted = visible_faces(below, colours.wet, projection);
    const auto dry = visible_faces(above, colours.dry, projection);
    painted.insert(painted.end(), dry.begin(), dry.end());
    // painter's algorithm: the farthest faces first
    std::stable_sort(painted.begin(), painted.end(),
                     [](const Painted& a, const Painted& b) { return a.nearness < b.nearness; });

    const bool edges = painted.size() <= kEdgesShown;
    std::string out = edges ? "<g stroke=\"#3d2a24\" stroke-opacity=\"0.45\" stroke-width=\"0.6\" "
                              "stroke-linejoin=\"round\">\n"
                            : "<g stroke-width=\"0.6\" stroke-linejoin=\"round\">\n";
    for (std::size_t k = 0; k < painted.size();) {
        // neighbours in depth of equal colour share an element
        std::string data;
        const std::string color = painted[k].color;
        for (; k < painted.size() && painted[k].color == color; ++k)
            data += outline(painted[k].face->corners, projection, scale);
        out += fmt::format("<path d=\"{}\" fill=\"{}\"{}/>\n", data, color,
                           edges ? "" : " stroke=\"" + color + "\"");
    }
    return out + "</g>\n";
}

std::string draw_hull_lines(const TriangleMesh& mesh, const Projection& projection,
                            const PageScale& scale, double waterline) {
    const TriangleMesh simple = simplify_mesh(mesh, kMostTriangles);
    std::string out = fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.6\" "
        "stroke-linecap=\"round\"/>\n",
        silhouette(simple, projection, scale));
    // seen from above or below the waterline is drawn as well
    if (std::abs(projection.toward.z()) > 0.9) {
        std::string data;
        for (const auto& [a, b] : cut_mesh(simple, waterline).section) {
            const Vec3 p = projection.apply(a), q = projection.apply(b);
            data += path_data({scale.pixel(p.x(), p.y()), scale.pixel(q.x(), q.y())}, false);
        }
        out += fmt::format(
            "<path d=\"{}\" fill=\"none\" stroke=\"#0b3c5d\" stroke-width=\"1.2\" "
            "stroke-dasharray=\"5 3\"/>\n",
            data);
    }
    return out;
}

}  // namespace ice::views
