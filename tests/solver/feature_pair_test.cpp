// SPDX-License-Identifier: GPL-3.0-or-later
// Feature types against the rule for two spheres.
#include "solver/narrow/feature/feature_pair.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/feature/edge_crossings.hpp"
#include "solver/narrow/feature/feature_pair_bound.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

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
Feature some_sphere(int feature, const Mat3& turn, double radius) {
    const Vec3 axes[3] = {turn.col(0), turn.col(1), turn.col(2)};
    Feature s{Vec3::Zero(), radius, axes[0], 1.0, 0.0};
    s.patch_radius = 1.5 * radius;
    if (feature == 0) return s;
    if (feature == 3) {  // an edge that does not know its faces
        s.spread_cos = s.spread_sin = std::sqrt(0.5);
        return s;
    }
    const auto count = static_cast<std::size_t>(feature + 1);
    s.normal = axes[0] + axes[1] + (count == 3 ? axes[2] : Vec3::Zero());
    s.normal.normalize();
    s.spread_cos = 1.0 / std::sqrt(static_cast<double>(count));
    s.spread_sin = std::sqrt(1.0 - s.spread_cos * s.spread_cos);
    s.cone = NormalCone::meeting({axes, count});
    s.cone.apex_distance = radius / s.spread_cos;
    return s;
}

// Turned so that b's sphere about faces a's, in half of the cases exactly.
Feature facing_sphere(int feature, const Feature& a, Dice& dice) {
    Feature b = some_sphere(feature, dice.turn(), 0.04);
    const Vec3 wanted = -a.normal + (dice() < 0.0 ? Vec3::Zero() : Vec3(0.8 * dice.vector()));
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(b.normal, wanted).toRotationMatrix();
    b.normal = turn * b.normal;
    b.cone = b.cone.turned(turn);
    return b;
}

}  // namespace

TEST_CASE("two spheres have the gap of their feature types, bit for bit", "[narrow][equivalence]") {
    const int feature_a = GENERATE(0, 1, 2, 3), feature_b = GENERATE(0, 1, 2, 3);
    const bool prefer_reference_a = GENERATE(false, true);
    Dice dice(static_cast<unsigned>(10 * feature_a + feature_b));
    int valid = 0;
    for (int k = 0; k < 400; ++k) {
        Feature a = some_sphere(feature_a, dice.turn(), 0.05);
        Feature b = facing_sphere(feature_b, a, dice);
        const Feature type_a = a, type_b = b;
        const FeaturePair pair(type_a, type_b, prefer_reference_a);
        for (int place = 0; place < 10; ++place) {
            a.center = dice.vector();
            b.center = a.center + 0.09 * a.normal + 0.06 * dice.vector();
            const Gap gap = measure_gap_surface(a, b, prefer_reference_a);
            const Gap fast = pair.measure(a.center, b.center);
            REQUIRE(fast.valid == gap.valid);
            if (!gap.valid) continue;
            ++valid;
            REQUIRE(fast.normal == gap.normal);
            REQUIRE(fast.gap == gap.gap);
            REQUIRE(fast.reference_offset_sq == gap.reference_offset_sq);
            REQUIRE(fast.reference_is_a == gap.reference_is_a);
            REQUIRE(fast.incident_offset_sq == gap.incident_offset_sq);
            REQUIRE(fast.crossing == gap.crossing);
            REQUIRE(fast.edge_a == gap.edge_a);
            REQUIRE(fast.edge_b == gap.edge_b);
        }
    }
    CHECK(valid > 200);
}

