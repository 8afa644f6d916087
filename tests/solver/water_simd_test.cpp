// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over wetted surfaces: bits on every instruction set, fill without weight, a slow twin.
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <random>

#include "solver/water/drag.hpp"
#include "solver/water/hydrostatics.hpp"
#include "solver/water/wetted_sums.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_sphere_sets.hpp"

using namespace ice;

namespace {

struct Dice {
    std::mt19937 random;
    std::uniform_real_distribution<double> unit{-1.0, 1.0};

    Vec3 vector() { return Vec3(unit(random), unit(random), unit(random)); }
    Mat3 turn() { return Eigen::AngleAxisd(3.0 * unit(random), vector().normalized()).matrix(); }
};

// Triangles of up to a metre that belong to no body: the sums ask for none.
std::vector<Panel> loose_panels(std::size_t count, Dice& dice) {
    std::vector<Panel> out;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 at = dice.vector();
        out.push_back(make_panel(at, at + 0.5 * dice.vector(), at + 0.5 * dice.vector()));
    }
    return out;
}

template <class T>
void append(const T& from, std::vector<double>& to) {
    for (int k = 0; k < from.size(); ++k) to.push_back(from[k]);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), 8 * a.size()) == 0;
}

// All that the kernels say of these panels.
template <class Integrate, class Sum, class SumEven>
std::vector<double> all_sums(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                             const Vec3& w, const Integrate& integrate, const Sum& sum,
                             const SumEven& sum_even) {
    const WettedIntegrals wet = integrate(panels, water);
    const FacingSums facing = sum(panels, water, v, w);
    std::vector<double> out{wet.volume, double(wet.any_wet), double(wet.any_dry), facing.flow,
                            sum_even(panels, water, v)};
    for (const Vec3& values : {wet.first, facing.first, facing.square, facing.mixed})
        append(values, out);
    return out;
}

using SumWithTurn = FacingSums(const PanelBlocks&, const WaterPlane&, const Vec3&, const Vec3&);
using SumWithout = double(const PanelBlocks&, const WaterPlane&, const Vec3&);

std::vector<double> by_kernel(const PanelBlocks& p, const WaterPlane& water, const Vec3& v,
                              const Vec3& w) {
    return all_sums(p, water, v, w, integrate_wetted, static_cast<SumWithTurn*>(sum_facing),
                    static_cast<SumWithout*>(sum_facing));
}
std::vector<double> by_reference(const PanelBlocks& p, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w) {
    return all_sums(p, water, v, w, reference::integrate_wetted,
                    static_cast<SumWithTurn*>(reference::sum_facing),
                    static_cast<SumWithout*>(reference::sum_facing));
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

TEST_CASE("every instruction set sums wetted panels to the bits of the reference",
          "[water][simd]") {
    const std::size_t count = GENERATE(0u, 1u, 2u, 3u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 300u);
    Dice dice{std::mt19937(static_cast<unsigned>(count))};
    const PanelBlocks panels(loose_panels(count, dice));
    for (const double height : {-4.0, -1.3, -0.2, 0.0, 0.4, 1.3, 4.0}) {
        const WaterPlane water(dice.turn(), height, 3.0);
        const Vec3 v = dice.vector(), w = dice.vector();
        const auto expected = by_reference(panels, water, v, w);
        if (count > 8 && std::abs(height) < 1.0) {  // or nothing is compared
            REQUIRE(expected[0] != 0.0);
            REQUIRE(expected[3] > 0.0);
        }
        test::on_every_instruction_set(
            [&] { CHECK(same_bits(by_kernel(panels, water, v, w), expected)); });
    }
}

TEST_CASE("every instruction set has the bits for edges and faces level with the water",
          "[water][simd]") {
    const Shape shape = build_shape(test::make_box_set(Vec3(1, 0.75, 0.25), 0.05, 0.1), true);
    const Mat3 upright = Mat3::Identity();
    const double height = GENERATE(-0.125, 0.125, 0.0, 1e-160, -1e-160);
    const WaterPlane water(upright, height, shape.bounding_radius);
    const Vec3 v = GENERATE(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, 0)), w(0, 0.5, 0);
    const auto expected = by_reference(shape.panels, water, v, w);
    for (const double value : expected) CHECK(std::isfinite(value));
    test::on_every_instruction_set(
        [&] { CHECK(same_bits(by_kernel(shape.panels, water, v, w), expected)); });
}

