// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/place_hull.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"

namespace ice {

namespace {

constexpr double kLeast = 1e-6;  // of the depth: what rounding of a mesh makes of a draught of 0

}  // namespace

Vec3 place_hull(const Case& parameters, const TriangleMesh& hull) {
    double keel = hull.vertices.front().z(), top = keel;
    for (const Vec3& v : hull.vertices) {
        keel = std::min(keel, v.z());
        top = std::max(top, v.z());
    }
    const double depth = top - keel;
    const bool by_draught = !std::isnan(parameters.hull_draught);
    Vec3 place = parameters.hull_position;
    if (by_draught) place.z() = -keel - parameters.hull_draught;
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
        throw bad_input(where, given + ": the hull would lie wholly under water; " + mesh, remedy);
    throw bad_input(where, given + ": the hull would glide over the ice; " + mesh, remedy);
}

}  // namespace ice
