// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/build_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "common/formats/field_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/scene/apply_jitter.hpp"
#include "solver/scene/ice_extent.hpp"
#include "solver/scene/inertia_of.hpp"
#include "solver/scene/place_hull.hpp"
#include "solver/scene/set_breaking_loads.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// Floes of a case at most [-]: their state alone takes some 4 GB. A larger number is a slip in
// floes.count, and would end in a failed allocation without a key's name.
constexpr double kMostFloes = 1e7;

// A set of another dimension is refused by its file's name, with the command that makes the right
// one.
Shape read_shape(const std::filesystem::path& file, int dimension, bool about_centre_of_mass) {
    const SphereSet set = read_spheres(file);
    if (set.dimension != dimension)
        throw bad_input(
            file.string(),
            fmt::format("is a {}D set in a case of dimension {}", set.dimension, dimension),
            dimension == 2 ? "make it with spherize --slice y=0"
                           : "make it with spherize without --slice");
    return build_shape(set, about_centre_of_mass);
}

// Centres of a group's floes in the x-y plane. `low` and `size` are the shape's box in the
// group's orientation, relative to the centre of mass.
std::vector<Vec3> place_group(const FloeGroup& group, const Vec3& low, const Vec3& size,
                              bool planar) {
    if (group.pattern == Pattern::single) return {group.position};
    // centre distance of neighbours: the box of a floe and the gap
    const double pitch_x = size.x() + group.gap[0];
    const double pitch_y = planar ? 0.0 : size.y() + group.gap[1];
    std::vector<Vec3> places;
    for (int row = 0; row < group.count[1]; ++row)
        for (int column = 0; column < group.count[0]; ++column) {
            double across = (row - 0.5 * (group.count[1] - 1)) * pitch_y;
            // every other column is shifted by half a floe, as bricks in a wall
            if (group.pattern == Pattern::brick && column % 2 == 1) across += 0.5 * pitch_y;
            const double centre_y = low.y() + 0.5 * size.y();  // box centre off the centre of mass
            places.emplace_back(group.origin[0] - low.x() + column * pitch_x,
                                planar ? 0.0 : group.origin[1] + across - centre_y, std::nan(""));
        }
    return places;
}

// Floes of one shape, in rows and columns. They are placed and not moved apart: check_start() finds
// overlaps.
void add_group(Scene& scene, const Case& parameters, std::size_t g, std::int32_t shape_row) {
    const FloeGroup& group = parameters.floes[g];
    const Shape& shape = scene.shapes[static_cast<std::size_t>(shape_row)];
    const Mat3 rotation = group.orientation.toRotationMatrix();
    // the box in the group's orientation: neighbours keep the gap however they are turned
    Eigen::AlignedBox3d box;
    for (const Vec3& v : shape.mesh.vertices) box.extend(rotation * v);
    // as doubles: the product of two counts may exceed an integer
    const double count = static_cast<double>(group.count[0]) * group.count[1];
    if (count + static_cast<double>(scene.bodies.size()) > kMostFloes)
        throw bad_input(fmt::format("floes.{}.count", g + 1), "needs more than 10 million floes",
                        "use fewer floes");

    const double fraction = parameters.ice_density / parameters.water_density;
    double height = std::nan("");
    for (Vec3 place : place_group(group, box.min(), box.sizes(), parameters.dimension == 2)) {
        if (std::isnan(place.z())) {
            if (fraction >= 1.0)
                throw bad_input(fmt::format("floes.{}", g + 1),
                                "ice as dense as water has no floating equilibrium",
                                "state z in position, or lower ice.density");
            // one search for all floes of the group: shape, density and orientation are the same
            if (std::isnan(height)) height = floating_height(shape, rotation, fraction);
            place.z() = height;
        }
        add_floe(scene, shape_row, parameters.ice_density,
                 {place, group.orientation, group.velocity, group.angular_velocity, group.hold},
                 static_cast<std::int32_t>(g));
    }
}