TEST_CASE("the fill of the last block adds exactly nothing", "[water][property]") {
    Dice dice{std::mt19937(3)};
    std::vector<Panel> panels = loose_panels(9, dice);
    const PanelBlocks filled(panels);
    CHECK(filled.size() == 9);
    CHECK(filled.blocks.size() == 2);
    while (panels.size() < 16)
        panels.push_back(make_panel(dice.vector(), Vec3::Ones(), Vec3::Zero()));
    PanelBlocks other(panels);
    for (std::size_t lane = 1; lane < 8; ++lane)
        for (int d = 0; d < 3; ++d)
            other.blocks[1].area[d][lane] = other.blocks[1].swing[d][lane] = 0.0;
    const WaterPlane water(dice.turn(), 0.1, 3.0);
    const Vec3 v = dice.vector(), w = dice.vector();
    CHECK(same_bits(by_kernel(filled, water, v, w), by_kernel(other, water, v, w)));
}

TEST_CASE("blocks read as the panels they were made of", "[water][property]") {
    Dice dice{std::mt19937(4)};
    const std::vector<Panel> panels = loose_panels(11, dice);
    std::size_t k = 0;
    for (const Panel& panel : PanelBlocks(panels)) {
        CHECK(panel.center == panels[k].center);
        CHECK(panel.area == panels[k].area);
        for (int c = 0; c < 3; ++c) CHECK(panel.corner[c] == panels[k].corner[c]);
        ++k;
    }
    CHECK(k == 11);
}

TEST_CASE("the submerged part is that of the body cut triangle by triangle", "[water][property]") {
    Dice dice{std::mt19937(5)};
    for (int k = 0; k < 100; ++k) {
        const Shape shape = lumpy_shape(dice);
        const Mat3 turn = dice.turn();
        const double height = 0.2 * dice.unit(dice.random);
        const Submerged expected = clip_body(shape, turn, height);
        const Submerged s = measure_submerged(shape, turn, height);
        // a few hundred roundings of moments of the size of the whole body
        const double slack = 1e-13 * shape.solid.volume;
        CHECK(std::abs(s.volume - expected.volume) < slack);
        if (expected.volume > slack)
            CHECK((s.centre - expected.centre).norm() * expected.volume < slack);
    }
}

TEST_CASE("drag is the sum over the panels, each with its own velocity", "[water][property]") {
    Dice dice{std::mt19937(6)};
    for (int k = 0; k < 100; ++k) {
        const Shape shape = lumpy_shape(dice);
        const Mat3 turn = dice.turn();
        const Vec3 v = dice.vector(), w = dice.vector();
        const Motion motion{turn, 0.2 * dice.unit(dice.random), v, w};
        WaterLoad expected;
        double area = 0.0, size = 0.0;
        for (const Panel& panel : shape.panels) {
            const auto z = [&](int c) { return (turn * panel.corner[c]).z() + motion.height; };
            const double share = wetted_share(z(0), z(1), z(2));
            const Vec3 r = turn * panel.center, a = turn * panel.area;
            const Vec3 u = v + w.cross(r);
            const Vec3 part = -0.5 * 1000.0 * share * std::max(0.0, a.dot(u)) * u;
            expected.force += part;
            expected.moment += r.cross(part);
            area += share * std::max(0.0, a.dot(v) / v.norm());
            size += part.norm();
        }
        const WaterLoad load = panel_drag(shape, motion, 1.0, 1000.0);
        const Vec3 even = projected_drag(shape, motion, 1.0, 1000.0).force;
        // a few hundred roundings; centres are within a metre
        CHECK((load.force - expected.force).norm() <= 1e-13 * size);
        CHECK((load.moment - expected.moment).norm() <= 1e-13 * size);
        CHECK((even + 500.0 * area * v.norm() * v).norm() <= 1e-13 * 500.0 * v.squaredNorm());
    }
}
