// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-12 is kRounding over a small difference.
#include "common/geometry/mass_properties.hpp"

#include <catch2/catch.hpp>

#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// rounding of sums over a few triangles
constexpr double kRounding = 1e-13;

}  // namespace

TEST_CASE("a box of 2 x 1 x 0.5 m has V = 1 m3, A = 7 m2 and I_zz = 5/12 m5", "[geometry]") {
    const MassProperties mass = measure_mass(make_box({2.0, 1.0, 0.5}, {3.0, -1.0, 2.0}));
    CHECK(mass.volume == Near(1.0).epsilon(kRounding));
    CHECK(mass.area == Near(7.0).epsilon(kRounding));
    CHECK((mass.centroid - Vec3(3.0, -1.0, 2.0)).norm() < tolerance(kRounding));
    const Mat3 expected = Vec3(1.25, 4.25, 5.0).asDiagonal().toDenseMatrix() / 12.0;
    CHECK((mass.inertia - expected).norm() < tolerance(kRounding));
}

TEST_CASE("the corner tetrahedron has V = 1/6, centroid 1/4 and I_xy = 1/480", "[geometry]") {
    TriangleMesh mesh;
    mesh.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    mesh.region.assign(4, 0);
    const MassProperties mass = measure_mass(mesh);
    CHECK(mass.volume == Near(1.0 / 6.0).epsilon(kRounding));
    CHECK((mass.centroid - Vec3::Constant(0.25)).norm() < tolerance(kRounding));
    // int x2 = 1/60, int xy = 1/120 about the corner; minus V c c^T; I_xx = int (y2 + z2)
    const double square = 1.0 / 60.0 - 1.0 / 96.0, mixed = 1.0 / 120.0 - 1.0 / 96.0;
    CHECK(mass.inertia(0, 0) == Near(2.0 * square).epsilon(1e-12));
    CHECK(mass.inertia(0, 1) == Near(-mixed).epsilon(1e-12));
    CHECK(-mixed == Near(1.0 / 480.0).epsilon(1e-12));
}

TEST_CASE("1 km from its origin a floe keeps its inertia to 1e-9", "[geometry]") {
    const Vec3 far(1000.0, -1000.0, 500.0);
    const MassProperties near = measure_mass(make_box({1.0, 0.8, 0.2}));
    const MassProperties away = measure_mass(make_box({1.0, 0.8, 0.2}, far));
    // vertices at 1 km are rounded to 1e-13 m, i.e. 1e-12 of the smallest edge
    CHECK(away.volume == Near(near.volume).epsilon(1e-9));
    CHECK((away.centroid - far).norm() < tolerance(1e-9));
    CHECK((away.inertia - near.inertia).norm() < tolerance(1e-9) * near.inertia.norm());
}

TEST_CASE("a mesh turned inside out has negative volume and the same centroid", "[geometry]") {
    TriangleMesh mesh = make_box({2.0, 1.0, 0.5}, {3.0, 0.0, 0.0});
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    const MassProperties mass = measure_mass(mesh);
    CHECK(mass.volume == Near(-1.0).epsilon(kRounding));
    CHECK((mass.centroid - Vec3(3.0, 0.0, 0.0)).norm() < tolerance(kRounding));
}

TEST_CASE("an empty mesh and a flat one give zero volume without a division by it", "[geometry]") {
    CHECK(measure_mass(TriangleMesh{}).volume == 0.0);
    TriangleMesh flat;
    flat.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::Zero()};
    flat.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 0, 3}};
    const MassProperties mass = measure_mass(flat);
    CHECK(mass.volume == 0.0);
    CHECK(mass.area == Near(1.0));
    CHECK(mass.centroid.allFinite());
}

TEST_CASE("fault_of finds nothing wrong with solids, thin or far away, and names what none has",
          "[geometry]") {
    const auto box = [](double x, double y, double z) {
        MassProperties solid;
        solid.volume = x * y * z;
        solid.area = 2.0 * (x * y + y * z + z * x);
        solid.inertia =
            solid.volume / 12.0 *
            Vec3(y * y + z * z, x * x + z * z, x * x + y * y).asDiagonal().toDenseMatrix();
        return solid;
    };
    CHECK(fault_of(box(1, 2, 3)).empty());
    CHECK(fault_of(box(100, 1, 1e-4)).empty());  // a plate: I_3 = I_1 + I_2 to 1e-12
    MassProperties bad = box(1, 2, 3);
    bad.volume = 0.0;
    CHECK(fault_of(bad) == "a volume of 0 m3");
    bad = box(1, 2, 3);
    bad.inertia(0, 0) = -1.0;
    CHECK_THAT(fault_of(bad), Catch::Contains("a moment of inertia of -1 m5"));
    // positive on the diagonal, yet not positive definite
    bad = box(1, 1, 1);
    bad.inertia(0, 1) = bad.inertia(1, 0) = 1.0;
    CHECK_THAT(fault_of(bad), Catch::Contains("a moment of inertia of -"));
    bad = box(1, 1, 1);
    bad.inertia(2, 2) *= 2.1;
    CHECK_THAT(fault_of(bad), Catch::Contains("one is above the sum of the others"));
}