// Rows of Scene::shapes by file: equal files share their shapes.
struct ShapeRows {
    std::map<std::filesystem::path, std::int32_t> of_set;
    std::map<std::filesystem::path, std::pair<Field, std::int32_t>> of_field;  // and first row
};

void add_set_group(Scene& scene, const Case& parameters, std::size_t g, ShapeRows& rows) {
    const auto& file = parameters.floes[g].spheres;
    // a set that two groups share is read once
    const auto [found, fresh] =
        rows.of_set.try_emplace(file, static_cast<std::int32_t>(scene.shapes.size()));
    if (fresh) scene.shapes.push_back(read_shape(file, parameters.dimension, true));
    add_group(scene, parameters, g, found->second);
}

// The loose floes or the unbroken ice of a field. All float at equilibrium.
void add_field_group(Scene& scene, const Case& parameters, std::size_t g, ShapeRows& rows) {
    const FloeGroup& group = parameters.floes[g];
    const double fraction = parameters.ice_density / parameters.water_density;
    if (fraction >= 1.0)
        throw bad_input(fmt::format("floes.{}", g + 1),
                        "ice as dense as water has no floating equilibrium", "lower ice.density");
    auto found = rows.of_field.find(group.file);
    if (found == rows.of_field.end()) {
        const auto first = static_cast<std::int32_t>(scene.shapes.size());
        found = rows.of_field.emplace(group.file, std::pair{read_field(group.file), first}).first;
        for (SphereSet& set : found->second.first.shapes) {
            scene.shapes.push_back(build_shape(set, true));
            // a large field twice in memory would be too much
            set = {};
        }
    }
    const auto& [field, first_row] = found->second;
    for (const FieldFloe& floe : field.floes) {
        if (floe.fixed != group.unbroken_part) continue;
        const std::int32_t row = first_row + floe.shape;
        // each floe of a field may have a shape of its own
        const double height = floating_height(scene.shapes[static_cast<std::size_t>(row)],
                                              floe.orientation.toRotationMatrix(), fraction);
        const Vec3 place(group.origin[0] + floe.position[0], group.origin[1] + floe.position[1],
                         height);
        add_floe(scene, row, parameters.ice_density,
                 {place, floe.orientation, group.velocity, Vec3::Zero(), group.hold},
                 static_cast<std::int32_t>(g));
    }
}

// The row of a shape's moments of inertia, made where its newest is of another density. Thousands
// of floes of one shape share a row, which the lanes of the loads then load once.
std::int32_t share_inertia(Scene& scene, std::int32_t shape_row, double density) {
    Bodies& b = scene.bodies;
    b.inertia_of_shape.resize(scene.shapes.size(), -1);
    std::int32_t& row = b.inertia_of_shape[static_cast<std::size_t>(shape_row)];
    if (row >= 0 && b.inertias[static_cast<std::size_t>(row)].density == density) return row;
    row = static_cast<std::int32_t>(b.inertias.size());
    b.inertias.push_back(inertia_of(scene.shapes[static_cast<std::size_t>(shape_row)], density));
    return row;
}

}  // namespace

Inertia inertia_of(const Shape& shape, double density) {
    Inertia inertia{density, density * shape.solid.inertia, Mat3::Zero()};
    // In 2D a floe turns about y alone: the other components of the inverse stay zero.
    if (shape.dimension == 2)
        inertia.inverse(1, 1) = 1.0 / inertia.body(1, 1);
    else
        inertia.inverse = inertia.body.inverse();
    return inertia;
}

Scene make_scene(Shape hull, const Vec3& position, const Vec3& velocity) {
    Scene scene;
    scene.dimension = hull.dimension;
    scene.ship_velocity = velocity;
    scene.shapes.push_back(std::move(hull));
    // body 0, with zeros for everything that has no effect on a prescribed course
    Bodies& b = scene.bodies;
    b.shape.push_back(0);
    b.group.push_back(-1);
    b.mass.push_back(0.0);
    b.inertias.push_back({0.0, Mat3::Zero(), Mat3::Zero()});
    b.inertia_row.push_back(0);
    b.position.push_back(position);
    b.orientation.push_back(Quaternion::Identity());
    b.momentum.push_back(Vec3::Zero());
    b.angular_momentum.push_back(Vec3::Zero());
    b.held.push_back(Bodies::kFree);
    b.rotation.push_back(Mat3::Identity());
    b.velocity.push_back(velocity);
    b.angular_velocity.push_back(Vec3::Zero());
    b.inverse_mass.push_back(0.0);
    b.inverse_inertia_world.push_back(Mat3::Zero());
    return scene;
}

