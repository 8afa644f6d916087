// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/scene_view.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "postprocess/views/floe_style.hpp"
#include "postprocess/views/hull_drawing.hpp"
#include "postprocess/views/view_window.hpp"
#include "tests/postprocess/make_folder.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::views;

namespace {

// first x of the first path that has the given text in its element
double first_x(const std::string& svg, const std::string& mark) {
    const std::size_t at = svg.find(mark);
    REQUIRE(at != std::string::npos);
    const std::size_t path = svg.rfind("d=\"M", at);
    REQUIRE(path != std::string::npos);
    return std::stod(svg.substr(path + 4));
}

// a hull of 8 x 2 x 1.2 m (x from 0 to 8) and one moving floe
std::string draw_one(ViewFrom from, const Vec3& at, FloeState state = FloeState::moving) {
    RunData run = make_run({.floes = 1, .frames = 1});
    run.frames[0].position[0] = at;
    run.frames[0].state[0] = state;
    run.frames[0].contact_force[0] = Vec3::UnitX();  // marks its outline
    return SceneView(run.header, from, {}).draw(run.frames[0], {});
}

const char* kTouched = "stroke=\"#d55e00\"";

// whether the floe is painted after the hull, i.e. in front of it
bool painted_in_front(ViewFrom from, const Vec3& at) {
    const std::string svg = draw_one(from, at);
    const std::size_t hull = svg.find("stroke-linecap=\"round\""), floe = svg.find(kTouched);
    REQUIRE(hull != std::string::npos);
    REQUIRE(floe != std::string::npos);
    return floe > hull;
}

}  // namespace

TEST_CASE("a side view shows room for a floe under the hull, not for unbroken ice", "[views]") {
    const Eigen::AlignedBox3d hull(Vec3(-50, -10, -8), Vec3(50, 10, 5));
    for (const auto& [floe_size, room] : {std::pair{1.0, 6.0}, {5.0, 9.0}, {45.0, 25.0}})
        CHECK(choose_window(hull, ViewFrom::side, floe_size, 0.0, 0.0).bottom == -8.0 - room);
}

