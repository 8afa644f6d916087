// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over wetted surfaces: bits on every instruction set, fill without weight, a slow twin.
//
// Tolerances: 1e-13 of the largest sum is rounding over some hundred triangles, 1e-16 each.
#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "solver/water/drag.hpp"
#include "solver/water/hydrostatics.hpp"
#include "solver/water/wetted_sums.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;
using test::same_bits;

namespace {

using test::Dice;

Mat3 any_turn(Dice& dice) {
    const double angle = 3.0 * dice.number();
    return Eigen::AngleAxisd(angle, dice.vector().normalized()).matrix();
}

// Triangles of up to a metre that belong to no body: the sums ask for none.
std::vector<Facet> loose_facets(std::size_t count, Dice& dice) {
    std::vector<Facet> out;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 at = dice.vector();
        out.push_back(make_facet(at, at + 0.5 * dice.vector(), at + 0.5 * dice.vector()));
    }
    return out;
}

template <class T>
void append(const T& from, std::vector<double>& to) {
    for (int k = 0; k < from.size(); ++k) to.push_back(from[k]);
}

// All that the kernels say of these facets.
template <class Integrate, class Sum, class SumEven>
std::vector<double> all_sums(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                             const Vec3& w, const Integrate& integrate, const Sum& sum,
                             const SumEven& sum_even) {
    const WettedIntegrals wet = integrate(facets, water);
    const FacingIntegrals facing = sum(facets, water, v, w);
    std::vector<double> out{wet.volume, double(wet.any_wet), double(wet.any_dry), facing.flow,
                            sum_even(facets, water, v)};
    for (const Vec3& values : {wet.first, facing.first, facing.square, facing.mixed})
        append(values, out);
    return out;
}

using SumWithTurn = FacingIntegrals(const FacetBlocks&, const WaterPlane&, const Vec3&,
                                    const Vec3&);
using SumWithout = double(const FacetBlocks&, const WaterPlane&, const Vec3&);

std::vector<double> by_kernel(const FacetBlocks& p, const WaterPlane& water, const Vec3& v,
                              const Vec3& w) {
    return all_sums(p, water, v, w, integrate_wetted, static_cast<SumWithTurn*>(integrate_facing),
                    static_cast<SumWithout*>(integrate_facing));
}
std::vector<double> by_reference(const FacetBlocks& p, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w) {
    return all_sums(p, water, v, w, reference::integrate_wetted,
                    static_cast<SumWithTurn*>(reference::integrate_facing),
                    static_cast<SumWithout*>(reference::integrate_facing));
}

// A closed body with dents: a box whose corners are moved.
Shape lumpy_shape(Dice& dice) {
    SphereSet set = test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1);
    for (Vec3& v : set.mesh.vertices) v += 0.1 * dice.vector();
    set.solid = measure_mass(set.mesh);
    return build_shape(set, true);
}

// The slow twin: the part of a triangle below z = 0, corner by corner (Sutherland-Hodgman).
std::vector<Vec3> clip(const std::array<Vec3, 3>& corner) {
    std::vector<Vec3> wet;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = corner[k], &q = corner[(k + 1) % 3];
        if (p.z() <= 0.0) wet.push_back(p);
        if (p.z() * q.z() < 0.0) wet.push_back(p + (q - p) * (p.z() / (p.z() - q.z())));
    }
    return wet;
}

// Tetrahedra between the wetted triangles and a point of the water plane fill the wetted body.
Submerged clip_body(const Shape& shape, const Mat3& rotation, double height) {
    Submerged out;
    const Vec3 lift(0.0, 0.0, height);
    Vec3 first = Vec3::Zero();
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
        std::array<Vec3, 3> corner;
        for (int k = 0; k < 3; ++k)
            corner[std::size_t(k)] = rotation * shape.mesh.corner(t, k) + lift;
        const std::vector<Vec3> wet = clip(corner);
        for (std::size_t k = 2; k < wet.size(); ++k) {
            const double volume = wet[0].dot(wet[k - 1].cross(wet[k])) / 6.0;
            out.volume += volume;
            first += 0.25 * volume * (wet[0] + wet[k - 1] + wet[k]);
        }
    }
    out.centre = first / out.volume - lift;
    return out;
}

}  // namespace

