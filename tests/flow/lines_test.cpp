// SPDX-License-Identifier: GPL-3.0-or-later
// The plane flow around sections by lines of sources: known answers.
//
// Tolerances: 0.5 % of a speed and 2e-3 of a flux are the lines' error, of first order in their
// length; 1e-9 is central differences over 1e-5 m; 1e-12 m is rounding of a cut.
#include <catch2/catch.hpp>
#include <numbers>

#include "solver/flow/line_sources.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// The lower half of an ellipse with half axes a and b as `count` lines.
std::vector<SourceLine> half_ellipse(double a, double b, int count) {
    std::vector<SourceLine> out;
    const auto at = [&](int k) {
        const double angle = std::numbers::pi * k / count;
        return Vec3(a * std::cos(angle), 0.0, -b * std::sin(angle));
    };
    for (int k = 0; k < count; ++k) {
        const Vec3 from = at(k), to = at(k + 1), along = (to - from).normalized();
        out.push_back(make_line(from, to, Vec3(-along.z(), 0.0, along.x())));
        if (out.back().normal.dot(from + to) < 0.0) out.back().normal = -out.back().normal;
    }
    return out;
}

}  // namespace

TEST_CASE("the speed along a circle is 2 sin, along an ellipse at its side 1 + b / a",
          "[flow][analytic]") {
    const double b = GENERATE(1.0, 0.25);
    const LineFlow flow = solve_lines(half_ellipse(1.0, b, 100));
    std::vector<Vec3> points;
    for (const SourceLine& line : flow.lines)
        points.push_back(0.5 * (line.from + line.to) + kOffPanel * line.length * line.normal);
    const auto samples = flow_at(flow, points);
    double squares = 0.0, length = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        // (1 + b/a) |t_x|, which is 2 sin(theta) of a circle
        const double exact = (1.0 + b) * std::abs(flow.lines[k].along.x());
        const double got = (samples[k].velocity - Vec3::UnitX()).norm();
        squares += flow.lines[k].length * (got - exact) * (got - exact);
        length += flow.lines[k].length;
    }
    CHECK(std::sqrt(squares / length) < tolerance(0.005));
    CHECK(std::abs(flow.net_flux) < tolerance(2e-3));
    const double side = (samples[50].velocity - Vec3::UnitX()).norm();
    CHECK(side == Near(1.0 + b).epsilon(0.005));
}

TEST_CASE("a line's flow is the gradient of its potential", "[flow][analytic]") {
    LineFlow flow;
    flow.lines = {make_line(Vec3(0, 0, -1), Vec3(0.6, 0, -1.8), Vec3(-0.8, 0, -0.6))};
    flow.strength = {1.0};
    const double step = 1e-5;
    for (const Vec3& at : {Vec3(-0.5, 0, -1.2), Vec3(1.5, 0, -0.4)}) {
        const auto here = flow_at(flow, std::vector<Vec3>{at});
        for (const int axis : {0, 2}) {
            const Vec3 off = step * Vec3::Unit(axis);
            const auto around = flow_at(flow, std::vector<Vec3>{at + off, at - off});
            CHECK(here[0].velocity[axis] ==
                  Near((around[0].potential - around[1].potential) / (2.0 * step)).margin(1e-9));
        }
    }
}

TEST_CASE("the wetted outline of a prism is cut at the water and into short lines", "[flow]") {
    const SphereSet set = test::make_box_set(Vec3(4.0, 1.0, 1.0), 0.2, 0.3);
    const auto lines = make_wetted_lines(set.mesh, -0.3, 0.25);
    double length = 0.0, enclosed = 0.0;
    for (const SourceLine& line : lines) {
        CHECK(line.length <= 0.25 + tolerance(1e-12));
        CHECK(std::max(line.from.z(), line.to.z()) <= 0.0);
        length += line.length;
        enclosed += line.length * line.normal.x() * 0.5 * (line.from.x() + line.to.x());
    }
    CHECK(length == Near(4.0 + 2 * 0.2));
    CHECK(enclosed == Near(4.0 * 0.2));
}
