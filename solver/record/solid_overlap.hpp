// SPDX-License-Identifier: GPL-3.0-or-later
/// How deep solids lie in each other, whatever the contacts say.
#pragma once

#include <vector>

#include "common/geometry/winding_number.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// What a look at all bodies found; crushed ice is gone and no overlap.
struct OverlapFound {
    double deepest = 0.0;  ///< of two solids [m]
    double unseen = 0.0;   ///< deepest less what the pair's contacts know, of the worst pair [m]
    std::int32_t a = 0, b = 0;  ///< that pair
};

/// Two bodies that share room.
struct PairOverlap {
    double depth = 0.0;         ///< of the deepest point of either one in the other [m]
    Vec3 point = Vec3::Zero();  ///< where that is, world axes [m]; of a depth above 0
    std::int32_t inside =
        -1;  ///< the body whose spheres' centres all lie in the other; -1: neither
};

/// Looks for overlaps with the bodies' meshes, without the contact finder: neither its pairs nor
/// its gaps.
///
/// Points of one body, its mesh's vertices and its spheres' seats as far as crushed, are looked for
/// in the other one and the other way round. In a convex floe a point's depth is exact: the
/// distance of the nearest plane. In other forms (hulls, cusps) the winding number of the mesh says
/// whether it is inside, and the plane at the nearest seat how deep. An edge that crosses another
/// edge between seats is missed by up to half a spacing.
class SolidOverlap {
public:
    explicit SolidOverlap(const Scene& scene);

    /// @param contacts  of these poses or of those a step before; pairs that are held are left out
    OverlapFound measure(const Scene& scene, const std::vector<Contact>& contacts) const;

    /// One pair, whatever its contacts know.
    PairOverlap measure_pair(const Scene& scene, std::int32_t a, std::int32_t b) const;

    /// Does a point of the world's axes lie in a body's mesh?
    bool contains(const Scene& scene, std::int32_t body, const Vec3& point) const;

private:
    struct Point {
        Vec3 at;            ///< of the whole body [m]
        std::int32_t seat;  ///< its sphere; -1: a vertex
        Vec3 normal;        ///< of a seat
    };
    struct Form {
        std::vector<Point> points;  ///< by x, body axes
        std::vector<Point> seats;   ///< those of them that are seats
        WindingNumber inside;
        bool convex;
    };
    struct Nearest {
        const Point* seat;
        double distance;  ///< [m]
    };

    const Form& form_of(const Scene& scene, std::int32_t body) const;
    Nearest nearest_seat(const Form& form, const Vec3& p) const;
    // Depth of p, of b's axes, in b if it is more than `least`; else `least`. `clear`: p is outside
    // b by more than this [m], where known.
    double depth_in(const Scene& scene, std::int32_t b, const Vec3& p, double least,
                    double& clear) const;
    struct Deepest {
        double depth;  ///< [m]
        Vec3 at;       ///< world axes
    };
    // The deepest of a's points in b if deeper than `least`; else `least`.
    Deepest deepest_point(const Scene& scene, std::int32_t a, std::int32_t b,
                          const Deepest& least) const;
    // Do the centres of all of a's spheres lie in b?
    bool lies_in(const Scene& scene, std::int32_t a, std::int32_t b) const;

    std::vector<Form> forms_;  ///< of the scene's shapes
};

}  // namespace ice
