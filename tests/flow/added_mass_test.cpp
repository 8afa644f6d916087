// SPDX-License-Identifier: GPL-3.0-or-later
// Added mass from panels: closed forms, a table made apart, symmetries.
//
// Tolerances: 1.5 to 3 % are the panels' error, of first order in their edges; 1e-3 and 2e-3 are
// entries that vanish for a true sphere, of facets; 1e-9 is rounding of a change of the reference
// point.
#include "solver/flow/added_mass.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/geometry/mass_properties.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Of its edges, in the globes' own triangles.
constexpr double kOwn = 10.0;

TriangleMesh box(double length, double breadth, double height, double top) {
    TriangleMesh mesh = test::make_box_set(Vec3(length, breadth, height), 0.05, 0.1).mesh;
    for (Vec3& v : mesh.vertices) v.z() += top - 0.5 * height;
    return mesh;
}

// Diagonal over displaced mass, rotations over the box' own moments of inertia.
Eigen::Matrix<double, 6, 1> shares(const Mat6& a, double l, double b, double h, double volume) {
    Eigen::Matrix<double, 6, 1> out = a.diagonal() / volume;
    const double of_box = l * b * h / 12.0;
    out[3] = a(3, 3) / (of_box * (b * b + h * h));
    out[4] = a(4, 4) / (of_box * (l * l + h * h));
    out[5] = a(5, 5) / (of_box * (l * l + b * b));
    return out;
}

}  // namespace

TEST_CASE("a sphere in deep water moves half of its water along, and turns none",
          "[flow][analytic]") {
    const TriangleMesh globe = test::make_globe(1.0, 24), rough = test::make_globe(1.0, 12);
    const Mat6 a = added_mass(whole_body(globe, kOwn, kDeep), Vec3::Zero(), 1000.0);
    const Mat6 b = added_mass(whole_body(rough, kOwn, kDeep), Vec3::Zero(), 1000.0);
    const double displaced = 1000.0 * measure_mass(globe).volume;
    for (int axis = 0; axis < 3; ++axis) {
        // of first order or better in the edges, here 7.5 degrees of the circumference
        const double fine = a(axis, axis) / (0.5 * displaced) - 1.0;
        const double coarse = b(axis, axis) / (500.0 * measure_mass(rough).volume) - 1.0;
        CHECK(std::abs(fine) < tolerance(0.015));
        CHECK(std::abs(fine) < std::abs(coarse) / 1.6);
        CHECK(std::abs(a(axis + 3, axis + 3)) < tolerance(1e-3) * displaced);
    }
    Mat6 rest = a;
    rest.diagonal().setZero();
    CHECK(rest.cwiseAbs().maxCoeff() < tolerance(2e-3) * displaced);
}

TEST_CASE("half a sphere afloat: half of its water under a lid, and in heave under a free surface",
          "[flow][analytic]") {
    // 1.5 %: panels of this size give spheres and ellipsoids to 1 to 3 % (docs/method.md, section
    // 6). The images complete the sphere: a lid for motions along it, a free surface for heave
    const TriangleMesh globe = test::make_globe(2.0, 24);
    const ShipAddedMass ship = ship_added_mass(globe, 0.0, Vec3::Zero(), 1025.0, kOwn);
    CHECK(ship.displacement == Near(1025.0 * measure_mass(globe).volume / 2.0).epsilon(1e-9));
    for (int axis = 0; axis < 3; ++axis)
        CHECK(ship.matrix(axis, axis) == Near(0.5 * ship.displacement).epsilon(0.015));
    CHECK(ship.matrix.isApprox(ship.matrix.transpose()));
    CHECK(std::abs(ship.matrix(5, 5)) < tolerance(1e-3) * ship.displacement * 4.0);
}

