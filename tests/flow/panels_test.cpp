// SPDX-License-Identifier: GPL-3.0-or-later
// The flow around bodies by source panels: known answers, mirror images, bits.
//
// Tolerances: 4e-16 and 1e-15 are one or some last digits; 1e-9 is central differences, step^2 and
// rounding over step, 1e-5 m; 1e-5 of a sum is many points in place of a panel; 1e-9 m is places of
// a metre, cut; 1e-12 is rounding of a length; 0.3 to 3 % are the panels' error (docs/method.md,
// section 6).
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <random>

#include "common/base/error.hpp"
#include "solver/flow/own_functions.hpp"
#include "solver/flow/solve_panels.hpp"
#include "solver/flow/wetted_panels.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::same_bits;

namespace {

// All edges of the globe are shorter: its own triangles are the panels.
constexpr PanelSize kOwnTriangles{0.5, 8000};

// Of a sphere at 1 m/s along +x: phi = -radius^3 x / (2 r^3).
Vec3 sphere_velocity(const Vec3& p, double radius) {
    const double r = p.norm();
    return -0.5 * std::pow(radius / r, 3) * (Vec3::UnitX() - 3.0 * p.x() / (r * r) * p);
}

double area_rms(const PanelFlow& flow, const std::vector<double>& error) {
    double squares = 0.0, area = 0.0;
    for (std::size_t j = 0; j < error.size(); ++j) {
        squares += flow.body.panels[j].area * error[j] * error[j];
        area += flow.body.panels[j].area;
    }
    return std::sqrt(squares / area);
}

double sphere_error(const PanelFlow& flow, double radius) {
    std::vector<Vec3> points;
    for (const SourcePanel& p : flow.body.panels) points.push_back(1.15 * p.centre.normalized());
    const auto samples = flow_at(flow, points);
    std::vector<double> error;
    for (std::size_t k = 0; k < points.size(); ++k)
        error.push_back((samples[k].velocity - sphere_velocity(points[k], radius)).norm());
    return area_rms(flow, error);
}

// Added mass over that of the displaced water for motion along x [-]. By Green's theorem the
// sources' dipole moment is sum of s A x = V (1 + C_a). @param volume  of the body [m3]
double added_mass_coefficient(const PanelFlow& flow, double volume) {
    double moment = 0.0;
    for (std::size_t j = 0; j < flow.body.panels.size(); ++j)
        moment += flow.strength[j] * flow.body.panels[j].area * flow.body.panels[j].centre.x();
    return (flow.body.symmetric ? 2.0 : 1.0) * moment / volume - 1.0;
}

std::vector<Vec3> points_around(const WettedHull& hull, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-0.3, 1.3);
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 s(share(random), share(random), share(random));
        out.push_back(hull.low + s.cwiseProduct(hull.high - hull.low));
    }
    return out;
}

}  // namespace

TEST_CASE("own logarithm and angle are those of the library to some last digits", "[flow]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (int k = 0; k < 20000; ++k) {
        const double x = std::exp(30.0 * place(random));
        CHECK(own::log(x) == Near(std::log(x)).epsilon(4e-16).margin(4e-16));
        const double a = place(random), b = std::abs(place(random)) * (k % 3 == 0 ? 1e-9 : 1.0);
        CHECK(own::half_plane_angle(b, a) == Near(std::atan2(b, a)).epsilon(1e-15).margin(1e-15));
    }
    CHECK(own::half_plane_angle(0.0, 1.0) == Near(0.0).margin(1e-15));
    CHECK(own::half_plane_angle(0.0, -1.0) == Near(std::numbers::pi));
    CHECK(std::isfinite(own::half_plane_angle(0.0, 0.0)));
}

TEST_CASE("a panel's flow is the gradient of its potential, and that of its sources",
          "[flow][analytic]") {
    PanelBody body;
    body.panels.push_back(make_panel(Vec3(0, 0, -1), Vec3(0.7, 0.1, -1.2), Vec3(0.2, 0.9, -0.8)));
    const std::vector<double> strength{1.0};
    const Vec3 at(0.4, 0.6, -0.5);
    const double step = 1e-5;
    std::vector<Vec3> points{at};
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) points.push_back(at + sign * step * Vec3::Unit(axis));
    std::vector<FlowSample> out(points.size());
    sum_panels(body, strength, points, out);
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(2 * axis + 1);
        const double slope = (out[k].potential - out[k + 1].potential) / (2.0 * step);
        CHECK(out[0].velocity[axis] == Near(slope).margin(1e-9));
    }
    // the same sources as many points, and their images below
    Vec3 sum = Vec3::Zero();
    const SourcePanel& p = body.panels[0];
    const int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            for (const double third : {1.0, 2.0}) {  // triangles pointing up and down
                if (third == 2.0 && i + j == n - 1) continue;
                const double u = (i + third / 3.0) / n, v = (j + third / 3.0) / n;
                Vec3 source =
                    p.corner[0] + u * (p.corner[1] - p.corner[0]) + v * (p.corner[2] - p.corner[0]);
                for (int image = 0; image < 2; ++image, source.z() = -source.z()) {
                    const Vec3 off = at - source;
                    sum +=
                        p.area / (n * n) * off / (4.0 * std::numbers::pi * std::pow(off.norm(), 3));
                }
            }
    CHECK((out[0].velocity - sum).norm() < tolerance(1e-5) * sum.norm());
}