TEST_CASE("edges that are excluded have a cross product that is in neither cone",
          "[narrow][equivalence]") {
    Dice dice(31);
    int excluded = 0, outside = 0;
    for (int k = 0; k < 100000; ++k) {
        // edges and vertices, blunt, sharp and slender ones, turned either way round
        const auto some_cone = [&](std::size_t count) {
            const double spread = 0.1 + 0.9 * std::abs(dice());
            const Vec3 middle = dice.vector().normalized();
            std::array<Vec3, 3> normals;
            for (Vec3& n : normals) n = (middle + spread * dice.vector()).normalized();
            return NormalCone::meeting({normals.data(), count});
        };
        const NormalCone a = some_cone(k % 2 == 0 ? 2 : 3), b = some_cone(k % 4 < 2 ? 2 : 3);
        const double slack = k % 3 == 0 ? 0.0 : 0.03 * std::abs(dice());
        std::array<std::array<bool, 3>, 3> found{};
        for_each_crossing(a, b, slack, [&](int edge_a, int edge_b) {
            found[static_cast<std::size_t>(edge_a)][static_cast<std::size_t>(edge_b)] = true;
        });
        for (int edge_a = 0; edge_a < a.edges(); ++edge_a)
            for (int edge_b = 0; edge_b < b.edges(); ++edge_b) {
                const Vec3 across = a.edge(edge_a).cross(b.edge(edge_b));
                const double sine = across.norm();
                const auto of_a = a.contains_either_sign(across / sine, 0.022, slack / sine);
                const auto of_b = b.contains_either_sign(across / sine, 0.022, slack / sine);
                const bool is_axis = (of_a.forth && of_b.back) || (of_a.back && of_b.forth);
                const bool excludes =
                    !found[static_cast<std::size_t>(edge_a)][static_cast<std::size_t>(edge_b)];
                outside += is_axis ? 0 : 1;
                excluded += excludes ? 1 : 0;
                CAPTURE(k, edge_a, edge_b, slack, sine);
                if (excludes) REQUIRE_FALSE(is_axis);
            }
    }
    CHECK(2 * excluded > outside);  // and most of them are
}

TEST_CASE("no gap comes below the bound of two feature types within the skin",
          "[narrow][property]") {
    const int feature_a = GENERATE(0, 1, 2), feature_b = GENERATE(0, 1, 2);
    const bool prefer_reference_a = GENERATE(false, true);
    Dice dice(static_cast<unsigned>(100 + 10 * feature_a + feature_b));
    const Skin skin = GENERATE(Skin{0.03, 0.015}, Skin{0.015, 0.0075});
    int compared = 0;
    for (int k = 0; k < 3000; ++k) {
        Feature a = some_sphere(feature_a, dice.turn(), 0.05);
        Feature b = facing_sphere(feature_b, a, dice);
        b.center = 0.09 * a.normal + 0.1 * dice.vector();
        const Feature type_a = a, type_b = b;
        FeaturePairBound bound(type_a, type_b, prefer_reference_a, kReach, skin);
        const double least = bound.least(a.center, b.center);
        // turned about its centre, as far as its points within 0.2 m allow, and moved by the rest
        const double angle = 0.99 * skin.angle * dice();
        const Mat3 turn = Eigen::AngleAxisd(angle, dice.vector().normalized()).matrix();
        const double arm = 0.2 * std::abs(angle);
        Feature later = b;
        later.center += (skin.distance - arm) * dice() * dice.vector().normalized();
        later.normal = turn * b.normal;
        later.cone = b.cone.turned(turn);
        const double gone = (later.center - b.center).norm() + arm;
        const Gap gap = measure_gap_surface(a, later, prefer_reference_a);
        const FeaturePair pair(a, later, prefer_reference_a);
        const Gap fast = pair.measure(a.center, later.center);
        REQUIRE(fast.valid == gap.valid);
        REQUIRE(fast.gap == gap.gap);
        REQUIRE(fast.normal == gap.normal);
        if (!gap.valid ||
            std::max(gap.reference_offset_sq, gap.incident_offset_sq) > kReach * kReach)
            continue;
        ++compared;
        CAPTURE(k, least, gap.gap, gone, gap.crossing);
        // lengths of a tenth of a metre, rounded to 1e-17
        REQUIRE(gap.gap >= least - gone - tolerance(1e-15));
    }
    CHECK(compared > 100);
}

TEST_CASE("a body with a feature type for each sphere has the contacts of the definition",
          "[narrow][equivalence]") {
    Dice dice(GENERATE(7u, 8u));
    SphereSet rough = test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1);
    // every face sphere leans in its own direction: a type each
    for (std::size_t k = 0; k < rough.surface_count; ++k)
        if (rough.normal_spread[k] == 0.0)
            rough.normals[k] = (rough.normals[k] + 0.05 * dice.vector()).normalized();
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 0.6), 0.1, 0.15, -0.3);
    const auto box = test::add_shape(w, rough);
    REQUIRE(w.scene.shapes[static_cast<std::size_t>(box)].feature_types > 128);
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
