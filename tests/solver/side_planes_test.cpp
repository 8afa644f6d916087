// SPDX-License-Identifier: GPL-3.0-or-later
// Where the faces and edges end that spheres stand for.
#include "solver/shape/side_planes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include "solver/narrow/find_contacts.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kRadius = 0.05, kSpacing = 0.1;  // [m]
const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

// Lengths of a metre, added a few times.
constexpr double kRounding = 1e-14;

// The set without the spheres where three faces meet, as spherize leaves out those that two edges'
// spheres, a little apart, stand for.
SphereSet without_corners(const SphereSet& set) {
    std::vector<int> faces(set.surface_count, 0);
    for (const CreaseNormal& c : set.creases) ++faces[static_cast<std::size_t>(c.sphere)];
    SphereSet out = set;
    out.centers.clear();
    out.radii.clear();
    out.normals.clear();
    out.normal_spread.clear();
    out.areas.clear();
    out.regions.clear();
    out.creases.clear();
    std::vector<std::int32_t> row(set.surface_count, -1);
    for (std::size_t k = 0; k < set.surface_count; ++k) {
        if (faces[k] == 3) continue;
        row[k] = static_cast<std::int32_t>(out.centers.size());
        out.centers.push_back(set.centers[k]);
        out.radii.push_back(set.radii[k]);
        out.normals.push_back(set.normals[k]);
        out.normal_spread.push_back(set.normal_spread[k]);
        out.areas.push_back(set.areas[k]);
        out.regions.push_back(set.regions[k]);
    }
    for (const CreaseNormal& c : set.creases)
        if (row[static_cast<std::size_t>(c.sphere)] >= 0)
            out.creases.push_back({row[static_cast<std::size_t>(c.sphere)], c.normal});
    out.surface_count = out.centers.size();
    return out;
}

// The set whose spheres in corners stand for the edge along x only: where spherize has put spheres
// of two edges a little apart, either goes on past the corner.
SphereSet without_ends(const SphereSet& set) {
    SphereSet out = set;
    out.creases.clear();
    for (const CreaseNormal& c : set.creases) {
        const auto k = static_cast<std::size_t>(c.sphere);
        const bool corner = set.normals[k].cwiseAbs().minCoeff() > 0.1;
        if (!corner || c.normal.x() == 0.0) out.creases.push_back(c);
        if (!corner) continue;
        out.normals[k].x() = 0.0;
        out.normals[k].normalize();
        out.normal_spread[k] = 0.25 * std::numbers::pi;
    }
    return out;
}

// Spheres made by hand: the data that side planes are made from, and nothing else.
struct Patchwork {
    Shape shape;

    Patchwork() { shape.patch_radius = 0.75 * kSpacing; }
    // Tangent to faces that meet at `tip`: one of a face, two of an edge.
    void add(const Vec3& tip, std::initializer_list<Vec3> normals) {
        Vec3 middle = Vec3::Zero();
        for (const Vec3& n : normals) middle += n;
        middle.normalize();
        NormalCone faces;
        if (normals.size() > 1) faces = NormalCone::meeting(normals);
        faces.apex_distance = kRadius / middle.dot(*normals.begin());
        shape.center.push_back(tip - faces.apex_distance * middle);
        shape.radius.push_back(kRadius);
        shape.normal.push_back(middle);
        shape.spread_cos.push_back(normals.size() > 1 ? kRadius / faces.apex_distance : 1.0);
        shape.cone.push_back(faces);
        shape.mirror_rank.push_back(static_cast<std::int32_t>(shape.mirror_rank.size()));
    }
    // Has the first sphere side planes?
    bool has_side_planes() const { return SidePlanes(shape).has(0); }
};

// The part of a vector along the edge, or across the face's normal, of sphere k.
Vec3 part_within(const Shape& shape, std::size_t k, const Vec3& v) {
    if (shape.cone[k].count == 2) return v.dot(shape.cone[k].edge(0)) * shape.cone[k].edge(0);
    return v - v.dot(shape.normal[k]) * shape.normal[k];
}

}  // namespace

TEST_CASE("a box's faces and edges end where the box does", "[narrow][side_planes][analytic]") {
    const Vec3 size(1.0, 0.8, 0.3);
    const bool corners = GENERATE(true, false);
    const SphereSet set = make_box_set(size, 0.2 * kSpacing, kSpacing);  // near the edges
    const Shape shape = build_shape(corners ? set : without_corners(set), true);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int within = 0, beyond = 0;
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        if (shape.cone[k].count == 3) continue;
        const Vec3 tip = shape.center[k] + shape.cone[k].apex_distance * shape.normal[k];
        for (int n = 0; n < 20; ++n) {
            // as far as this the planes around are known, and more than a sphere stands for
            const Vec3 offset =
                1.7 * shape.patch_radius * Vec3(unit(random), unit(random), unit(random));
            const Vec3 point = tip + part_within(shape, k, offset);
            const double past = (point.cwiseAbs() - 0.5 * size).maxCoeff();
            const auto contains = [&](double slack) {
                const auto row = static_cast<std::int32_t>(k);
                return !shape.side_planes.has(row) || shape.side_planes.contain(row, point, slack);
            };
            (past <= kRounding ? within : beyond) += 1;
            CAPTURE(k, point.transpose(), past);
            // a face's own plane is no side plane of it: its points are past none by rounding
            REQUIRE(contains(past + kRounding));
            if (past > 2.0 * kRounding) REQUIRE_FALSE(contains(past - kRounding));
        }
    }
    CHECK(within > 1000);
    CHECK(beyond > 100);
}