TEST_CASE("a sphere's flow and added mass are those of the book, and better with more panels",
          "[flow][analytic]") {
    // 1300 triangles on the half sphere under water, a quarter as many, and more
    const WettedHull few = make_wetted_hull(test::make_globe(1.0, 13), 0.0, kOwnTriangles),
                     many = make_wetted_hull(test::make_globe(1.0, 26), 0.0, kOwnTriangles);
    const PanelFlow coarse = solve_panels(few.body), fine = solve_panels(many.body);
    CHECK(fine.body.symmetric);
    CHECK(fine.body.panels.size() <= 660);
    CHECK(sphere_error(fine, 1.0) < tolerance(0.003));
    // facets cut the sphere smaller, which hides part of the panels' own error: against the sphere
    // of the mesh's volume it halves with the edges
    const auto radius = [](const WettedHull& hull) {
        return std::cbrt(hull.volume / (2.0 / 3.0 * std::numbers::pi));
    };
    CHECK(sphere_error(coarse, radius(few)) > 1.6 * sphere_error(fine, radius(many)));
    CHECK(coarse.residual > 1.6 * fine.residual);
    CHECK(std::abs(fine.net_flux) < tolerance(2e-3));
    const WettedHull finest = make_wetted_hull(test::make_globe(1.0, 36), 0.0, kOwnTriangles);
    // C_a of a sphere is 1/2; 3 % is the error that docs/method.md, section 6, states for panels
    CHECK(added_mass_coefficient(solve_panels(finest.body), finest.volume) ==
          Near(0.5).epsilon(0.03));
}

TEST_CASE("an ellipsoid's surface speed is that of the book", "[flow][analytic]") {
    TriangleMesh mesh = test::make_globe(1.0, 36);
    // poles onto the x axis, where they are the ends
    for (Vec3& v : mesh.vertices) v = Vec3(5.0 * v.z(), v.y(), -0.7 * v.x());
    const WettedHull hull = make_wetted_hull(mesh, 0.0, {10.0, 8000});
    CHECK(hull.body.panels.size() >= 1260);
    const PanelFlow flow = solve_panels(hull.body);
    // C_a = alpha / (2 - alpha), alpha = a b c int_0^inf ds / ((a^2 + s) sqrt((a^2 + s) ...)):
    // Lamb, Hydrodynamics, art. 114
    const double added = 0.0451;
    std::vector<Vec3> points;
    for (const SourcePanel& p : flow.body.panels)
        points.push_back(p.centre + kOffPanel * std::sqrt(p.area) * p.normal);
    const auto samples = flow_at(flow, points);
    std::vector<double> error;
    for (std::size_t j = 0; j < points.size(); ++j) {
        const Vec3& c = flow.body.panels[j].centre;
        const Vec3 normal = Vec3(c.x() / 25.0, c.y(), c.z() / 0.49).normalized();
        const Vec3 slip = (1.0 + added) * (Vec3::UnitX() - normal.x() * normal);
        error.push_back((samples[j].velocity - Vec3::UnitX()).norm() - slip.norm());
    }
    CHECK(area_rms(flow, error) < tolerance(0.005));
    CHECK(flow.residual < tolerance(0.01));
    // the dipole moment measures 1 + C_a: its error of 3 % is all of the small C_a's
    CHECK(added_mass_coefficient(flow, hull.volume) == Near(added).margin(0.03 * 1.0451));
}

TEST_CASE("mirrored points have mirrored flows, bit for bit", "[flow]") {
    const WettedHull hull = make_wetted_hull(test::make_wigley(6.0, 1.2, 0.6, 12, 4), 0.0, {});
    REQUIRE(hull.body.symmetric);
    const PanelFlow flow = solve_panels(hull.body);
    const auto points = points_around(hull, 101, 4);
    auto port = points, up = points;
    for (Vec3& p : port) p.y() = -p.y();
    for (Vec3& p : up) p.z() = -p.z();
    const auto here = flow_at(flow, points), there = flow_at(flow, port), above = flow_at(flow, up);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 &v = here[k].velocity, &p = there[k].velocity, &u = above[k].velocity;
        CHECK((v.x() == p.x() && v.y() == -p.y() && v.z() == p.z()));
        CHECK((v.x() == u.x() && v.y() == u.y() && v.z() == -u.z()));
        CHECK(here[k].potential == there[k].potential);
    }
}