TEST_CASE("an ellipsoid's added mass and inertia are Lamb's", "[flow][analytic]") {
    // a spheroid of axes 3, 1, 1: e = sqrt(8)/3, alpha = 2 (1 - e^2)/e^3 (atanh e - e),
    // beta = 1/e^2 - (1 - e^2)/e^3 atanh e (Lamb, art. 114); along the axis alpha / (2 - alpha),
    // across beta / (2 - beta); turning across the axis, of rho V (a^2 + b^2) / 5,
    // (a^2 - b^2)^2 (beta - alpha) / ((a^2 + b^2) (2 (a^2 - b^2) + (a^2 + b^2)(alpha - beta)))
    const double e2 = 8.0 / 9.0, e = std::sqrt(e2);
    const double alpha = 2.0 * (1.0 - e2) / (e * e2) * (std::atanh(e) - e);
    const double beta = 1.0 / e2 - (1.0 - e2) / (e * e2) * std::atanh(e);
    TriangleMesh mesh = test::make_globe(1.0, 28);
    for (Vec3& v : mesh.vertices) v = Vec3(3.0 * v.z(), v.y(), -v.x());
    const double volume = measure_mass(mesh).volume;
    const Mat6 a = added_mass(whole_body(mesh, kOwn, kDeep), Vec3::Zero(), 1.0);
    // facets lose 1 % of the volume; the panels' potential is to 1 % of the body's own
    CHECK(a(0, 0) / volume == Near(alpha / (2.0 - alpha)).margin(0.01));
    CHECK(a(1, 1) / volume == Near(beta / (2.0 - beta)).epsilon(0.02));
    CHECK(a(2, 2) / volume == Near(beta / (2.0 - beta)).epsilon(0.02));
    const double turning = 64.0 * (beta - alpha) / (10.0 * (16.0 + 10.0 * (alpha - beta)));
    CHECK(a(4, 4) / (volume * 10.0 / 5.0) == Near(turning).epsilon(0.03));
    CHECK(a(5, 5) / (volume * 10.0 / 5.0) == Near(turning).epsilon(0.03));
}

TEST_CASE("boxes have the added masses of a table made apart", "[flow]") {
    // Shares of the displaced mass and of the box' inertia by another panel code, with two digits;
    // 3 % is the panels' error on both sides, which falls with their edges.
    struct Row {
        double l, b, h, edge;
        double share[6];
    };
    for (const Row& row : {Row{1.0, 0.8, 0.3, 0.08, {0.30, 0.40, 1.73, 0.71, 0.85, 0.19}},
                           Row{8.0, 5.0, 1.0, 0.6, {0.16, 0.27, 3.35, 1.50, 2.00, 0.16}}}) {
        const PanelBody body = whole_body(box(row.l, row.b, row.h, -10.0 * row.l), row.edge, kDeep);
        const Vec3 centre(0, 0, -10.0 * row.l - 0.5 * row.h);
        const auto got =
            shares(added_mass(body, centre, 1.0), row.l, row.b, row.h, row.l * row.b * row.h);
        for (int k = 0; k < 6; ++k) {
            CAPTURE(row.l, k);
            CHECK(got[k] == Near(row.share[k]).epsilon(0.03));
        }
    }
}

TEST_CASE("a lid makes a floating box heavier to push, a free surface lighter", "[flow]") {
    const TriangleMesh mesh = box(1.0, 0.8, 0.27, 0.0);
    const auto with = [&](double image) {
        // the wetted part without the face in the water
        PanelBody body = whole_body(mesh, 0.12, image);
        std::erase_if(body.panels, [](const SourcePanel& p) { return p.centre.z() > -1e-9; });
        return shares(added_mass(body, Vec3(0, 0, -0.135), 1.0), 1.0, 0.8, 0.27, 0.8 * 0.27);
    };
    const auto lid = with(kLid), free = with(kFreeSurface);
    CHECK(lid[0] > 1.8 * free[0]);
    CHECK(lid[1] > 1.8 * free[1]);
    CHECK(lid[2] > 1.2 * free[2]);
}

TEST_CASE("added mass is positive, moves with its reference point, and refuses what it cannot do",
          "[flow][property]") {
    TriangleMesh mesh = test::make_wigley(6.0, 1.2, 0.6, 12, 4);
    const ShipAddedMass at_keel = ship_added_mass(mesh, 0.0, Vec3(0, 0, -0.6), 1.0);
    const Vec3 shift(0.5, 0.0, 0.0);
    const ShipAddedMass ahead = ship_added_mass(mesh, 0.0, Vec3(0, 0, -0.6) + shift, 1.0);
    CHECK(at_keel.panels > 100);
    const Eigen::SelfAdjointEigenSolver<Mat6> values(at_keel.matrix);
    CHECK(values.eigenvalues().minCoeff() > -tolerance(1e-6) * values.eigenvalues().maxCoeff());
    // v at the old point is v + w x (-shift) at the new one
    const double sway = at_keel.matrix(1, 1), coupled = at_keel.matrix(1, 5);
    CHECK(ahead.matrix(1, 5) == Near(coupled - 0.5 * sway).margin(1e-9 * sway));
    CHECK(ahead.matrix(5, 5) ==
          Near(at_keel.matrix(5, 5) - 2.0 * 0.5 * coupled + 0.25 * sway).epsilon(1e-9));
    CHECK(ahead.matrix(0, 0) == Near(at_keel.matrix(0, 0)).epsilon(1e-12));
    CHECK_THROWS_AS(ship_added_mass(mesh, -2.0, Vec3::Zero(), 1.0), Error);
    CHECK_THROWS_AS(whole_body(mesh, 1e-3, kDeep), Error);
}
