// SPDX-License-Identifier: GPL-3.0-or-later
// Notches of tiles that go, in the ice that takes their place.
//
// Tolerances: 1e-12 m is rounding of coordinates of some metres.
#include "solver/live_edge/carried_notches.hpp"

#include <catch2/catch.hpp>

#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

constexpr double kNotch = 0.3;    // [m], in the face towards +x
constexpr double kSpacing = 0.1;  // of the spheres [m]: their patch radius is 0.075 m

// Boxes of ice beside each other; body 1 is the tile that goes, with a notch in its face at x = 1.
struct Tiles {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 4, 0.4), 0.1, 0.2, 5.0);
    CarriedNotches notches;

    std::int32_t add(const Vec3& size, const Vec3& at) {
        const auto shape = test::add_shape(w, test::make_box_set(size, 0.05, kSpacing));
        return static_cast<std::int32_t>(
            add_floe(w.scene, shape, 900.0, at, Quaternion::Identity(), 0, true));
    }
    const Shape& shape_of(std::int32_t body) const {
        return w.scene
            .shapes[static_cast<std::size_t>(w.scene.bodies.shape[static_cast<std::size_t>(body)])];
    }
    Vec3 place_of(std::int32_t body, std::size_t k) const {
        return w.scene.bodies.position[static_cast<std::size_t>(body)] + shape_of(body).center[k];
    }
    static bool is_crushed(const Vec3& at) { return at.x() > 0.9 && std::abs(at.y()) < 0.3; }

    Tiles() {
        const std::int32_t tile = add({2, 2, 0.4}, Vec3::Zero());
        const std::size_t count = shape_of(tile).center.size();
        for (std::size_t k = 0; k < count; ++k)
            if (is_crushed(place_of(tile, k)))
                w.scene.crushed.crush(tile, static_cast<std::int32_t>(k), count, {-kNotch, 0, 0});
        notches.take(w.scene, tile);
    }
};

}  // namespace

TEST_CASE("ice of the same shape has the same notch", "[live_edge][level_ice][edge][analytic]") {
    Tiles t;
    const std::int32_t same = t.add({2, 2, 0.4}, Vec3::Zero());
    t.notches.give(t.w.scene, same);
    for (std::int32_t k = 0; k < std::ssize(t.shape_of(same).center); ++k)
        REQUIRE(t.w.scene.crushed.displacement_of(same, k) ==
                t.w.scene.crushed.displacement_of(1, k));
    CHECK(t.w.scene.crushed.deepest_of(same) == kNotch);
}

TEST_CASE("of a notch that the new outline is cut back by, the rest is left",
          "[live_edge][level_ice][edge][analytic]") {
    // the face is at x = 0.8, a third of the notch is left
    Tiles t;
    const std::int32_t cut = t.add({1.8, 2, 0.4}, {-0.1, 0, 0});
    t.notches.give(t.w.scene, cut);
    std::size_t crushed = 0;
    for (std::size_t k = 0; k < t.shape_of(cut).center.size(); ++k) {
        const Vec3 at = t.place_of(cut, k);
        const Vec3 move = t.w.scene.crushed.displacement_of(cut, static_cast<std::int32_t>(k));
        CAPTURE(at);
        // spheres whose centres are 0.05 m behind the face; beyond the notch's sides is a patch
        // radius that either rule would do for
        if (at.x() > 0.7 && std::abs(at.y()) < 0.2) {
            CHECK((move - Vec3(-kNotch + 0.2, 0, 0)).norm() < tolerance(1e-12));
            ++crushed;
        }
        if (std::abs(at.y()) > 0.4 || at.x() < 0.5) CHECK(move == Vec3::Zero());
    }
    CHECK(crushed > 10);
}

TEST_CASE("ice cut back to the bottom of a notch, and the face of a crack, are whole",
          "[live_edge][level_ice][edge][analytic]") {
    Tiles t;
    // faces at x = 0.7, where the notch ends, and at x = 0
    const std::int32_t cut = t.add({1.7, 2, 0.4}, {-0.15, 0, 0}),
                       broken = t.add({1, 2, 0.4}, {-0.5, 0, 0});
    t.notches.give(t.w.scene, cut);
    t.notches.give(t.w.scene, broken);
    CHECK(t.w.scene.crushed.is_whole(cut));
    CHECK(t.w.scene.crushed.is_whole(broken));
}

TEST_CASE("a crack through a notch has no ice in it", "[live_edge][level_ice][edge][analytic]") {
    // two halves with faces at y = 0: these end at the bottom of the notch
    Tiles t;
    const std::int32_t left = t.add({2, 1, 0.4}, {0, 0.5, 0});
    t.notches.give(t.w.scene, left);
    std::size_t moved = 0;
    for (std::size_t k = 0; k < t.shape_of(left).center.size(); ++k) {
        const Vec3 at = t.place_of(left, k);
        if (at.y() > 0.1 || at.x() < 0.7) continue;
        const Vec3 now = at + t.w.scene.crushed.displacement_of(left, static_cast<std::int32_t>(k));
        CHECK(now.x() < 1.0 - kNotch);
        ++moved;
    }
    CHECK(moved > 5);
}

TEST_CASE("tiles without notches leave whole ice", "[live_edge][level_ice][edge]") {
    Tiles t;
    CarriedNotches none;
    none.give(t.w.scene, t.add({2, 2, 0.4}, Vec3::Zero()));
    const std::int32_t whole = t.add({2, 2, 0.4}, Vec3::Zero());
    none.take(t.w.scene, whole);
    const std::int32_t next = t.add({2, 2, 0.4}, Vec3::Zero());
    none.give(t.w.scene, next);
    CHECK(t.w.scene.crushed.is_whole(next));
}
