// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/half_hull.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "preprocess/load/symmetry.hpp"

namespace ice {

namespace {

// Distance from the centre plane over the diagonal [-] up to which a vertex lies in it. Twice this
// is the distance within which weld() joins vertices: with a larger value a vertex and its image
// stay two, with a smaller one the seam's vertices are beside the plane.
constexpr double kInPlane = 5e-7;
// Share of the mesh's length and height [-] that open edges or flat triangles of half a hull reach
// over in the centre plane. A transom or a hatch in the plane does not: of half a hull the centre
// plane is nearly all there. A larger value misses halves with a step in their keel, a smaller one
// takes bodies with a flat part at y = 0 for halves.
constexpr double kReachesOver = 0.5;
// Longest extent of a closed half over its breadth [-]: hulls have 1.5 and more, their halves 3. A
// larger value misses halves of broad hulls, a smaller one takes whole bodies for halves.
constexpr double kSlenderHalf = 2.5;

// Distance from the centre plane up to which a vertex lies in it [m].
double flatness(const TriangleMesh& mesh) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    return box.isEmpty() ? 0.0 : kInPlane * box.diagonal().norm();
}

bool in_plane(const TriangleMesh& mesh, std::size_t t, int axis, double flat) {
    for (int k = 0; k < 3; ++k)
        if (std::abs(mesh.corner(t, k)[axis]) > flat) return false;
    return true;
}

// For each vertex the first one at the same place, so that unwelded files have edges in common.
std::vector<std::int32_t> first_at_place(const std::vector<Vec3>& vertices) {
    std::vector<std::int32_t> order(vertices.size()), first(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](std::int32_t k) {
        const Vec3& v = vertices[static_cast<std::size_t>(k)];
        return std::array{v.x(), v.y(), v.z()};
    };
    // By place, then by number: equal places are adjacent, the first vertex in front. Places must
    // be equal to the bit, as files write one vertex of several triangles.
    std::sort(order.begin(), order.end(), [&](std::int32_t l, std::int32_t r) {
        return std::pair(place(l), l) < std::pair(place(r), r);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && place(order[k]) == place(order[k - 1]);
        first[static_cast<std::size_t>(order[k])] =
            same ? first[static_cast<std::size_t>(order[k - 1])] : order[k];
    }
    return first;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

// Edges in the plane that one triangle alone has.
std::vector<Edge> open_edges_in_plane(const TriangleMesh& mesh, int axis, double flat) {
    const std::vector<std::int32_t> first = first_at_place(mesh.vertices);
    const auto flat_vertex = [&](std::int32_t k) {
        return std::abs(mesh.vertices[static_cast<std::size_t>(k)][axis]) <= flat;
    };
    std::vector<Edge> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = first[static_cast<std::size_t>(t[k])];
            const std::int32_t b = first[static_cast<std::size_t>(t[(k + 1) % 3])];
            if (a != b && flat_vertex(a) && flat_vertex(b)) edges.push_back(std::minmax(a, b));
        }
    // vertices are not welded yet: edges are compared by the places of their ends
    std::sort(edges.begin(), edges.end());
    std::vector<Edge> open;
    for (std::size_t k = 0; k < edges.size();) {
        std::size_t end = k;
        while (end < edges.size() && edges[end] == edges[k]) ++end;
        if (end - k == 1) open.push_back(edges[k]);
        k = end;
    }
    return open;
}

// Whether something in the plane reaches over kReachesOver of the mesh both ways.
bool reaches_far(const Eigen::AlignedBox3d& part, const Eigen::AlignedBox3d& whole, int axis) {
    if (part.isEmpty()) return false;
    const Vec3 p = part.sizes(), w = whole.sizes();
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    return p[a] >= kReachesOver * w[a] && p[b] >= kReachesOver * w[b];
}

}  // namespace

HalfHull looks_like_half_hull(const TriangleMesh& mesh, int axis) {
    HalfHull half;
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    const double flat = flatness(mesh);
    if (box.isEmpty() || box.sizes()[axis] <= 2.0 * flat) return half;
    // all on one side of the plane, which the mesh touches
    half.port = box.min()[axis] >= -flat;
    if (!half.port && box.max()[axis] > flat) return half;

    Eigen::AlignedBox3d closed, open;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (in_plane(mesh, t, axis, flat)) {
            ++half.centre_plane_triangles;
            for (int k = 0; k < 3; ++k) closed.extend(mesh.corner(t, k));
        }
    for (const auto& [a, b] : open_edges_in_plane(mesh, axis, flat)) {
        ++half.open_edges;
        open.extend(mesh.vertices[static_cast<std::size_t>(a)]);
        open.extend(mesh.vertices[static_cast<std::size_t>(b)]);
    }
    // An open half has a rim of open edges along the centre plane, a closed one a flat wall there.
    // A whole, symmetric body that merely begins at y = 0 has neither over most of its length.
    const bool far_open = reaches_far(open, box, axis), far_closed = reaches_far(closed, box, axis);
    const bool slender = box.sizes().maxCoeff() >= kSlenderHalf * box.sizes()[axis];
    if (far_open && !far_closed)
        half.kind = HalfHull::Kind::open;
    else if (far_closed && !far_open && slender && asymmetry(mesh, axis) > kSymmetric)
        half.kind = HalfHull::Kind::closed;
    return half;
}

bool is_open_half(const TriangleMesh& mesh) {
    return looks_like_half_hull(mesh).kind == HalfHull::Kind::open;
}

std::string HalfHull::text() const {
    if (kind == Kind::none) return {};
    return fmt::format("this looks like half a hull (everything is on the {} side of y = 0, {})",
                       port ? "port" : "starboard",
                       kind == Kind::open
                           ? fmt::format("{} open edges lie in that plane", open_edges)
                           : fmt::format("{} triangles close it there", centre_plane_triangles));
}

std::int64_t drop_centre_plane(TriangleMesh& mesh) {
    const double flat = flatness(mesh);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (in_plane(mesh, t, 1, flat)) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.region[kept++] = mesh.region[t];
    }
    const auto dropped = static_cast<std::int64_t>(mesh.triangles.size() - kept);
    mesh.triangles.resize(kept);
    mesh.region.resize(kept);
    return dropped;
}

void add_mirror_image(TriangleMesh& mesh) {
    std::vector<std::int32_t> image(mesh.vertices.size());
    for (std::size_t k = 0; k < image.size(); ++k) {
        const Vec3 v = mesh.vertices[k];
        // vertices in the plane belong to both halves
        if (v.y() == 0.0) {
            image[k] = static_cast<std::int32_t>(k);
            continue;
        }
        image[k] = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.emplace_back(v.x(), -v.y(), v.z());
    }
    const auto at = [&](std::int32_t k) { return image[static_cast<std::size_t>(k)]; };
    const std::size_t triangles = mesh.triangles.size();
    for (std::size_t t = 0; t < triangles; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        // a mirror image turns triangles inside out: two corners change places
        mesh.triangles.push_back({at(a), at(c), at(b)});
        mesh.region.push_back(mesh.region[t]);
    }
}

}  // namespace ice
