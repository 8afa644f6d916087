// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/side_planes.hpp"

#include <algorithm>
#include <cmath>

#include "solver/shape/shape.hpp"
#include "solver/shape/sphere_grid.hpp"

namespace ice {

namespace {

// Normals this near (cosine; 2.6 degrees) in planes this near (radii) [-] are of one face: the
// hull's are curved. Looser ones take a neighbouring face for the own one, which then has no side
// plane there; stricter ones end a curved face at each of its facets.
constexpr double kOneFace = 0.999, kOnePlane = 0.1;

// Planes this near (cosine, radii) [-] are one: spheres along a straight edge differ by rounding.
// Only the number of planes to test depends on it.
constexpr double kSamePlaneNormal = 1.0 - 1e-9, kSamePlaneRounding = 1e-6;

// A plane that leaves this much (radii) [-] of another edge's sphere before it cuts nothing off.
// Larger lets planes cut hollow outlines; smaller drops planes for rounding.
constexpr double kCutOff = 0.01;

// The face of a sphere: its patch lies in a plane tangent to it.
struct Face {
    Vec3 normal;
    double offset;  // normal . x in it
};

class SidePlaneFinder {
public:
    SidePlaneFinder(const Shape& shape, const std::vector<std::int32_t>& edges,
                    const SphereGrid& grid)
        : shape_(shape), edges_(edges), grid_(grid) {}

    // The planes that end the patch of sphere k; valid until the next call.
    const std::vector<Face>& of(std::size_t k) {
        found_.clear();
        const NormalCone& faces = shape_.cone[k];
        // A corner ends at its own planes, and a sphere on a curved part has no flat face to
        // end.
        if (faces.count > 2 || (faces.count == 0 && shape_.spread_cos[k] != 1.0)) return found_;
        find_near(k);
        if (near_.empty()) return found_;
        if (faces.count == 0) {
            list_next(k, shape_.normal[k], found_);
            return found_;
        }
        // An edge ends where both its faces end: at planes that both lists have.
        list_next(k, faces.normal[0], found_);
        list_next(k, faces.normal[1], other_);
        std::erase_if(found_, [&](const Face& f) {
            return std::none_of(other_.begin(), other_.end(),
                                [&](const Face& g) { return is_same(f, g, shape_.radius[k]); });
        });
        return found_;
    }

private:
    static bool is_same(const Face& l, const Face& r, double radius) {
        return l.normal.dot(r.normal) > kOneFace &&
               std::abs(l.offset - r.offset) <= kOnePlane * radius;
    }
    Face face_of(std::size_t sphere, const Vec3& normal) const {
        return {normal, normal.dot(shape_.center[sphere]) + shape_.radius[sphere]};
    }
    // The point that the sphere's faces have in common, a face's point of touch.
    Vec3 tip(std::size_t sphere) const {
        return shape_.center[sphere] + shape_.cone[sphere].apex_distance * shape_.normal[sphere];
    }

    void find_near(std::size_t k) {
        near_.clear();
        const double range = 2.0 * shape_.patch_radius + shape_.radius[k];
        grid_.for_each_near(shape_.center[k], range, [&](std::int32_t row) {
            const auto m = static_cast<std::size_t>(edges_[static_cast<std::size_t>(row)]);
            if (m != k && (shape_.center[m] - shape_.center[k]).squaredNorm() <= range * range)
                near_.push_back(m);
        });
        // of planes that are all but one the first is kept: mirror images shall keep the same
        std::sort(near_.begin(), near_.end(), [&](std::size_t l, std::size_t r) {
            return shape_.mirror_rank[l] < shape_.mirror_rank[r];
        });
    }

    // The faces that meet sphere k's face with this normal in the spheres of near_.
    void list_next(std::size_t k, const Vec3& normal, std::vector<Face>& out) {
        out.clear();
        beside_.clear();
        // Spheres in edges that share this face: their other faces are the face's neighbours.
        const Face own = face_of(k, normal);
        for (const std::size_t m : near_) {
            const NormalCone& faces = shape_.cone[m];
            const auto first = faces.normal.begin(), last = first + faces.count;
            if (std::any_of(first, last, [&](const Vec3& n) {
                    return is_same(own, face_of(m, n), shape_.radius[k]);
                }))
                beside_.push_back(m);
        }
        for (const std::size_t m : beside_)
            for (int f = 0; f < shape_.cone[m].count; ++f) {
                const Face next = face_of(m, shape_.cone[m].normal[static_cast<std::size_t>(f)]);
                if (!is_same(own, next, shape_.radius[k]) && is_new(next, k, out) && ends(next, k))
                    out.push_back(next);
            }
    }
    bool is_new(const Face& face, std::size_t k, const std::vector<Face>& known) const {
        return std::none_of(known.begin(), known.end(), [&](const Face& f) {
            return f.normal.dot(face.normal) > kSamePlaneNormal &&
                   std::abs(f.offset - face.offset) <= kSamePlaneRounding * shape_.radius[k];
        });
    }
    // Does all that is known of the face lie before the plane?
    bool ends(const Face& plane, std::size_t k) const {
        const double most = plane.offset + kCutOff * shape_.radius[k];
        return plane.normal.dot(tip(k)) <= most &&
               std::all_of(beside_.begin(), beside_.end(),
                           [&](std::size_t m) { return plane.normal.dot(tip(m)) <= most; });
    }

    const Shape& shape_;
    const std::vector<std::int32_t>& edges_;
    const SphereGrid& grid_;
    std::vector<std::size_t> near_, beside_;
    std::vector<Face> found_, other_;
};

}  // namespace

SidePlanes::SidePlanes(const Shape& shape) {
    std::vector<std::int32_t> edges;  // and corners
    std::vector<Vec3> centers;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        if (shape.cone[k].count == 0) continue;
        edges.push_back(static_cast<std::int32_t>(k));
        centers.push_back(shape.center[k]);
    }
    const SphereGrid grid(centers, 2.0 * shape.patch_radius);
    SidePlaneFinder finder(shape, edges, grid);
    first_.push_back(0);
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        for (const Face& face : finder.of(k)) planes_.push_back({face.normal, face.offset});
        first_.push_back(static_cast<std::ptrdiff_t>(planes_.size()));
    }
}

}  // namespace ice
