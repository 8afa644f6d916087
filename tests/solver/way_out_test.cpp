// SPDX-License-Identifier: GPL-3.0-or-later
// The way out of a box of ice with a notch in its face towards +x.
//
// Tolerances: 1e-12 m is rounding of coordinates of a metre.
#include "solver/narrow/feature/way_out.hpp"

#include <catch2/catch.hpp>

#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

constexpr double kNotchDepth = 0.3;  // [m]

// Body 1: faces at x = +-1, y = +-1, z = +-0.2; its patch radius is 0.075 m.
struct Ice {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 4, 0.4), 0.1, 0.2, 5.0);
    std::int32_t body = static_cast<std::int32_t>(
        add_floe(w.scene, test::add_shape(w, test::make_box_set({2, 2, 0.4}, 0.05, 0.1)), 900.0,
                 Vec3::Zero(), Quaternion::Identity(), 0, true));
    const Shape& shape =
        w.scene
            .shapes[static_cast<std::size_t>(w.scene.bodies.shape[static_cast<std::size_t>(body)])];

    // crushes the face's spheres within 0.3 m of its middle line
    Ice() {
        for (std::size_t k = 0; k < shape.center.size(); ++k)
            if (shape.center[k].x() > 0.9 && std::abs(shape.center[k].y()) < 0.3)
                w.scene.crushed.crush(body, static_cast<std::int32_t>(k), shape.center.size(),
                                      {-kNotchDepth, 0, 0});
    }
    WayOut from(const Vec3& point) const {
        const Foot foot = shape.surface->closest(point);
        REQUIRE(foot.inside);
        return way_out(w.scene, body, point, foot);
    }
    // the sphere whose seat is nearest to a place
    std::int32_t sphere_at(const Vec3& place) const {
        std::int32_t nearest = 0;
        double least = 1e9;
        for (std::size_t k = 0; k < shape.center.size(); ++k) {
            const Vec3 seat = shape.center[k] + shape.radius[k] * shape.normal[k];
            if ((seat - place).norm() >= least) continue;
            least = (seat - place).norm();
            nearest = static_cast<std::int32_t>(k);
        }
        return nearest;
    }
};

}  // namespace

TEST_CASE("a point behind a notch leaves the ice at the notch's bottom", "[notch][analytic]") {
    const Ice ice;
    for (const double behind : {0.01, 0.05, 0.1}) {
        CAPTURE(behind);
        const WayOut way = ice.from({1.0 - kNotchDepth - behind, 0.02, 0.01});
        CHECK(std::abs(way.depth - behind) < tolerance(1e-12));
        CHECK((way.outward - Vec3::UnitX()).norm() < tolerance(1e-12));
        CHECK((way.foot - Vec3(1.0 - kNotchDepth, 0.02, 0.01)).norm() < tolerance(1e-12));
    }
}

TEST_CASE("a point in a notch has left the ice already", "[notch][analytic]") {
    const Ice ice;
    const WayOut way = ice.from({0.9, 0.0, 0.0});
    CHECK(std::abs(way.depth + 0.2) < tolerance(1e-12));
    CHECK((way.foot - Vec3(1.0 - kNotchDepth, 0, 0)).norm() < tolerance(1e-12));
}

TEST_CASE("far from notches a point leaves the ice at the mesh", "[notch][analytic]") {
    const Ice ice;
    const WayOut way = ice.from({0.95, 0.8, 0.0});
    CHECK(std::abs(way.depth - 0.05) < tolerance(1e-12));
    CHECK((way.foot - Vec3(1, 0.8, 0)).norm() < tolerance(1e-12));
    const WayOut up = ice.from({0.2, 0.0, 0.15});
    CHECK(std::abs(up.depth - 0.05) < tolerance(1e-12));
    CHECK((up.outward - Vec3::UnitZ()).norm() < tolerance(1e-12));
}

TEST_CASE("seats of whole spheres in a notch are gone, those at its bottom and beside it are not",
          "[notch]") {
    const Ice ice;
    const auto gone = [&](const Vec3& place) {
        return lies_in_notch(ice.w.scene, ice.body, ice.sphere_at(place));
    };
    CHECK(gone({0.85, 0, 0.2}));          // of the upper face, over the notch
    CHECK_FALSE(gone({0.4, 0, 0.2}));     // behind it
    CHECK_FALSE(gone({0.85, 0.6, 0.2}));  // beside it
    CHECK_FALSE(gone({1, 0, 0}));         // crushed itself
}