TEST_CASE("a face ends at outward edges only", "[narrow][side_planes][analytic]") {
    Patchwork outward, inward, flat;
    for (Patchwork* p : {&outward, &inward, &flat}) p->add(Vec3(-0.1, 0, 0), {kZ});
    SECTION("where the next face goes down") {
        outward.add(Vec3::Zero(), {kZ, kX});
        CHECK(outward.has_side_planes());
    }
    SECTION("but not where it rises") {
        inward.add(Vec3::Zero(), {kZ, -kX});
        CHECK_FALSE(inward.has_side_planes());
    }
    SECTION("nor where it goes on, but for two degrees") {
        const double bend = 0.035;
        flat.add(Vec3::Zero(), {kZ, Vec3(std::sin(bend), 0, std::cos(bend))});
        CHECK_FALSE(flat.has_side_planes());
    }
}

TEST_CASE("a face goes on where its edge is hollow in plan", "[narrow][side_planes][analytic]") {
    // edges along a circle of 0.5 m about (0, 0): inside it solid, or outside
    const bool hollow = GENERATE(false, true);
    Patchwork p;
    p.add(Vec3(hollow ? 0.6 : 0.4, 0, 0), {kZ});
    for (const double angle : {-0.2, 0.0, 0.2}) {
        const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
        p.add(0.5 * out, {kZ, hollow ? Vec3(-out) : out});
    }
    CHECK(p.has_side_planes() != hollow);
}

TEST_CASE("an edge ends at planes that are next to both of its faces", "[narrow][side_planes]") {
    Patchwork p;
    p.add(Vec3::Zero(), {kZ, kX});
    p.add(Vec3(-0.1, 0.1, 0), {kZ, kY});
    CHECK_FALSE(p.has_side_planes());
    p.add(Vec3(0, 0.1, -0.1), {kX, kY});
    CHECK(p.has_side_planes());
}

TEST_CASE("floes past the end of a ship's edges touch nothing", "[narrow][side_planes][property]") {
    // planes that would part the bodies are not known: of a hull of many facets they are not
    World w;
    w.scene = make_scene(
        build_shape(without_ends(make_box_set(Vec3(4, 2, 1), 0.2 * kSpacing, kSpacing)), false),
        Vec3::Zero(), Vec3::Zero());
    w.scene.shapes[0].bounds = ConvexBounds();
    const auto box = add_shape(w, make_box_set(Vec3(1, 0.8, 0.3), kRadius, kSpacing));
    add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    Bodies& bodies = w.scene.bodies;
    const auto find = [&] {
        std::vector<Contact> contacts;
        reference::find_contacts(w.scene, {0, 1}, NormalRule::surface, 0.0, contacts);
        return contacts;
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 50; ++n) {
        // a floe's edge slants across the line of the edge between side, y = 1, and bottom,
        // z = -0.5, and is beyond it, but ahead of the bow, x = 2, as is all of the floe
        const double lean = 0.005 + 0.01 * unit(random), ahead = 0.001 + 0.01 * unit(random);
        const double beyond = 0.001 + 0.01 * unit(random);
        const Vec3 out = (kY - kZ).normalized();
        Mat3 axes;
        axes.col(0) = std::cos(lean) * out - std::sin(lean) * kX;
        axes.col(2) = std::cos(lean) * kX + std::sin(lean) * out;
        axes.col(1) = axes.col(2).cross(axes.col(0));
        const Vec3 edge(2.0 + ahead + std::sin(lean), 1.0, -0.5);  // the floe is 1 m long
        bodies.orientation[1] = Quaternion(axes);
        bodies.position[1] = edge - beyond * out + 0.5 * axes.col(0) + 0.15 * axes.col(2);
        update_derived(bodies, 1);
        CAPTURE(n, lean, ahead, beyond);
        REQUIRE(find().empty());
        bodies.position[1].x() -= edge.x() - 1.97;  // 3 cm before the end they do cross
        const std::vector<Contact> contacts = find();
        REQUIRE_FALSE(contacts.empty());
        // the ship's edge lies on a face that leans so much, 3 cm at most from where they cross
        CHECK(std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
            return std::abs(c.gap + beyond) < tolerance(0.03) * lean &&
                   c.normal.dot(out) > std::cos(1.01 * lean);
        }));
    }
}
