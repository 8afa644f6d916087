// SPDX-License-Identifier: GPL-3.0-or-later
// The section that a face cuts from the piece of surface a sphere stands for.
//
// Tolerances: kTouch counts a face that far early; 1e-15 and 1e-14 are rounding of a product, 1e-12
// that of a sum of many parts.
#include "solver/narrow/manifold/patch.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "common/base/units.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kSide = 0.1;    // of a sphere's share of a face [m]
constexpr double kTouch = 1e-4;  // faces this close count as touching [m]
constexpr double kFloor = 0.05;  // of a patch that stands upright

// A square of side kSide that leans by `lean`; its foot is in its middle.
Patch flat_patch(double lean) {
    Patch patch;
    patch.share = kSide * kSide;
    patch.facing = std::cos(lean);
    patch.wing = wing_length(0.05, patch.share, 1.0, 0.0);
    return patch;
}

// Length kSide of an edge whose faces are turned by +-spread from its middle normal.
Patch roof_patch(double spread, double lean) {
    const double wing = 0.05 * std::tan(spread) + 0.5 * kSide;
    Patch patch;
    patch.share = 2.0 * wing * kSide;
    patch.facing = std::cos(lean);
    patch.spread_cos = std::cos(spread);
    patch.spread_sin = std::sin(spread);
    patch.wing = wing_length(0.05, patch.share, patch.spread_cos, patch.spread_sin);
    return patch;
}

// Share of a wing of unit length, going down at `angle`, that lies above the face, strip by strip.
double cut_share(double angle, const Patch& patch, double depth) {
    constexpr int kStrips = 1000;
    int cut = 0;
    for (int k = 0; k < kStrips; ++k)
        cut += patch.foot + (k + 0.5) / kStrips * patch.wing * std::sin(angle) <= depth;
    return static_cast<double>(cut) / kStrips;
}

}  // namespace

TEST_CASE("a wing is as long as its face's half spacing and the way to the point of touch",
          "[narrow][patch][analytic]") {
    CHECK(flat_patch(0.0).wing == Near(0.5 * kSide).epsilon(1e-14));
    CHECK(roof_patch(45.0 * kDegree, 0.0).wing == Near(0.05 + 0.5 * kSide).epsilon(1e-14));
}

TEST_CASE("a flat patch counts whole at the first touch", "[narrow][patch][analytic]") {
    const Patch patch = flat_patch(0.0);
    for (const double depth : {-0.01, 0.0, 1e-6, 0.01, 1.0})
        CHECK(cut_area(patch, depth) == Near(kSide * kSide).epsilon(1e-15));
}

TEST_CASE("a leaning flat patch grows linearly to its whole projected area",
          "[narrow][patch][analytic]") {
    const double lean = 20.0 * kDegree;
    Patch patch = flat_patch(lean);
    // the support is the patch's lowest side, half of it below its middle
    const double height = kSide * std::sin(lean), whole = kSide * kSide * std::cos(lean);
    patch.foot = 0.5 * height;
    for (const double part : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 3.0}) {
        CAPTURE(part);
        // each half is a touch early or late
        CHECK(cut_area(patch, part * height) ==
              Near(std::min(part, 1.0) * whole).margin(kTouch / height * whole));
    }
}

TEST_CASE("a roof gives its width at the depth until its wings end", "[narrow][patch][analytic]") {
    const double lean = kDegree * GENERATE(0.0, 10.0, 20.0, -20.0);
    const double spread = 45.0 * kDegree;
    const Patch patch = roof_patch(spread, lean);
    const double steep = spread + std::abs(lean), shallow = spread - std::abs(lean);
    const double end = patch.wing * std::sin(shallow);  // where the less steep wing is all cut
    const double width = 1.0 / std::tan(steep) + 1.0 / std::tan(shallow);
    for (const double part : {0.0, 0.1, 0.5, 0.9}) {
        CAPTURE(lean / kDegree, part);
        const double section = kSide * part * end * width;
        CHECK(cut_area(patch, part * end) == Near(section).margin(kSide * kTouch * width));
    }
    // and beyond both wings the whole projected area
    const double whole = patch.share * std::cos(spread) * std::cos(lean);
    CHECK(cut_area(patch, patch.wing) == Near(whole).epsilon(1e-14));
    CHECK(cut_area(patch, 10.0) == Near(whole).epsilon(1e-14));
}

TEST_CASE("a square roof's whole section is the depth it was cut, twice",
          "[narrow][patch][analytic]") {
    const Patch patch = roof_patch(45.0 * kDegree, 0.0);
    CHECK(cut_area(patch, 0.03) == Near(2.0 * 0.03 * kSide).margin(2.0 * kTouch * kSide));
}

TEST_CASE("an upright patch keeps its twentieth, and so does one that faces backwards",
          "[narrow][patch][analytic]") {
    const Patch patch = flat_patch(kDegree * GENERATE(90.0, 120.0, 180.0));
    CHECK(cut_area(patch, patch.wing) == Near(kFloor * patch.share).epsilon(1e-12));
    const double half = 0.5 * (patch.wing - kTouch);
    CHECK(cut_area(patch, half) == Near(0.5 * kFloor * patch.share).epsilon(1e-12));
}

TEST_CASE("no patch gives more than its projected area, and more depth never less",
          "[narrow][patch][property]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 2000; ++k) {
        Patch patch = roof_patch(89.0 * kDegree * unit(random), 180.0 * kDegree * unit(random));
        patch.foot = 0.05 * unit(random) * unit(random);
        const double whole = patch.share * patch.spread_cos * patch.facing;
        const double most = std::max(whole, kFloor * patch.share);
        double before = 0.0;
        for (int n = 0; n <= 50; ++n) {
            const double area = cut_area(patch, 0.02 * n * (patch.wing + patch.foot));
            REQUIRE(area <= most * (1.0 + tolerance(1e-14)));
            REQUIRE(area >= before * (1.0 - tolerance(1e-14)));
            before = area;
        }
        REQUIRE(before == Near(most).epsilon(1e-12));  // all of it in the end
    }
}

TEST_CASE("the section is that of two wings cut strip by strip", "[narrow][patch][equivalence]") {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 500; ++k) {
        const double spread = 60.0 * kDegree * unit(random);
        const double lean = (89.0 * kDegree - spread) * unit(random);  // no wing faces backwards
        Patch patch = roof_patch(spread, lean);
        patch.foot = 0.02 * unit(random);
        const double depth = 0.1 * unit(random);
        const double away = spread + lean, other = spread - lean;
        const double section = 0.5 * patch.share *
                               (std::cos(away) * cut_share(away, patch, depth) +
                                std::cos(other) * cut_share(other, patch, depth));
        // the touch on either wing, and a strip of each
        const auto off = [&](double angle) {
            return std::cos(angle) *
                   (kTouch / (patch.wing * std::abs(std::sin(angle)) + kTouch) + 1.0 / 1000.0);
        };
        const double margin = 0.5 * patch.share * (off(away) + off(other));
        const double floor =
            kFloor * patch.share * std::min(1.0, (depth + kTouch) / (patch.wing + kTouch));
        CAPTURE(spread / kDegree, lean / kDegree, depth, patch.foot);
        REQUIRE(cut_area(patch, depth) == Near(std::max(section, floor)).margin(margin));
    }
}
