// SPDX-License-Identifier: GPL-3.0-or-later
// What kinds of spheres decide, against the rule for two spheres.
#include "solver/narrow/kind_pair.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/kind_bound.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;

namespace {

constexpr double kReach = 0.075;  // the larger of both spheres' [m]

struct Dice {
    std::mt19937 random;
    std::uniform_real_distribution<double> unit{-1.0, 1.0};

    explicit Dice(unsigned seed) : random(seed) {}
    double operator()() { return unit(random); }
    Vec3 vector() { return {unit(random), unit(random), unit(random)}; }
    Mat3 turn() { return Eigen::AngleAxisd(3.0 * unit(random), vector().normalized()).matrix(); }
};

// A face's, edge's or corner's sphere of a block, or one that is round, turned by `turn`.
SphereSurface some_sphere(int form, const Mat3& turn, double radius) {
    const Vec3 axes[3] = {turn.col(0), turn.col(1), turn.col(2)};
    SphereSurface s{Vec3::Zero(), radius, axes[0], 1.0, 0.0};
    s.reach = 1.5 * radius;
    if (form == 0) return s;
    if (form == 3) {  // an edge that does not know its faces
        s.spread_cos = s.spread_sin = std::sqrt(0.5);
        return s;
    }
    const auto count = static_cast<std::size_t>(form + 1);
    s.normal = axes[0] + axes[1] + (count == 3 ? axes[2] : Vec3::Zero());
    s.normal.normalize();
    s.spread_cos = 1.0 / std::sqrt(static_cast<double>(count));
    s.spread_sin = std::sqrt(1.0 - s.spread_cos * s.spread_cos);
    s.faces = Faces::meeting({axes, count});
    s.faces.corner = radius / s.spread_cos;
    return s;
}

// Turned so that b's sphere about faces a's, in half of the cases exactly.
SphereSurface facing_sphere(int form, const SphereSurface& a, Dice& dice) {
    SphereSurface b = some_sphere(form, dice.turn(), 0.04);
    const Vec3 wanted = -a.normal + (dice() < 0.0 ? Vec3::Zero() : Vec3(0.8 * dice.vector()));
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(b.normal, wanted).toRotationMatrix();
    b.normal = turn * b.normal;
    b.faces = b.faces.turned(turn);
    return b;
}

}  // namespace

TEST_CASE("two spheres have the gap that their kinds give, bit for bit", "[narrow][equivalence]") {
    const int form_a = GENERATE(0, 1, 2, 3), form_b = GENERATE(0, 1, 2, 3);
    const bool prefer_a = GENERATE(false, true);
    Dice dice(static_cast<unsigned>(10 * form_a + form_b));
    int valid = 0;
    for (int k = 0; k < 400; ++k) {
        SphereSurface a = some_sphere(form_a, dice.turn(), 0.05);
        SphereSurface b = facing_sphere(form_b, a, dice);
        const SphereSurface kind_a = a, kind_b = b;
        const KindPair kinds(kind_a, kind_b, prefer_a);
        for (int place = 0; place < 10; ++place) {
            a.center = dice.vector();
            b.center = a.center + 0.09 * a.normal + 0.06 * dice.vector();
            const Gap gap = measure_gap_surface(a, b, prefer_a);
            const Gap fast = kinds.measure(a.center, b.center);
            REQUIRE(fast.valid == gap.valid);
            if (!gap.valid) continue;
            ++valid;
            REQUIRE(fast.normal == gap.normal);
            REQUIRE(fast.gap == gap.gap);
            REQUIRE(fast.lateral_sq == gap.lateral_sq);
            REQUIRE(fast.a_is_surface == gap.a_is_surface);
            REQUIRE(fast.probe_sq == gap.probe_sq);
            REQUIRE(fast.crossing == gap.crossing);
            REQUIRE(fast.edge_a == gap.edge_a);
            REQUIRE(fast.edge_b == gap.edge_b);
        }
    }
    CHECK(valid > 200);
}