std::size_t add_floe(Scene& scene, std::int32_t shape_row, double density, const FloeStart& start,
                     std::int32_t group) {
    // floating heights are found before
    const Shape& shape = scene.shapes[static_cast<std::size_t>(shape_row)];
    ICE_ASSERT(std::isfinite(start.position.z()));
    // a held floe keeps its momentum: it drifts at its velocity, and is released with it
    const bool held = start.hold != Hold::never;
    Bodies& b = scene.bodies;
    b.shape.push_back(shape_row);
    b.group.push_back(group);
    b.mass.push_back(density * shape.solid.volume);
    b.inertia_row.push_back(share_inertia(scene, shape_row, density));
    b.position.push_back(start.position);
    b.orientation.push_back(start.orientation);
    b.momentum.push_back(Vec3::Zero());
    b.angular_momentum.push_back(Vec3::Zero());
    b.held.push_back(held ? Bodies::kHeld : Bodies::kFree);
    b.rotation.push_back(Mat3::Identity());
    b.velocity.push_back(Vec3::Zero());
    b.angular_velocity.push_back(Vec3::Zero());
    b.inverse_mass.push_back(0.0);
    b.inverse_inertia_world.push_back(Mat3::Zero());
    const std::size_t i = b.size() - 1;
    if (!held) b.moving.push_back(static_cast<std::int32_t>(i));
    // at rest momenta stay exact zeros; else P = m v and L = R I R^T w, (2)
    if (!start.velocity.isZero(0.0) || !start.angular_velocity.isZero(0.0)) {
        const Mat3 rotation = start.orientation.toRotationMatrix();
        b.momentum[i] = b.mass[i] * start.velocity;
        b.angular_momentum[i] =
            rotation * b.inertia(i) * rotation.transpose() * start.angular_velocity;
    }
    update_derived(b, i);
    return i;
}

namespace {

// Pieces of level ice have no number before they break off: a slot is many of them in turn.
void require_tracked_floes(const Scene& scene, const Case& parameters) {
    const auto floes = static_cast<int>(scene.bodies.size()) - 1;
    for (const int id : parameters.track) {
        if (id <= floes) continue;
        throw bad_input(
            "output.track",
            fmt::format("floe {} does not exist: there are {} as the run begins", id, floes),
            parameters.has_level_ice()
                ? "leave it out: pieces that break off [level_ice] cannot be tracked, "
                  "pieces.h5 and run.h5 have their motion"
                : "floes are numbered from 1 in the order of [[floes]], x fastest");
    }
}

}  // namespace

Scene build_scene(const Case& parameters) {
    Shape hull = read_shape(parameters.hull_spheres, parameters.dimension, false);
    const Vec3 place = place_hull(parameters, hull.mesh);
    Scene scene = make_scene(std::move(hull), place, Vec3(parameters.ship_speed(0.0), 0.0, 0.0));
    ShapeRows rows;
    for (std::size_t g = 0; g < parameters.floes.size(); ++g) {
        if (parameters.floes[g].pattern == Pattern::file)
            add_field_group(scene, parameters, g, rows);
        else
            add_set_group(scene, parameters, g, rows);
    }
    // only of a single field the cover of the whole is known
    if (rows.of_set.empty() && rows.of_field.size() == 1)
        scene.concentration = rows.of_field.begin()->second.first.concentration;
    apply_jitter(scene, parameters);
    set_breaking_loads(scene, parameters);
    scene.start = find_ice_at_start(scene, parameters);
    require_tracked_floes(scene, parameters);
    return scene;
}

}  // namespace ice