TEST_CASE("every instruction set sums wetted facets to the bits of the reference",
          "[water][simd]") {
    const std::size_t count = GENERATE(0u, 1u, 2u, 3u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 300u);
    Dice dice{std::mt19937(static_cast<unsigned>(count))};
    const FacetBlocks facets(loose_facets(count, dice));
    for (const double height : {-4.0, -1.3, -0.2, 0.0, 0.4, 1.3, 4.0}) {
        const WaterPlane water(any_turn(dice), height);
        const Vec3 v = dice.vector(), w = dice.vector();
        const auto expected = by_reference(facets, water, v, w);
        if (count > 8 && std::abs(height) < 1.0) {  // or nothing is compared
            REQUIRE(expected[0] != 0.0);
            REQUIRE(expected[3] > 0.0);
        }
        test::on_every_instruction_set(
            [&] { CHECK(same_bits(by_kernel(facets, water, v, w), expected)); });
    }
}

TEST_CASE("every instruction set has the bits for edges and faces level with the water",
          "[water][simd]") {
    const Shape shape = build_shape(test::make_box_set(Vec3(1, 0.75, 0.25), 0.05, 0.1), true);
    const Mat3 upright = Mat3::Identity();
    const double height = GENERATE(-0.125, 0.125, 0.0, 1e-160, -1e-160);
    const WaterPlane water(upright, height);
    const Vec3 v = GENERATE(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, 0)), w(0, 0.5, 0);
    const auto expected = by_reference(shape.facets, water, v, w);
    for (const double value : expected) CHECK(std::isfinite(value));
    test::on_every_instruction_set(
        [&] { CHECK(same_bits(by_kernel(shape.facets, water, v, w), expected)); });
}

TEST_CASE("the fill of the last block adds exactly nothing", "[water][property]") {
    Dice dice{std::mt19937(3)};
    std::vector<Facet> facets = loose_facets(9, dice);
    const FacetBlocks filled(facets);
    CHECK(filled.size() == 9);
    CHECK(filled.blocks.size() == 2);
    while (facets.size() < 16)
        facets.push_back(make_facet(dice.vector(), Vec3::Ones(), Vec3::Zero()));
    FacetBlocks other(facets);
    for (std::size_t lane = 1; lane < 8; ++lane)
        for (int d = 0; d < 3; ++d) other.blocks[1].area[d][lane] = 0.0;
    const WaterPlane water(any_turn(dice), 0.1);
    const Vec3 v = dice.vector(), w = dice.vector();
    CHECK(same_bits(by_kernel(filled, water, v, w), by_kernel(other, water, v, w)));
}

TEST_CASE("blocks read as the facets they were made of", "[water][property]") {
    Dice dice{std::mt19937(4)};
    const std::vector<Facet> facets = loose_facets(11, dice);
    std::size_t k = 0;
    for (const Facet& facet : FacetBlocks(facets)) {
        CHECK(facet.area == facets[k].area);
        for (int c = 0; c < 3; ++c) CHECK(facet.corner[c] == facets[k].corner[c]);
        ++k;
    }
    CHECK(k == 11);
}

TEST_CASE("the submerged part is that of the body cut triangle by triangle", "[water][property]") {
    Dice dice{std::mt19937(5)};
    for (int k = 0; k < 100; ++k) {
        const Shape shape = lumpy_shape(dice);
        const Mat3 turn = any_turn(dice);
        const double height = 0.2 * dice.unit(dice.random);
        const Submerged expected = clip_body(shape, turn, height);
        const Submerged s = measure_submerged(shape, turn, height);
        // a few hundred roundings of moments of the size of the whole body
        const double slack = tolerance(1e-13) * shape.solid.volume;
        CHECK(std::abs(s.volume - expected.volume) < slack);
        if (expected.volume > slack)
            CHECK((s.centre - expected.centre).norm() * expected.volume < slack);
    }
}

// The slow twin: each triangle cut by the water and where the flow comes along it, corner by
// corner, and a rule that is exact for cubics on what is left, in world axes.
struct Loads {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double size = 0.0;
};
Loads drag_by_clipping(const Shape& shape, const Motion& motion) {
    Loads out;
    const Vec3 lift(0.0, 0.0, motion.height);
    for (const Facet& facet : shape.facets) {
        const Vec3 normal = (motion.rotation * facet.area).normalized();
        const auto velocity = [&](const Vec3& r) {
            return Vec3(motion.velocity + motion.angular_velocity.cross(r));
        };
        std::vector<Vec3> part(3);
        for (std::size_t k = 0; k < 3; ++k) part[k] = motion.rotation * facet.corner[k];
        const auto keep = [&](const auto& value) {  // where it is at most 0
            std::vector<Vec3> kept;
            for (std::size_t k = 0; k < part.size(); ++k) {
                const Vec3 &p = part[k], &q = part[(k + 1) % part.size()];
                const double at_p = value(p), at_q = value(q);
                if (at_p <= 0.0) kept.push_back(p);
                if (at_p * at_q < 0.0) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
            }
            part = kept;
        };
        keep([&](const Vec3& r) { return (r + lift).z(); });
        keep([&](const Vec3& r) { return -normal.dot(velocity(r)); });
        for (std::size_t k = 2; k < part.size(); ++k) {
            const Vec3 &a = part[0], &b = part[k - 1], &c = part[k];
            const double area = 0.5 * (b - a).cross(c - a).norm();
            const auto add = [&](double weight, const Vec3& r) {
                const Vec3 u = velocity(r);
                const Vec3 load = -0.5 * 1000.0 * weight * area * std::max(0.0, normal.dot(u)) * u;
                out.force += load;
                out.moment += r.cross(load);
                out.size += load.norm();
            };
            // corners 1/20, middles of the edges 2/15, the middle 9/20
            for (const Vec3& r : {a, b, c}) add(1.0 / 20.0, r);
            for (const Vec3& r : {Vec3(a + b), Vec3(b + c), Vec3(c + a)}) add(2.0 / 15.0, 0.5 * r);
            add(9.0 / 20.0, (a + b + c) / 3.0);
        }
    }
    return out;
}

