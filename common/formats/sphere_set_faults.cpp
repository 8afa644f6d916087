// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/sphere_set_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/assert.hpp"
#include "common/geometry/winding_number.hpp"

namespace ice {

namespace {

// Largest relative difference of the set's integrals from its mesh's [-]. Integrals over the same
// mesh in another order of its triangles differ by 1e-12 at most; 1e-6 also passes sets of programs
// that compute in single precision. A larger value passes a set of another mesh.
constexpr double kSame = 1e-6;

// Spheres whose centres must lie in the mesh [-]. More find a smaller share of wrong spheres and
// take as much more time: each costs O(log T).
constexpr std::size_t kMostCentres = 32;

// The mesh of a 2D set is the prism over one metre of breadth, with two sides that are no surface.
double surface_of(const SphereSet& set, const MassProperties& of_mesh) {
    if (set.dimension == 3) return of_mesh.area;
    double sides = 0.0;
    for (std::size_t t = 0; t < set.mesh.triangles.size(); ++t) {
        const Vec3 across = (set.mesh.corner(t, 1) - set.mesh.corner(t, 0))
                                .cross(set.mesh.corner(t, 2) - set.mesh.corner(t, 0));
        // sides of the prism have the normal +-y, its surface none along y: any bound between
        // separates
        if (std::abs(across.y()) > 0.5 * across.norm()) sides += 0.5 * across.norm();
    }
    return of_mesh.area - sides;
}

std::string unlike(const char* what, double value, const char* unit, double right) {
    return fmt::format("{} of {:.6g} {} where the mesh has {:.6g}", what, value, unit, right);
}

bool has_corners(const TriangleMesh& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.vertices.size());
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& corners) {
        return std::all_of(corners.begin(), corners.end(),
                           [&](std::int32_t k) { return k >= 0 && k < count; });
    });
}

std::string solid_fault(const SphereSet& set, const MassProperties& of_mesh) {
    const double volume = of_mesh.volume, area = surface_of(set, of_mesh);
    const double size = std::cbrt(std::abs(volume));
    const MassProperties& solid = set.solid;
    // Comparisons are written so that NaN is a fault.
    if (!(std::abs(solid.volume - volume) <= kSame * std::abs(volume)))
        return unlike("a volume", solid.volume, "m3", volume);
    if (!(std::abs(solid.area - area) <= kSame * area))
        return unlike("an area", solid.area, "m2", area);
    const double shift = (solid.centroid - of_mesh.centroid).norm();
    if (!(shift <= kSame * size))
        return fmt::format("a centroid {:.3g} m off the mesh's centroid", shift);
    const double most = of_mesh.inertia.cwiseAbs().maxCoeff();
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(solid.inertia(r, c) - of_mesh.inertia(r, c)) <= kSame * most))
                return unlike("an inertia", solid.inertia(r, c), "m5", of_mesh.inertia(r, c));
    return "";
}

std::string share_fault(const SphereSet& set) {
    const double volumes = std::accumulate(set.volumes.begin(), set.volumes.end(), 0.0),
                 areas = std::accumulate(set.areas.begin(), set.areas.end(), 0.0);
    if (!(std::abs(volumes - set.solid.volume) <= kSame * set.solid.volume))
        return fmt::format("shares of the volume that add up to {:.6g} of {:.6g} m3", volumes,
                           set.solid.volume);
    if (!(std::abs(areas - set.solid.area) <= kSame * set.solid.area))
        return fmt::format("shares of the area that add up to {:.6g} of {:.6g} m2", areas,
                           set.solid.area);
    return "";
}

std::string centre_fault(const SphereSet& set) {
    const WindingNumber inside(set.mesh);
    // A sample, because each test walks through the mesh's tree. A set that was made for another
    // mesh fails at almost any centre.
    const std::size_t step = (set.size() + kMostCentres - 1) / kMostCentres;
    for (std::size_t k = 0; k < set.size(); k += step) {
        const Vec3& c = set.centers[k];
        if (!inside.contains(c))
            return fmt::format("sphere {} at ({:.6g}, {:.6g}, {:.6g}) m outside its mesh", k, c.x(),
                               c.y(), c.z());
    }
    return "";
}

}  // namespace

std::string fault_of(const SphereSet& set) {
    ICE_ASSERT(!set.mesh.triangles.empty() && has_corners(set.mesh));
    std::string fault = solid_fault(set, measure_mass(set.mesh));
    if (fault.empty()) fault = share_fault(set);
    return fault.empty() ? centre_fault(set) : fault;
}

}  // namespace ice
