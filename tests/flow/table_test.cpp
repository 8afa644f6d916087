// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the flow around a hull: against the panels' own sum, bits, files.
//
// Tolerances: 1e-12 is rounding of an interpolation of eight numbers; 5 % of a residual and 0.5 %
// of a flux are where iceflow warns (solver/flow/flow_table.cpp).
#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <random>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "solver/flow/flow_table.hpp"
#include "solver/flow/look_up_flow.hpp"
#include "solver/flow/solve_panels.hpp"
#include "solver/flow/wetted_panels.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// 6 m long, 1.2 m broad, 0.6 m deep, for floes 0.2 m thick.
constexpr double kThickness = 0.2;
TriangleMesh small_hull() { return test::make_wigley(6.0, 1.2, 0.6, 24, 8); }
HullFlow small_flow() { return make_hull_flow(small_hull(), 3, {0.0, 0.3, kThickness / 2}); }

bool same(const FlowTable& a, const FlowTable& b) {
    return a.nodes == b.nodes && a.origin == b.origin && a.spacing == b.spacing &&
           a.velocity == b.velocity && a.potential == b.potential && a.symmetric == b.symmetric &&
           a.draught == b.draught && a.reference_speed == b.reference_speed &&
           a.panels == b.panels && a.residual == b.residual && a.source_sha256 == b.source_sha256 &&
           a.created_by == b.created_by && a.command_line == b.command_line;
}

// A field that is linear in place, on a grid of a few nodes.
FlowTable linear_table(bool symmetric, std::int64_t ny) {
    FlowTable t;
    t.nodes = {5, ny, 4};
    t.spacing = 0.5;
    t.origin = Vec3(-1.0, symmetric ? 0.0 : -0.5, -1.5);
    t.symmetric = symmetric;
    for (std::int64_t k = 0; k < 4; ++k)
        for (std::int64_t j = 0; j < ny; ++j)
            for (std::int64_t i = 0; i < 5; ++i) {
                const float x = float(i), y = float(j), z = float(k);
                t.velocity.insert(t.velocity.end(), {x + 2 * y, 3 * y + z, 1 + x - z});
                t.potential.push_back(x + y + z);
            }
    return t;
}

std::vector<Vec3> random_points(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1.7, 1.7);
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < count; ++k)
        out.emplace_back(place(random), place(random), place(random));
    return out;
}

}  // namespace

TEST_CASE("between nodes the table is linear, above the water that at its surface, outside 0",
          "[flow][analytic]") {
    const FlowGrid grid(linear_table(false, 3));
    const auto at = [&](const Vec3& p) {
        FlowSample out;
        look_up_flow(grid, std::span(&p, 1), std::span(&out, 1));
        return out;
    };
    const FlowSample s = at(Vec3(0.1, 0.15, -0.4));  // nodes 2.2, 1.3, 2.2
    CHECK(s.velocity.isApprox(Vec3(2.2 + 2.6, 3.9 + 2.2, 1.0), tolerance(1e-12)));
    CHECK(s.potential == Near(5.7));
    CHECK(at(Vec3(0.1, 0.15, 0.7)).velocity == at(Vec3(0.1, 0.15, 0.0)).velocity);
    CHECK(at(Vec3(1.0, 0.5, 0.0)).potential == 9.0);  // the last node itself
    for (const Vec3& p : {Vec3(1.01, 0, -0.5), Vec3(-1.01, 0, -0.5), Vec3(0, 0.51, -0.5),
                          Vec3(0, -0.51, -0.5), Vec3(0, 0, -1.51)})
        CHECK(at(p).velocity == Vec3::Zero());
    FlowSample none;
    const Vec3 p = Vec3::Zero();
    look_up_flow(FlowGrid(), std::span(&p, 1), std::span(&none, 1));
    CHECK(none.velocity == Vec3::Zero());
}

TEST_CASE("every instruction set looks up the bits of the reference", "[flow][simd]") {
    const bool symmetric = GENERATE(true, false);
    const std::int64_t ny = GENERATE(1, 2, 3);
    const FlowGrid grid(linear_table(symmetric, ny));
    const auto points = random_points(500);
    test::on_every_instruction_set([&] {
        std::vector<FlowSample> out(points.size());
        look_up_flow(grid, points, out);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const FlowSample expected = reference::look_up_flow(grid, points[k]);
            REQUIRE(std::memcmp(static_cast<const void*>(&out[k]), &expected, sizeof(FlowSample)) ==
                    0);
        }
    });
}