TEST_CASE("panel drag is the integral over the wetted surface that the flow meets",
          "[water][property]") {
    Dice dice{std::mt19937(6)};
    int loaded = 0;
    for (int k = 0; k < 100; ++k) {
        const Shape shape = lumpy_shape(dice);
        const Mat3 turn = any_turn(dice);
        const Vec3 v = dice.vector(), w = 3.0 * dice.vector();
        const Motion motion{turn, 0.2 * dice.unit(dice.random), v, w};
        const Loads expected = drag_by_clipping(shape, motion);
        const WaterLoad load = panel_drag(shape, motion, 1.0, 1000.0);
        // a few hundred roundings of parts no larger than whole triangles; lengths within a metre
        const double slack =
            tolerance(1e-13) * 1000.0 * shape.solid.area * std::pow(v.norm() + w.norm(), 2);
        CHECK((load.force - expected.force).norm() <= slack);
        CHECK((load.moment - expected.moment).norm() <= slack);
        loaded += expected.size > 1e6 * slack;
    }
    CHECK(loaded > 90);  // the others hardly touch the water
}

TEST_CASE("a mirror image's drag is the mirror image, however the triangles lie",
          "[water][property]") {
    // the box's diagonals do not lie symmetric about y = 0
    Dice dice{std::mt19937(8)};
    const Shape shape = build_shape(test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1), true);
    const Vec3 flip(1, -1, 1);
    for (int k = 0; k < 100; ++k) {
        const Mat3 turn = any_turn(dice), turned = flip.asDiagonal() * turn * flip.asDiagonal();
        const Vec3 v = dice.vector(), w = 3.0 * dice.vector();
        const double height = 0.2 * dice.unit(dice.random);
        const WaterLoad port = panel_drag(shape, {turn, height, v, w}, 1.0, 1000.0);
        const WaterLoad starboard =
            panel_drag(shape, {turned, height, flip.cwiseProduct(v), Vec3(-flip.cwiseProduct(w))},
                       1.0, 1000.0);
        // a few hundred roundings of parts no larger than whole triangles; lengths within a metre
        const double slack =
            tolerance(1e-13) * 1000.0 * shape.solid.area * std::pow(v.norm() + w.norm(), 2);
        CHECK((starboard.force - flip.cwiseProduct(port.force)).norm() <= slack);
        CHECK((starboard.moment + flip.cwiseProduct(port.moment)).norm() <= slack);
    }
}

TEST_CASE("projected drag is that of the wetted facets that the flow meets", "[water][property]") {
    Dice dice{std::mt19937(7)};
    for (int k = 0; k < 100; ++k) {
        const Shape shape = lumpy_shape(dice);
        const Mat3 turn = any_turn(dice);
        const Vec3 v = dice.vector(), w = Vec3::Zero();
        const Motion motion{turn, 0.2 * dice.unit(dice.random), v, w};
        double area = 0.0;
        for (const Facet& facet : shape.facets) {
            const auto z = [&](int c) { return (turn * facet.corner[c]).z() + motion.height; };
            area += wetted_share(z(0), z(1), z(2)) *
                    std::max(0.0, (turn * facet.area).dot(v) / v.norm());
        }
        const Vec3 even = projected_drag(shape, motion, 1.0, 1000.0).force;
        // a hundred roundings
        CHECK((even + 500.0 * area * v.norm() * v).norm() <=
              tolerance(1e-13) * 500.0 * v.squaredNorm());
        // without rotation, both laws are one
        const Vec3 by_panels = panel_drag(shape, motion, 1.0, 1000.0).force;
        CHECK((even - by_panels).norm() <=
              tolerance(1e-13) * 1000.0 * shape.solid.area * v.squaredNorm());
    }
}