TEST_CASE("every instruction set gives the panels' flow to the bits of the reference",
          "[flow][simd]") {
    WettedHull hull = make_wetted_hull(test::make_wigley(6.0, 1.2, 0.6, 8, 3), 0.0, {});
    hull.body.symmetric = GENERATE(true, false);
    const auto& panels = hull.body.panels;
    const std::size_t count = GENERATE(1u, 3u, 8u, 13u, 64u);
    auto points = points_around(hull, count, 5);
    points[0] = panels[0].corner[1];  // in a corner, on an edge, on a panel
    if (count > 8) {
        points[1] = 0.5 * (panels[2].corner[0] + panels[2].corner[1]);
        points[8] = panels[3].centre;
    }
    std::vector<double> strength;
    for (std::size_t j = 0; j < panels.size(); ++j) strength.push_back(0.1 * double(j % 7) - 0.3);
    std::vector<FlowSample> expected(count);
    reference::sum_panels(hull.body, strength, points, expected);
    for (const FlowSample& sample : expected) REQUIRE(sample.velocity.allFinite());
    FluxTargets targets;
    for (std::size_t i = 0; i < FluxTargets::kCount; ++i) {
        const auto at = flux_points(panels[3 * i]);
        for (std::size_t q = 0; q < 3; ++q) {
            targets.x[q][i] = at[q].x();
            targets.y[q][i] = at[q].y();
            targets.z[q][i] = at[q].z();
        }
        targets.nx[i] = panels[3 * i].normal.x();
        targets.ny[i] = panels[3 * i].normal.y();
        targets.nz[i] = panels[3 * i].normal.z();
    }
    std::vector<double> flux(8 * panels.size()), out(flux.size());
    reference::mean_fluxes(hull.body, targets, flux);
    test::on_every_instruction_set([&] {
        std::vector<FlowSample> samples(count);
        sum_panels(hull.body, strength, points, samples);
        CHECK(same_bits(samples, expected));
        mean_fluxes(hull.body, targets, out);
        CHECK(std::memcmp(out.data(), flux.data(), out.size() * sizeof(double)) == 0);
    });
}

TEST_CASE("the wetted hull is the mesh's part under water, whole or half, simplified or not",
          "[flow]") {
    const TriangleMesh globe = test::make_globe(1.0, 40);
    TriangleMesh shifted = globe;
    for (Vec3& v : shifted.vertices) v += Vec3(3.0, 0.2, 1.0);
    const WettedHull half = make_wetted_hull(globe, 0.0, kOwnTriangles),
                     whole = make_wetted_hull(shifted, 1.0, kOwnTriangles);
    CHECK(half.body.symmetric);
    CHECK_FALSE(whole.body.symmetric);
    CHECK(whole.volume == Near(half.volume).epsilon(1e-9));
    CHECK(half.low.isApprox(Vec3(-1, -1, -1), tolerance(1e-9)));
    CHECK(half.high.isApprox(Vec3(1, 1, 0), tolerance(1e-9)));
    const WettedHull fewer = make_wetted_hull(shifted, 1.0, {0.0, 800});
    CHECK(fewer.body.panels.size() <= 800);
    double volume = 0.0, longest = 0.0;
    for (const SourcePanel& p : fewer.body.panels) {
        volume += p.area * p.normal.dot(p.centre - Vec3(3.0, 0.2, 0.0)) / 3.0;
        for (const double l : p.length) longest = std::max(longest, l);
        for (const Vec3& c : p.corner) REQUIRE(c.z() <= 0.0);
    }
    CHECK(volume == Near(fewer.volume).epsilon(0.01));
    CHECK(longest <= fewer.longest_edge * (1.0 + tolerance(1e-12)));
    CHECK_THROWS_AS(make_wetted_hull(globe, -2.0, {}), Error);
    CHECK_THROWS_AS(make_wetted_hull(globe, 0.0, {1e-3, 4000}), Error);
}

TEST_CASE("a thin plate spoils the flow, and without its region the hull has its own", "[flow]") {
    const TriangleMesh hull = test::make_wigley(6.0, 1.2, 0.6, 12, 4);
    // a rudder 1 cm thick, 0.4 m long and 0.5 m deep, 20 cm behind the stern
    TriangleMesh rudder = test::make_box_mesh(Vec3(0.4, 0.01, 0.6));
    for (Vec3& v : rudder.vertices) v += Vec3(-3.4, 0.0, -0.2);
    TriangleMesh both = hull;
    const auto first = static_cast<std::int32_t>(hull.vertices.size());
    both.vertices.insert(both.vertices.end(), rudder.vertices.begin(), rudder.vertices.end());
    for (const auto& t : rudder.triangles)
        both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    both.region.assign(hull.triangles.size(), 0);
    both.region.resize(both.triangles.size(), 1);
    both.region_names = {"hull", "rudder"};
    const PanelSize size{0.4, 4000};
    const auto flow_of = [&](const TriangleMesh& mesh) {
        return solve_panels(make_wetted_hull(mesh, 0.0, size).body);
    };
    const std::vector<std::string> plate{"rudder"};
    const PanelFlow own = flow_of(hull), left = flow_of(without_regions(both, plate)),
                    spoilt = flow_of(both);
    CHECK(left.strength == own.strength);
    CAPTURE(own.residual, spoilt.residual);
    CHECK(spoilt.worst > 2.0 * own.worst);
    const std::vector<std::string> unknown{"keel"}, all{"hull", "rudder"};
    CHECK_THROWS_WITH(without_regions(both, unknown), Catch::Contains("hull, rudder"));
    CHECK_THROWS_AS(without_regions(both, all), Error);
}