TEST_CASE("the table is the panels' sum half a floe's thickness and more off the hull", "[flow]") {
    const HullFlow made = small_flow();
    CHECK(made.table.symmetric);
    CHECK(made.table.draught == Near(0.6));
    CHECK(made.table.residual < tolerance(0.05));
    CHECK(std::abs(made.net_flux) < tolerance(5e-3));
    const FlowGrid grid(made.table);
    const PanelFlow flow = solve_panels(make_wetted_hull(small_hull(), 0.0, {0.3, 4000}).body);
    const auto rms_at = [&](double off, bool normal_only) {
        std::vector<Vec3> points;
        for (const SourcePanel& p : flow.body.panels) points.push_back(p.centre + off * p.normal);
        std::vector<FlowSample> table(points.size());
        look_up_flow(grid, points, table);
        const auto direct = flow_at(flow, points);
        double squares = 0.0, area = 0.0;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const SourcePanel& p = flow.body.panels[k];
            const Vec3 off_by = table[k].velocity - direct[k].velocity;
            const double size = normal_only ? off_by.dot(p.normal) : off_by.norm();
            squares += p.area * size * size;
            area += p.area;
        }
        return std::sqrt(squares / area);
    };
    CHECK(rms_at(0.5 * kThickness, false) < tolerance(0.01));
    CHECK(rms_at(kThickness, false) < tolerance(0.003));
    CHECK(rms_at(0.1 * kThickness, true) < tolerance(0.03));
    // at the rim the flow has faded, and little is lost by that
    const auto rim = static_cast<std::size_t>(made.table.nodes[0]) - 1;
    CHECK(made.table.velocity[3 * rim] == 0.0f);
}

TEST_CASE("a table has the same bits for any number of threads and instruction set",
          "[flow][simd]") {
    const auto make = [] {
        return make_hull_flow(test::make_wigley(6.0, 1.2, 0.6, 8, 3), 3, {0.0, 0.6, 0.3});
    };
    const int threads = thread_count();
    set_thread_count(1);
    const FlowTable one = make().table;
    set_thread_count(3);
    test::on_every_instruction_set([&] { CHECK(same(make().table, one)); });
    set_thread_count(threads);
}

TEST_CASE("a flow through the hull or out of its sources is warned of by number and place",
          "[flow][warnings]") {
    HullFlow flow;
    flow.table.residual = 0.049;
    flow.net_flux = -0.0049;
    CHECK(warnings_of(flow).empty());

    flow.table.residual = 0.0627;
    flow.worst_place = Vec3(12.5, -1.25, -0.75);
    auto warnings = warnings_of(flow);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("6.3 % of the ship's speed") &&
                                Catch::Contains("(12.50, -1.25, -0.75) m"));

    flow.table.residual = 0.0;
    flow.net_flux = -0.0123;  // sinks stronger than sources
    warnings = warnings_of(flow);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("differ by 1.23 % of all sources"));
}

TEST_CASE("a section's table lies in its plane and closes around it", "[flow]") {
    TriangleMesh prism = test::make_box_set(Vec3(4.0, 1.0, 1.0), 0.2, 0.3).mesh;
    const HullFlow made = make_hull_flow(prism, 2, {-0.1, 0.0, 0.1});
    CHECK(made.table.nodes[1] == 1);
    CHECK(made.table.draught == Near(0.4));
    CHECK(std::abs(made.net_flux) < tolerance(5e-3));
    const FlowGrid grid(made.table);
    // ahead of the bow the water is pushed, under the bottom it flows back
    CHECK(reference::look_up_flow(grid, Vec3(2.2, 7.0, -0.2)).velocity.x() > 0.1);
    CHECK(reference::look_up_flow(grid, Vec3(0.0, 0.0, -0.6)).velocity.x() < -0.02);
    CHECK(reference::look_up_flow(grid, Vec3(2.2, 0.0, -0.2)).velocity.y() == 0.0);
}

TEST_CASE("a flow file reads as it was written, and strange ones are refused", "[flow][formats]") {
    const auto file = std::filesystem::temp_directory_path() / "table_test.flow.h5";
    FlowTable t = linear_table(true, 3);
    t.draught = 0.7;
    t.panels = 12;
    t.residual = 0.01;
    t.source_sha256 = "abc";
    t.created_by = "test";
    t.command_line = "iceflow";
    write_flow(file, t);
    CHECK(same(read_flow(file), t));
    const auto refused = [&](const FlowTable& bad, const char* what) {
        write_flow(file, bad);
        CHECK_THROWS_WITH(read_flow(file), Catch::Contains(what));
    };
    FlowTable bad = t;
    bad.velocity[7] = std::numeric_limits<float>::quiet_NaN();
    refused(bad, "holds a NaN");
    bad = t;
    bad.origin.z() = -1.0;
    refused(bad, "topmost nodes");
    bad = t;
    bad.origin.y() = 0.5;
    refused(bad, "not at y = 0");
    bad = t;
    bad.spacing = 0.0;
    refused(bad, "spacing");
    bad = t;
    bad.reference_speed = -1.0;
    refused(bad, "reference_speed");
    std::filesystem::remove(file);
}