TEST_CASE("all five views of a run are well-formed and show hull, floes, axes and time",
          "[views]") {
    const auto from = GENERATE(ViewFrom::below, ViewFrom::top, ViewFrom::side, ViewFrom::front,
                               ViewFrom::quarter);
    const RunData run = make_run();
    ViewOptions options;
    options.legend = true;
    const std::string svg = SceneView(run.header, from, options).draw(run.frames[30], {});
    CHECK(tag_fault(svg).empty());
    CHECK(count(svg, "<path") > 6);
    CHECK_THAT(svg, Catch::Contains("t = 3.00 s"));
    CHECK_THAT(svg, Catch::Contains("touched by the ship"));
    if (from != ViewFrom::quarter) CHECK_THAT(svg, Catch::Contains("[m]"));
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("a floe under the bottom is in front of the hull from below and behind it from above",
          "[views]") {
    CHECK(painted_in_front(ViewFrom::below, {4.0, 0.0, -0.85}));
    CHECK_FALSE(painted_in_front(ViewFrom::top, {4.0, 0.0, -0.85}));
}

TEST_CASE("a floe at starboard hides the hull from starboard, one at port is hidden", "[views]") {
    CHECK(painted_in_front(ViewFrom::side, {4.0, -1.5, -0.3}));
    CHECK_FALSE(painted_in_front(ViewFrom::side, {4.0, 1.5, -0.3}));
}

TEST_CASE("a floe ahead of the stem is left out from ahead, one under it is drawn", "[views]") {
    CHECK(draw_one(ViewFrom::front, {9.5, 0.0, -0.1}).find(kTouched) == std::string::npos);
    CHECK(draw_one(ViewFrom::front, {7.0, 0.0, -0.85}).find(kTouched) != std::string::npos);
}

TEST_CASE("a floe ahead is drawn to the right of one aft, one far away is not drawn", "[views]") {
    const double ahead = first_x(draw_one(ViewFrom::below, {8.6, 0.0, -0.1}), kTouched);
    const double aft = first_x(draw_one(ViewFrom::below, {-1.0, 0.0, -0.1}), kTouched);
    CHECK(ahead > aft + 300.0);
    CHECK(draw_one(ViewFrom::below, {50.0, 0.0, -0.1}).find(kTouched) == std::string::npos);
}

TEST_CASE("the picture moves with the ship: hull and floe at the same place 100 m later",
          "[views]") {
    RunData run = make_run({.floes = 1, .frames = 2});
    run.frames[1] = run.frames[0];
    run.frames[1].ship_position += Vec3(100.0, 0.0, 0.0);
    run.frames[1].position[0] += Vec3(100.0, 0.0, 0.0);
    run.header.tracked.clear();
    const SceneView view(run.header, ViewFrom::side, {});
    const std::string a = view.draw(run.frames[0], {}), b = view.draw(run.frames[1], {});
    const auto paths = [](const std::string& svg) { return svg.substr(svg.find("<path")); };
    CHECK(paths(a) == paths(b));
    CHECK(a != b);  // the axis has other numbers
}

TEST_CASE("a tracked floe is numbered and its path is drawn up to the frame's time", "[views]") {
    const RunData run = make_run();
    Trail trail{6, "#aa4499", "7 3", {0.0, 1.0, 2.0, 3.0}, {}};
    for (int k = 0; k < 4; ++k) trail.offset.emplace_back(8.0 - 2.0 * k, 0.0, -0.5);
    const SceneView view(run.header, ViewFrom::side, {});
    const std::string early = view.draw(run.frames[11], {trail});
    const std::string late = view.draw(run.frames[40], {trail});
    CHECK_THAT(late, Catch::Contains(">6</text>"));
    CHECK(count(late, "#aa4499") == 1);
    CHECK_THAT(late, Catch::Contains("stroke-dasharray=\"7 3\""));
    CHECK(late.size() > early.size());
}

TEST_CASE("numbers of floes at one place stand above each other, and the legend has all paths",
          "[views]") {
    const RunData run = make_run();
    std::vector<Trail> trails;
    for (std::int32_t floe = 1; floe <= 6; ++floe) {
        const TrailStyle style = trail_style(static_cast<std::size_t>(floe));
        trails.push_back({floe, style.color, style.dash, {}, {}});
    }
    const std::string svg = draw_trails(
        run.frames[0], trails, [](const Vec3&) { return Vec2(100.0, 50.0); }, Vec2(200.0, 100.0));
    std::set<std::string> heights;
    for (std::size_t at = svg.find("<text"); at != std::string::npos;
         at = svg.find("<text", at + 1))
        heights.insert(svg.substr(svg.find(" y=", at), 9));
    CHECK(heights.size() == 6);
    CHECK(draw_trails(
              run.frames[0], trails, [](const Vec3&) { return Vec2(300.0, 50.0); },
              Vec2(200.0, 100.0))
              .empty());
    const TrailLegend wide = draw_trail_legend(trails, 800.0);
    CHECK(wide.rows == 1);
    CHECK(count(wide.svg, "<line") == 6);
    CHECK(draw_trail_legend(trails, 260.0).rows > 1);
    CHECK(draw_trail_legend({}, 800.0).rows == 0);
}

TEST_CASE("the paths of thirty floes differ in colour or dash", "[views]") {
    std::set<std::string> looks;
    for (std::size_t k = 0; k < 30; ++k)
        looks.insert(std::string(trail_style(k).color) + trail_style(k).dash);
    CHECK(looks.size() == 30);
}

TEST_CASE("with an id the hull is defined once and referred to", "[views]") {
    const RunData run = make_run();
    ViewOptions options;
    options.hull_id = "h1";
    const SceneView view(run.header, ViewFrom::below, options);
    CHECK(tag_fault(view.define_hull()).empty());
    CHECK_THAT(view.define_hull(), Catch::Contains("<g id=\"h1\">"));
    CHECK_THAT(view.draw(run.frames[0], {}), Catch::Contains("<use href=\"#h1\"/>"));
}

namespace {

// A floe below a sheet in two parts, x from 0 to 6 and 6 to 12 m, y from 2 to 5 m.
RunData sheet_run() {
    RunData run = make_run({.floes = 3, .frames = 1});
    RunHeader& header = run.header;
    header.shapes.push_back(header.shapes[1]);
    header.shapes[2].mesh = make_box({6.0, 3.0, 0.2});
    header.body_shape = {1, 2, 2};
    header.body_group = {0, 1, 1};
    header.sheet_group = 1;
    header.tracked.clear();
    RunFrame& frame = run.frames[0];
    frame.position = {Vec3(3, 2.5, -0.5), Vec3(3, 3.5, 0), Vec3(9, 3.5, 0)};
    frame.orientation.assign(3, Eigen::Quaterniond::Identity());
    frame.state = {FloeState::moving, FloeState::held, FloeState::held};
    frame.contact_force = {Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()};
    return run;
}

// how the sheet's face is filled, from above and below
std::string sheet_fill(ViewFrom from) {
    const Projection p = projection_of(from);
    return "fill=\"" + shade(floe_style(FloeState::held).color, brightness(p.toward, p)) + "\"";
}

}  // namespace

TEST_CASE("a sheet in parts is one plate without a line between them", "[views][level_ice]") {
    const auto from = GENERATE(ViewFrom::top, ViewFrom::below, ViewFrom::side);
    RunData run = sheet_run();
    const SceneView view(run.header, from, {});
    const auto corners = [&](const std::string& svg) {
        const std::size_t fill = svg.find(sheet_fill(from)), begin = svg.rfind("d=\"", fill);
        REQUIRE(fill != std::string::npos);
        return svg.substr(begin, fill - begin);
    };
    const std::string whole = view.draw(run.frames[0], {});
    CHECK(tag_fault(whole).empty());
    // from a side a second one veils what lies behind it
    CHECK(count(whole, sheet_fill(from)) == (from == ViewFrom::side ? 2 : 1));
    run.frames[0].state[2] = FloeState::absent;
    CHECK(corners(view.draw(run.frames[0], {})) != corners(whole));
    // one large part has the outline of both
    run.frames[0].state[2] = FloeState::held;
    run.header.shapes[2].mesh = make_box({12.0, 3.0, 0.2});
    run.frames[0].position[1] = run.frames[0].position[2] = Vec3(6, 3.5, 0);
    const SceneView large(run.header, from, {});
    CHECK(corners(large.draw(run.frames[0], {})).size() == corners(whole).size());
}

TEST_CASE("a floe under the sheet is hidden from above and shown from below",
          "[views][level_ice]") {
    const RunData run = sheet_run();
    for (const ViewFrom from : {ViewFrom::top, ViewFrom::below}) {
        const std::string svg = SceneView(run.header, from, {}).draw(run.frames[0], {});
        CHECK((svg.find(kTouched) < svg.find(sheet_fill(from))) == (from == ViewFrom::top));
    }
}

TEST_CASE("a floe that is not there is not drawn", "[views][level_ice]") {
    CHECK(draw_one(ViewFrom::below, {4.0, 0.0, -0.85}, FloeState::absent).find(kTouched) ==
          std::string::npos);
}

TEST_CASE("faces turned to the light are brighter, within 0.68 and 1.06", "[views]") {
    const Projection p = projection_of(ViewFrom::top);
    const double lit = brightness(p.toward, p), dark = brightness(-p.toward, p);
    CHECK(lit > dark);
    CHECK(lit <= 1.1);
    CHECK(dark == Near(0.68).margin(0.02));
}

TEST_CASE("runs without floes or with an empty hull can be drawn", "[views]") {
    RunData run = make_run({.floes = 0, .frames = 1});
    CHECK(tag_fault(SceneView(run.header, ViewFrom::below, {}).draw(run.frames[0], {})).empty());
    run.header.shapes[0].mesh = TriangleMesh{};
    CHECK(tag_fault(SceneView(run.header, ViewFrom::side, {}).draw(run.frames[0], {})).empty());
    CHECK(parse_view("below") == ViewFrom::below);
    CHECK_FALSE(parse_view("under"));
}
