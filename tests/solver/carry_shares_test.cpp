// SPDX-License-Identifier: GPL-3.0-or-later
// A plate at 45 degrees that digs into the face of a floe: the pressed areas add up to the section.
//
// Tolerances: 1e-6 is a normal stored as a float; 1 % of a section is the 0.1 mm by which a share
// counts early, over 0.02 m.
#include "solver/narrow/manifold/carry_shares.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "solver/narrow/manifold/make_contacts.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kDepth = 0.1;                       // of the plate's edge in the floe [m]
constexpr double kEdge = std::numbers::sqrt2 / 2.0;  // x of that edge [m]

// The plate is a cube of 1 m, turned about y so that an edge points forwards. The face -x of the
// floe stands upright before it: both are convex, and x is their separating axis.
World plate_and_floe() {
    World w;
    w.parameters = test::empty_space(0.01);
    w.parameters.contact.crushing_pressure = 1e6;
    const Quaternion turn(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()));
    w.scene = make_scene(build_shape(test::fill_box(Vec3(1, 1, 1), 0.05, 0.1, turn), false),
                         Vec3::Zero(), Vec3::Zero());
    const auto box = test::add_shape(w, test::fill_box(Vec3(0.4, 0.8, 1.2), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(kEdge - kDepth + 0.2, 0, 0), Quaternion::Identity(), 0,
             false);
    return w;
}

// A contact of the ice's sphere j on a face of the plate, deep enough to count whole.
Contact on_face(const PairView& view, std::int32_t j, const Vec3& normal) {
    Contact c{};
    c.b = 1;
    c.sphere_b = j;
    c.key = std::uint64_t{1} << 32;
    c.normal = normal;
    c.patch = ice_patch(view, j, normal, -0.5);
    REQUIRE(incident_is_b(c));
    return c;
}

// The part of a contact in the section across x [m2].
double section(const Contact& c) { return c.normal.x() * cut_area(c.patch, c.patch.depth); }

double section(const std::vector<Contact>& contacts) {
    double sum = 0.0;
    for (const Contact& c : contacts) sum += section(c);
    return sum;
}

// Spheres on the floe's face -x that the plate covers, without those of its edges.
std::vector<std::int32_t> pressed(const Shape& floe) {
    std::vector<std::int32_t> out;
    for (std::int32_t j = 0; j < std::ssize(floe.center); ++j)
        if (floe.normal[j].x() < -1.0 + 1e-6 && std::abs(floe.center[j].z()) < kDepth)
            out.push_back(j);
    REQUIRE(out.size() > 4);
    return out;
}

// A sphere on the plate's foremost edge, in its middle.
std::int32_t edge_sphere(const Shape& plate) {
    std::int32_t best = 0;
    const Vec3 at(kEdge, 0, 0);
    for (std::int32_t i = 0; i < std::ssize(plate.center); ++i)
        if ((plate.center[i] - at).norm() < (plate.center[best] - at).norm()) best = i;
    REQUIRE(plate.cone[best].count == 2);
    return best;
}

void carry(const PairView& view, std::vector<Contact>& contacts) {
    std::vector<double> work;
    carry_shares(view, work, contacts);
}

}  // namespace

TEST_CASE("shares on both faces of an edge at 45 degrees add up to the section of the ice's face",
          "[narrow][patch][analytic]") {
    const World w = plate_and_floe();
    const PairView view(w.scene, {0, 1});
    std::vector<Contact> contacts;
    double face = 0.0;
    for (const std::int32_t j : pressed(view.shape_b)) {
        const double up = view.shape_b.center[j].z() < 0.0 ? -1.0 : 1.0;
        contacts.push_back(on_face(view, j, Vec3(1, 0, up).normalized()));
        face += view.shape_b.area[j];
    }
    // A (-n_j . n)(n . s), before: cos 45 degrees twice; normals are floats
    CHECK(section(contacts) == Near(0.5 * face).epsilon(1e-6));
    carry(view, contacts);
    CHECK(section(contacts) == Near(face).epsilon(1e-6));
}

TEST_CASE("the plate's edge adds what the ice's spheres leave of its section, and no more",
          "[narrow][patch][analytic]") {
    const World w = plate_and_floe();
    const PairView view(w.scene, {0, 1});
    const std::vector<std::int32_t> spheres = pressed(view.shape_b);
    const auto height = [&](std::int32_t k) { return std::abs(view.shape_b.center[k].z()); };
    const std::int32_t i = edge_sphere(view.shape_a),
                       j = *std::min_element(
                           spheres.begin(), spheres.end(),
                           [&](std::int32_t l, std::int32_t r) { return height(l) < height(r); });
    Contact edge{};
    edge.b = 1;
    edge.sphere_a = i;
    edge.normal = Vec3::UnitX();
    edge.patch = patch_of_a(view, i, edge.normal, -0.02);
    REQUIRE_FALSE(incident_is_b(edge));
    // over the edge's own wings, whose level length this is
    REQUIRE(height(j) < edge.patch.wing * edge.patch.spread_cos);
    // a wedge 0.02 m deep is 2 x 0.02 m wide, so long as its sphere's share is over both wings;
    // the share begins to count 0.1 mm before its wing is reached (patch.cpp)
    const double own = section(edge);
    CHECK(own == Near(2.0 * 0.02 * edge.patch.share / (2.0 * edge.patch.wing)).epsilon(0.01));
    // of the edge's section the ice's sphere has this part, once it is carried over
    const double part = GENERATE(0.0, 0.3, 0.9, 1.5);
    Contact face = on_face(view, j, Vec3(1, 0, 1).normalized());
    face.patch.share = part * own;
    std::vector<Contact> contacts{edge, face};
    carry(view, contacts);
    CAPTURE(part);
    CHECK(section(contacts[1]) == Near(part * own).epsilon(1e-6).margin(1e-15));
    CHECK(section(contacts) == Near(std::max(1.0, part) * own).epsilon(1e-6));
}

TEST_CASE("between floes, and where a solid is not convex, shares stay as they are",
          "[narrow][patch]") {
    World w = plate_and_floe();
    const PairView view(w.scene, {0, 1});
    const std::int32_t j = pressed(view.shape_b).front();
    std::vector<Contact> contacts{on_face(view, j, Vec3(1, 0, 1).normalized())};
    const double share = contacts[0].patch.share;
    add_floe(w.scene, 1, 900.0, Vec3(kEdge, 0, 0), Quaternion::Identity(), 0, false);
    carry(PairView(w.scene, {1, 2}), contacts);
    CHECK(contacts[0].patch.share == share);
    w.scene.shapes[0].convex = {};
    carry(PairView(w.scene, {0, 1}), contacts);
    CHECK(contacts[0].patch.share == share);
}