TEST_CASE("no gap comes below the bound of two spheres' kinds, while the bodies keep to the leeway",
          "[narrow][property]") {
    const int form_a = GENERATE(0, 1, 2), form_b = GENERATE(0, 1, 2);
    const bool prefer_a = GENERATE(false, true);
    Dice dice(static_cast<unsigned>(100 + 10 * form_a + form_b));
    const Leeway leeway = GENERATE(Leeway{0.03, 0.015}, Leeway{0.015, 0.0075});
    int compared = 0;
    for (int k = 0; k < 3000; ++k) {
        SphereSurface a = some_sphere(form_a, dice.turn(), 0.05);
        SphereSurface b = facing_sphere(form_b, a, dice);
        b.center = 0.09 * a.normal + 0.1 * dice.vector();
        const SphereSurface kind_a = a, kind_b = b;
        KindBound bound(kind_a, kind_b, prefer_a, kReach, leeway);
        const double least = bound.least(a.center, b.center);
        // turned about its centre, as far as its points within 0.2 m allow, and moved by the rest
        const double angle = 0.99 * leeway.angle * dice();
        const Mat3 turn = Eigen::AngleAxisd(angle, dice.vector().normalized()).matrix();
        const double arm = 0.2 * std::abs(angle);
        SphereSurface later = b;
        later.center += (leeway.distance - arm) * dice() * dice.vector().normalized();
        later.normal = turn * b.normal;
        later.faces = b.faces.turned(turn);
        const double gone = (later.center - b.center).norm() + arm;
        const Gap gap = measure_gap_surface(a, later, prefer_a);
        const KindPair kinds(a, later, prefer_a);
        const Gap fast = kinds.measure(a.center, later.center);
        REQUIRE(fast.valid == gap.valid);
        REQUIRE(fast.gap == gap.gap);
        REQUIRE(fast.normal == gap.normal);
        if (!gap.valid || std::max(gap.lateral_sq, gap.probe_sq) > kReach * kReach) continue;
        ++compared;
        CAPTURE(k, least, gap.gap, gone, gap.crossing);
        // lengths of a tenth of a metre, rounded to 1e-17
        REQUIRE(gap.gap >= least - gone - 1e-15);
    }
    CHECK(compared > 100);
}

TEST_CASE("a body with a kind for each sphere has the contacts of the definition",
          "[narrow][equivalence]") {
    Dice dice(GENERATE(7u, 8u));
    SphereSet rough = test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1);
    // every face sphere leans its own way: a kind each
    for (std::size_t k = 0; k < rough.surface_count; ++k)
        if (rough.normal_spread[k] == 0.0)
            rough.normals[k] = (rough.normals[k] + 0.05 * dice.vector()).normalized();
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 0.6), 0.1, 0.15, -0.3);
    const auto box = test::add_shape(w, rough);
    REQUIRE(w.scene.shapes[static_cast<std::size_t>(box)].kinds > 128);
    for (int k = 0; k < 12; ++k)
        add_floe(w.scene, box, 900.0, Vec3(0.9 * (k % 4), 0.7 * (k / 4), -0.46 + 0.01 * dice()),
                 Quaternion(Eigen::AngleAxisd(0.1 * dice(), dice.vector().normalized())), 0, false);
    std::vector<BodyPair> pairs;
    find_pairs(w.scene, 0.01, pairs);
    ContactFinder finder;
    std::vector<Contact> found, expected;
    finder.find(w.scene, pairs, NormalRule::surface, 0.0, 0.02, found);
    for (const BodyPair& pair : pairs)
        reference::find_contacts(w.scene, pair, NormalRule::surface, 0.02, expected);
    REQUIRE(expected.size() > 200);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        REQUIRE(found[k].key == expected[k].key);
        REQUIRE(found[k].gap == expected[k].gap);
        REQUIRE(found[k].normal == expected[k].normal);
        REQUIRE(found[k].point == expected[k].point);
    }
}
