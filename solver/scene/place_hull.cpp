// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/place_hull.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/error.hpp"
#include "common/formats/spheres_file.hpp"

namespace ice {

namespace {

// Least draught, in depths of the hull [-]: a draught of 0 with a mesh's rounding. Only
// refusals depend on it.
constexpr double kLeast = 1e-6;

// z of the lowest and the highest vertex
std::pair<double, double> heights_of(const TriangleMesh& mesh) {
    const auto [low, high] =
        std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                            [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    return {low->z(), high->z()};
}

// A set of floes that is deeper than the draught may be the hull's, in the wrong place. A question
// behind the remedy, or "".
std::string swapped_set(const Case& parameters, double draught) {
    for (std::size_t g = 0; g < parameters.floes.size(); ++g) {
        if (parameters.floes[g].spheres.empty()) continue;  // of a field
        try {
            const auto [low, high] = heights_of(read_spheres(parameters.floes[g].spheres).mesh);
            if (high - low > draught)
                return fmt::format(
                    "; or is hull.spheres the floe's set? floes.{}.spheres is {:.4g} m deep", g + 1,
                    high - low);
        } catch (const Error&) {
            // a file with a fault of its own, which the next run names
        }
    }
    return "";
}

}  // namespace

Vec3 hull_place(const Case& parameters, const TriangleMesh& hull) {
    Vec3 place = parameters.hull_position;
    if (!std::isnan(parameters.hull_draught))
        // The keel comes to z = -draught, wherever the mesh has its origin.
        place.z() = -heights_of(hull).first - parameters.hull_draught;
    return place;
}

Vec3 place_hull(const Case& parameters, const TriangleMesh& hull) {
    const auto [keel, top] = heights_of(hull);
    const double depth = top - keel;
    const bool by_draught = !std::isnan(parameters.hull_draught);
    Vec3 place = hull_place(parameters, hull);
    // z = 0 is the water surface: a position gives a draught, too
    const double draught = by_draught ? parameters.hull_draught : 0.0 - (place.z() + keel);
    if (draught > kLeast * depth && draught < depth) return place;

    const std::string where =
        parameters.file.string() + (by_draught ? ": hull.draught" : ": hull.position");
    const std::string mesh =
        fmt::format("the mesh is {:.4g} m deep, from z = {:.4g} to {:.4g} m", depth, keel, top);
    const std::string remedy = fmt::format("{} between 0 and {:.4g} m",
                                           by_draught ? "give a draught"
                                                      : "give hull.draught in its "
                                                        "place, a number",
                                           depth);
    const std::string given =
        by_draught ? fmt::format("{:.4g} m", draught)
                   : fmt::format("z = {:.4g} m gives a draught of {:.4g} m", place.z(), draught);
    if (draught >= depth)
        throw bad_input(where, given + ": the hull would lie wholly under water; " + mesh,
                        remedy + swapped_set(parameters, draught));
    throw bad_input(where, given + ": the hull would lie above the water; " + mesh, remedy);
}

}  // namespace ice
