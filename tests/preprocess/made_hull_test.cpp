// SPDX-License-Identifier: GPL-3.0-or-later
// The made hull that benches and tests are run on is itself tested.
//
// Tolerances: 10 % is a number of triangles, which comes in rows; 4 and 1e-3 are an error of second
// order, which falls by four when edges halve.
#include <catch2/catch.hpp>
#include <map>

#include "common/geometry/mass_properties.hpp"
#include "preprocess/repair/check_solid.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("a made hull is a solid of about 27 000 m3 with the triangles asked for",
          "[support][property]") {
    const std::size_t wanted = GENERATE(1000u, 5000u, 20000u);
    const TriangleMesh hull = test::make_hull({}, wanted);
    const SolidDiagnosis diagnosis = diagnose_solid(hull);
    INFO(diagnosis.text());
    CHECK(diagnosis.good());
    CHECK(static_cast<double>(hull.triangles.size()) ==
          Near(static_cast<double>(wanted)).epsilon(0.1));
    CHECK(diagnosis.volume == Near(27000.0).epsilon(0.03));
    Eigen::AlignedBox3d box;
    for (const Vec3& v : hull.vertices) box.extend(v);
    CHECK(box.min() == Vec3(-50, -10, 0));
    CHECK(box.max() == Vec3(50, 10, 18));
}

TEST_CASE("the volume of a made hull converges with the square of its edges",
          "[support][property]") {
    std::vector<double> volumes;
    for (const std::size_t wanted : {2000u, 8000u, 32000u, 128000u})
        volumes.push_back(measure_mass(test::make_hull({}, wanted)).volume);
    const double last = volumes[3] - volumes[2];
    CHECK((volumes[2] - volumes[1]) / last == Near(4.0).margin(1.0));
    CHECK(std::abs(last) < tolerance(1e-3) * volumes[3]);
}

TEST_CASE("triangles of a made hull are well shaped and mirror images, bit for bit",
          "[support][property]") {
    const TriangleMesh hull = test::make_hull({12.0, 3.0, 2.0}, 4000);
    std::map<std::array<double, 3>, std::int32_t> places;
    for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
        const Vec3& p = hull.vertices[v];
        REQUIRE(places.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::int32_t>(v)).second);
    }
    std::map<std::array<std::int32_t, 3>, int> triangles;
    const auto turned = [](std::array<std::int32_t, 3> t) {  // smallest vertex first
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    for (const auto& t : hull.triangles) ++triangles[turned(t)];
    double quality = 0.0;
    for (std::size_t k = 0; k < hull.triangles.size(); ++k) {
        std::array<std::int32_t, 3> image;
        double edges = 0.0;
        for (int c = 0; c < 3; ++c) {
            const Vec3 p = hull.corner(k, c);
            const auto found = places.find({p.x(), p.y() == 0.0 ? 0.0 : -p.y(), p.z()});
            REQUIRE(found != places.end());
            image[static_cast<std::size_t>(2 - c)] = found->second;
            edges += (p - hull.corner(k, (c + 1) % 3)).squaredNorm();
        }
        REQUIRE(triangles[turned(image)] == 1);
        // 1 for an equilateral triangle
        const double shape = 4.0 * std::sqrt(3.0) * hull.area_vector(k).norm() / edges;
        REQUIRE(shape > 0.05);
        quality += shape;
    }
    CHECK(quality / static_cast<double>(hull.triangles.size()) > 0.8);
}
