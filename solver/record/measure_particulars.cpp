// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/measure_particulars.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "common/base/units.hpp"
#include "common/formulas/formula_band.hpp"
#include "solver/record/measure_hull_dimensions.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// As the case file names them, in the order of Hold.
constexpr std::string_view kHoldNames[] = {"never", "until-hull-contact", "until-contact",
                                           "until-bent", "always"};

const Shape& shape_of(const Scene& scene, std::size_t body) {
    return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
}

const FloeGroup& group_of(const Scene& scene, const Case& parameters, std::size_t floe) {
    return parameters.floes[static_cast<std::size_t>(scene.bodies.group[floe])];
}

Eigen::Vector3d extent_of(const TriangleMesh& mesh, const Mat3& rotation) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(rotation * v);
    return box.sizes();
}

// Area seen from above: a closed surface turns as much of it up as down.
double plan_area(const TriangleMesh& mesh, const Mat3& rotation) {
    double both = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        both += std::abs(rotation.row(2).dot(mesh.area_vector(t)));
    return 0.5 * both;
}

// Of a floe [m]: the diameter of the circle with its area; 2D: its length.
double size_of(const Shape& shape, const Mat3& rotation) {
    if (shape.dimension == 2) return extent_of(shape.mesh, rotation).x();
    return 2.0 * std::sqrt(plan_area(shape.mesh, rotation) / std::numbers::pi);
}

// Smallest, mean and largest size, and how many floes there are.
void measure_sizes(const Scene& scene, const Case& parameters, IceParticulars& ice) {
    double sum = 0.0;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const FloeGroup& group = group_of(scene, parameters, i);
        // Unbroken ice has the size of its pieces in the file, which means nothing to the ship.
        if (group.hold == Hold::always) continue;
        const double size = size_of(shape_of(scene, i), group.orientation.toRotationMatrix());
        ice.floe_size_min = std::fmin(ice.floe_size_min, size);  // fmin: NaN means none
        ice.floe_size_max = std::fmax(ice.floe_size_max, size);
        sum += size;
        ++ice.floes;
    }
    if (ice.floes > 0) ice.floe_size_mean = sum / static_cast<double>(ice.floes);
}

}  // namespace

ShipParticulars measure_ship(const Scene& scene, const Case& parameters) {
    return measure_ship(scene, parameters, scene.bodies.position[kShip].z());
}

// Upright at this height, also where the ship trims: formulas are made for ships on even keel.
ShipParticulars measure_ship(const Scene& scene, const Case& parameters, double height) {
    const Shape& hull = scene.shapes[0];
    double keel = hull.mesh.vertices.front().z();
    for (const Vec3& v : hull.mesh.vertices) keel = std::min(keel, v.z());
    ShipParticulars ship;
    // in the mesh's axes the water lies at -height
    ship.draught = -height - keel;
    const auto dimensions = measure_hull_dimensions(hull.mesh, -height);
    if (!dimensions) return ship;
    ship.length = dimensions->length;
    if (scene.dimension == 2) return ship;
    ship.breadth = dimensions->breadth;
    ship.stem_angle_deg = dimensions->stem_angle * kDegreesPerRadian;
    ship.entrance_angle_deg = dimensions->entrance_angle * kDegreesPerRadian;
    ship.parallel_length = dimensions->parallel_length;
    ship.bow_length = dimensions->bow_length;
    ship.displacement =
        parameters.water_density * measure_submerged(hull, Mat3::Identity(), height).volume;
    return ship;
}

IceParticulars measure_ice(const Scene& scene, const Case& parameters) {
    IceParticulars ice;
    ice.density = parameters.ice_density;
    ice.friction_ship_ice = parameters.contact.friction_ship_ice;
    ice.friction_ice_ice = parameters.contact.friction_ice_ice;
    ice.crushing_pressure = parameters.contact.crushing_pressure;
    ice.concentration = scene.concentration;
    if (parameters.has_bending()) {
        ice.flexural_strength = parameters.bending.flexural_strength;
        ice.elastic_modulus = parameters.bending.elastic_modulus;
        ice.poisson_ratio = parameters.bending.poisson_ratio;
        ice.bending_model =
            parameters.bending.model == BendingModel::wedge ? "wedge" : "kashtelyan";
        ice.bending_factor = parameters.bending.factor;
    }
    ice.water_density = parameters.water_density;
    ice.gravity = parameters.gravity;
    if (scene.bodies.size() < 2) return ice;
    // the thickness is the extent along z of the first floe as it is placed
    const Mat3 as_it_lies = group_of(scene, parameters, 1).orientation.toRotationMatrix();
    ice.thickness = extent_of(shape_of(scene, 1).mesh, as_it_lies).z();
    measure_sizes(scene, parameters, ice);
    // which rules of release are in use: a resistance means little without them
    bool used[std::size(kHoldNames)] = {};
    for (std::size_t i = 1; i < scene.bodies.size(); ++i)
        used[static_cast<std::size_t>(group_of(scene, parameters, i).hold)] = true;
    // a sheet's rules are those of the case, whatever of it is left or broken by now
    if (parameters.has_level_ice())
        for (const Hold hold : {Hold::until_bent, Hold::always})
            used[static_cast<std::size_t>(hold)] = true;
    for (std::size_t k = 0; k < std::size(kHoldNames); ++k)
        if (used[k]) ice.hold.emplace_back(kHoldNames[k]);
    return ice;
}

double speed_mean(const Case& p, double until) {
    // a run that ended before its averages began has the mean of all of it
    const double from = until > p.average_from ? p.average_from : 0.0;
    return until > from ? p.ship_travel(from, until) / (until - from) : p.ship_speed(0.0);
}

TravelParticulars measure_travel(const Case& p, const ShipParticulars& ship, double until) {
    TravelParticulars travel;
    travel.distance = std::abs(p.ship_travel(0.0, until));
    travel.lengths = travel.distance / ship.length;
    travel.averaged_lengths =
        std::abs(p.ship_travel(std::min(p.average_from, until), until)) / ship.length;
    return travel;
}

void fill_particulars(const Scene& scene, const Case& parameters, double until, Summary& summary,
                      const std::optional<FreeTravel>& went) {
    summary.ship =
        went ? measure_ship(scene, parameters, went->height) : measure_ship(scene, parameters);
    summary.ship.speed_mean = went ? went->speed_mean : speed_mean(parameters, until);
    summary.ice = measure_ice(scene, parameters);
    // a prescribed course first; a free ship has its own travel
    summary.travel = measure_travel(parameters, summary.ship, until);
    if (!scene.water.grid.empty())
        summary.flow = {parameters.flow == FlowModel::file ? "file" : "double-body",
                        scene.water.grid.panels, scene.water.grid.residual};
    if (went)
        summary.travel = {std::abs(went->distance), std::abs(went->distance) / summary.ship.length,
                          std::abs(went->averaged) / summary.ship.length};
    // none in 2D, without a waterline, and of those with angles none for a bow without a point
    summary.formulas = evaluate_formulas(summary.ship, summary.ice, summary.ship.speed_mean);
    for (const FormulaValue& formula : summary.formulas)
        if (formula.part == "submersion") summary.lindqvist_submersion = formula.value;
}

}  // namespace ice
