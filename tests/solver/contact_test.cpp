// SPDX-License-Identifier: GPL-3.0-or-later
// Impulses of single contacts against their closed forms.
//
// Tolerances: 1e-15 is rounding of one product.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/contact/overlaps.hpp"
#include "solver/contact/solve_contacts.hpp"
#include "solver/scene/build_scene.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Rounding of about a hundred operations on numbers of order one; the solver's own tolerance is set
// far below it.
constexpr double kRounding = 1e-12;

constexpr double kDt = 0.01;  // [s]

ContactLaw exact_law(double restitution, double friction) {
    return {restitution, friction, friction, std::numeric_limits<double>::infinity(), 2000, 1e-15};
}

// Two free boxes; the contact is put where the test wants it.
Scene two_boxes() {
    Scene scene = make_scene(build_shape(test::make_box_set(Vec3(4, 4, 1), 0.1, 0.2), false),
                             Vec3(0, 0, 100), Vec3::Zero());
    scene.shapes.push_back(build_shape(test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1), true));
    add_floe(scene, 1, 900.0, Vec3(0, 0, 0), Quaternion::Identity(), 0, false);
    add_floe(scene, 1, 500.0, Vec3(0.9, 0.1, 0.2),
             Quaternion(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())), 0, false);
    return scene;
}

Contact contact_at(const Vec3& point, const Vec3& normal) {
    // a flat patch of 0.01 m2
    return {1, 2, 0, 0, 0, point, normal.normalized(), -0.001, Patch{.share = 0.01}, -1, false};
}

Mat3 cross_matrix(const Vec3& r) {
    Mat3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

// K of the contact equations, from masses and inertias directly
Mat3 response(const Bodies& b, const Vec3& point) {
    Mat3 k = Mat3::Zero();
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        const Mat3 r = cross_matrix(point - b.position[i]);
        const Mat3 turn = b.orientation[i].toRotationMatrix();
        const Mat3 inertia = turn * b.inertia(i) * turn.transpose();
        k += Mat3::Identity() / b.mass[i] - r * inertia.inverse() * r;
    }
    return k;
}

struct Outcome {
    Vec3 impulse, velocity_before, velocity_after;
    Mat3 k;
};

Outcome collide(Scene& scene, const Contact& contact, const Vec3& v1, const Vec3& v2,
                const ContactLaw& law) {
    Bodies& b = scene.bodies;
    b.velocity[1] = v1;
    b.velocity[2] = v2;
    b.angular_velocity[1] = Vec3(0.3, -0.2, 0.5);
    b.angular_velocity[2] = Vec3(-0.4, 0.1, 0.2);
    std::vector<Constraint> constraints;
    build_constraints(b, {contact}, law, kDt, constraints);
    Outcome out;
    out.k = response(b, contact.point);
    out.velocity_before = relative_velocity(b, constraints[0]);
    REQUIRE(ContactSolver().resolve_impacts(b, constraints, law, kDt).converged);
    out.velocity_after = relative_velocity(b, constraints[0]);
    out.impulse =
        constraints[0].total_normal() * constraints[0].normal + constraints[0].total_tangent();
    return out;
}

}  // namespace

TEST_CASE("without friction the impulse is -(1+e) v.n / k(n), to 1e-12", "[contact][analytic]") {
    const double e = GENERATE(0.0, 0.3, 1.0);
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0.3, 0.1), Vec3(1, 0.2, 0.5));
    const Outcome o =
        collide(scene, contact, Vec3(1, 0.2, 0), Vec3(-0.5, 0, 0.1), exact_law(e, 0.0));
    const Vec3& n = contact.normal;
    const double expected = -(1.0 + e) * o.velocity_before.dot(n) / n.dot(o.k * n);
    CHECK(o.impulse.dot(n) == Near(expected).epsilon(kRounding));
    CHECK((o.impulse - expected * n).norm() <= tolerance(kRounding) * expected);
}

TEST_CASE("a sticking contact stops all sliding and keeps e of the closing speed, to 1e-12",
          "[contact][analytic]") {
    const double e = 0.3;
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0.3, 0.1), Vec3(1, 0.2, 0.5));
    const Outcome o =
        collide(scene, contact, Vec3(1, 0.2, 0), Vec3(-0.5, 0, 0.1), exact_law(e, 50.0));
    // J = K^-1 (v' - v) with v' = -e v.n n
    const Vec3& n = contact.normal;
    const Vec3 after = -e * o.velocity_before.dot(n) * n;
    const Vec3 expected = o.k.inverse() * (after - o.velocity_before);
    CHECK((o.impulse - expected).norm() <= tolerance(kRounding) * expected.norm());
    CHECK((o.velocity_after - after).norm() <= tolerance(kRounding));
}

TEST_CASE("a sliding contact has friction mu J_n against the sliding that is left, to 1e-12",
          "[contact][analytic]") {
    const double e = 0.3, mu = 0.1;
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0.3, 0.1), Vec3(1, 0.2, 0.5));
    const Outcome o = collide(scene, contact, Vec3(1, 3, 0), Vec3(-0.5, -2, 0.1), exact_law(e, mu));
    const Vec3& n = contact.normal;
    const Vec3 sliding = o.velocity_after - o.velocity_after.dot(n) * n;
    REQUIRE(sliding.norm() > 0.5);
    // J = J_n (n - mu t), t the direction of sliding: one unknown, from the normal condition
    const Vec3 direction = n - mu * sliding.normalized();
    const double normal = -(1.0 + e) * o.velocity_before.dot(n) / n.dot(o.k * direction);
    CHECK((o.impulse - normal * direction).norm() <= tolerance(kRounding) * normal);
}

TEST_CASE("a separating contact gets no impulse", "[contact]") {
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0, 0), Vec3(1, 0, 0));
    const Outcome o = collide(scene, contact, Vec3(-1, 0, 0), Vec3(1, 0, 0), exact_law(0.3, 0.3));
    CHECK(o.impulse == Vec3::Zero());
}

TEST_CASE("a contact gives b what it takes from a: momentum and angular momentum stay",
          "[contact][property]") {
    Scene scene = two_boxes();
    Bodies& b = scene.bodies;
    const auto momenta = [&] {
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
        for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
            const Mat3 r = b.rotation[i];
            linear += b.mass[i] * b.velocity[i];
            angular += b.mass[i] * b.position[i].cross(b.velocity[i]) +
                       r * b.inertia(i) * r.transpose() * b.angular_velocity[i];
        }
        return std::pair(linear, angular);
    };
    b.velocity[1] = Vec3(1, 0.3, 0);
    const ContactLaw law = exact_law(0.3, 0.3);
    std::vector<Constraint> constraints;
    build_constraints(b, {contact_at(Vec3(0.45, 0.3, 0.1), Vec3(1, 0.2, 0.5))}, law, kDt,
                      constraints);
    const auto before = momenta();
    ContactSolver().resolve_impacts(b, constraints, law, kDt);
    const auto after = momenta();
    CHECK(constraints[0].total_normal() > 1.0);
    CHECK((after.first - before.first).norm() <= tolerance(kRounding) * before.first.norm());
    CHECK((after.second - before.second).norm() <= tolerance(kRounding) * before.first.norm());
}

TEST_CASE("crushing bounds the impulse by pressure x area x dt and takes the rebound away",
          "[contact][analytic]") {
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0, 0), Vec3(1, 0, 0));
    ContactLaw law = exact_law(0.3, 0.0);
    law.crushing_pressure = 2e5;  // 0.2 MPa on 0.01 m2 for 0.01 s: 20 N s
    const Outcome o = collide(scene, contact, Vec3(5, 0, 0), Vec3(-5, 0, 0), law);
    CHECK(o.impulse.norm() == Near(20.0).epsilon(kRounding));
    CHECK(o.velocity_after.dot(contact.normal) < 0.0);
}

TEST_CASE("a contact that can stop but not throw back its body leaves it at rest",
          "[contact][analytic]") {
    Scene scene = two_boxes();
    const Contact contact = contact_at(Vec3(0.45, 0, 0), Vec3(1, 0, 0));
    const Outcome free =
        collide(scene, contact, Vec3(1, 0, 0), Vec3(-1, 0, 0), exact_law(0.3, 0.0));
    Scene again = two_boxes();
    ContactLaw law = exact_law(0.3, 0.0);
    law.crushing_pressure = 0.9 * free.impulse.norm() / (0.01 * 0.01);
    const Outcome o = collide(again, contact, Vec3(1, 0, 0), Vec3(-1, 0, 0), law);
    CHECK(o.velocity_after.dot(contact.normal) == Near(0.0).margin(kRounding));
}

TEST_CASE("a warm start's tangent lies in the new tangent plane and in its cone", "[contact]") {
    std::vector<Contact> contacts(1);
    contacts[0].b = 1;
    contacts[0].key = 5;
    std::vector<Constraint> last(1), now(1);
    last[0].rest_normal = 2.0;
    last[0].rest_tangent = Vec3(0.5, 0, 0);
    WarmStart warm;
    warm.remember(contacts, last, {0});
    now[0].normal = Vec3(1, 0, 1).normalized();
    now[0].max_impulse = std::numeric_limits<double>::infinity();
    now[0].friction = 0.1;
    now[0].can_move = true;
    warm.recall(contacts, now);
    CHECK(now[0].rest_normal == 2.0);
    // (1/2, 0, 0) less its part along the normal is (1/4, 0, -1/4), longer than 0.1 x 2 N s
    CHECK((now[0].rest_tangent - 0.2 * Vec3(1, 0, -1).normalized()).norm() < tolerance(1e-15));
    std::vector<Constraint> stuck(1);
    stuck[0].max_impulse = now[0].max_impulse;
    stuck[0].can_move = false;
    warm.recall(contacts, stuck);
    CHECK(stuck[0].rest_normal == 0.0);
    warm.remember(contacts, last, {});  // took no part
    now[0].rest_normal = 0.0;
    warm.recall(contacts, now);
    CHECK(now[0].rest_normal == 0.0);
}

TEST_CASE("a warm start finds each contact's own impulse by bodies and key", "[contact]") {
    // pairs in order, keys in any: what a contact had tells who it was
    const std::vector<std::array<int, 3>> then = {{0, 2, 9}, {0, 2, 1}, {0, 2, 5},
                                                  {1, 2, 5}, {1, 3, 7}, {1, 3, 2}};
    const std::vector<std::array<int, 3>> now = {{0, 1, 5}, {0, 2, 1}, {0, 2, 3}, {0, 2, 9},
                                                 {1, 2, 1}, {1, 3, 2}, {2, 3, 5}};
    const auto impulse_of = [](const std::array<int, 3>& c) {
        return 100.0 * c[0] + 10.0 * c[1] + c[2];
    };
    const auto contacts_of = [](const std::vector<std::array<int, 3>>& rows) {
        std::vector<Contact> out(rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
            out[k].a = rows[k][0];
            out[k].b = rows[k][1];
            out[k].key = static_cast<std::uint64_t>(rows[k][2]);
        }
        return out;
    };
    std::vector<Constraint> last(then.size()), next(now.size());
    for (std::size_t k = 0; k < then.size(); ++k) {
        last[k].rest_normal = impulse_of(then[k]);
        last[k].rest_tangent.setZero();
    }
    for (Constraint& c : next) {
        c.normal = Vec3::UnitZ();
        c.max_impulse = std::numeric_limits<double>::infinity();
        c.friction = 0.1;
        c.can_move = true;
    }
    std::vector<std::int32_t> all(last.size());
    std::iota(all.begin(), all.end(), 0);
    WarmStart warm;
    warm.remember(contacts_of(then), last, all);
    warm.recall(contacts_of(now), next);
    for (std::size_t k = 0; k < now.size(); ++k) {
        CAPTURE(k);
        const bool known = std::find(then.begin(), then.end(), now[k]) != then.end();
        CHECK(next[k].rest_normal == (known ? impulse_of(now[k]) : 0.0));
    }
}

namespace {

// Floes of one mass in a row, `gap` apart, of which the first goes at `speed`; nothing has met yet.
struct Row {
    Scene scene = make_scene(build_shape(test::make_box_set(Vec3(4, 4, 1), 0.1, 0.2), false),
                             Vec3(0, 0, 100), Vec3::Zero());
    std::vector<Constraint> constraints;
    const ContactLaw law = exact_law(0.3, 0.0);

    Row(std::int32_t floes, double gap, double speed) {
        scene.shapes.push_back(build_shape(test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1), true));
        std::vector<Contact> contacts;
        for (std::int32_t k = 1; k <= floes; ++k) {
            const double x = (1.0 + gap) * k;
            add_floe(scene, 1, 900.0, Vec3(x, 0, 0), Quaternion::Identity(), 0, false);
            if (k == floes) break;
            contacts.push_back(contact_at(Vec3(x + 0.5 * (1.0 + gap), 0, 0), Vec3::UnitX()));
            contacts.back().a = k;
            contacts.back().b = k + 1;
            contacts.back().gap = gap;
        }
        scene.bodies.velocity[1] = Vec3(speed, 0, 0);
        build_constraints(scene.bodies, contacts, law, kDt, constraints);
    }
    SolveReport impact() {
        return ContactSolver().resolve_impacts(scene.bodies, constraints, law, kDt);
    }
    SolveReport rest() { return ContactSolver().resolve_rest(scene.bodies, constraints, law, kDt); }
    // The first `moved` floes share the momentum, each slower than the one behind it by gap / dt;
    // the next one still rests.
    void check_moved(std::size_t moved, double gap, double first_speed) const {
        const double n = static_cast<double>(moved), step = gap / kDt;
        const double least = (first_speed - 0.5 * n * (n - 1.0) * step) / n;
        const auto speed = [&](std::size_t floe) { return scene.bodies.velocity[floe].x(); };
        for (std::size_t k = 1; k <= moved; ++k)
            CHECK(speed(k) == Near(least + static_cast<double>(moved - k) * step).epsilon(1e-9));
        CHECK(speed(moved + 1) == 0.0);
        CHECK(constraints[moved - 1].rest_normal == 0.0);
    }
};

}  // namespace

TEST_CASE("a push goes on through floes whose gaps it closes within the step, and no further",
          "[contact][analytic]") {
    Row row(4, 0.001, 0.5);
    REQUIRE(row.rest().converged);
    row.check_moved(3, 0.001, 0.5);
}

TEST_CASE("an impact goes through floes that touch, whatever the rounding of their gaps",
          "[contact][analytic]") {
    Row open(4, 1e-12, 0.5), pressed(4, -1e-12, 0.5);
    for (Row* row : {&open, &pressed}) REQUIRE(row->impact().converged);
    for (std::size_t k = 1; k <= 4; ++k)
        CHECK(open.scene.bodies.velocity[k].x() ==
              Near(pressed.scene.bodies.velocity[k].x()).margin(1e-9));
    // The floes that touched move as one. The first one parts from them at e times its speed.
    CHECK(open.scene.bodies.velocity[4].x() == Near(0.5 * 1.3 / 4.0).margin(1e-9));
    Row apart(4, 1e-5, 0.5);  // the first meets the second, which meets the third a step later
    REQUIRE(apart.impact().converged);
    CHECK(apart.scene.bodies.velocity[2].x() == Near(0.5 * 1.3 / 2.0).epsilon(1e-9));
    CHECK(apart.scene.bodies.velocity[3].x() == 0.0);
}

TEST_CASE("a push that goes on through more floes than there are solutions is not converged",
          "[contact][analytic]") {
    // each solution meets one floe more: six of the eight have moved after five
    Row row(8, 0.0002, 0.5);
    CHECK_FALSE(row.rest().converged);
    row.check_moved(6, 0.0002, 0.5);
}

TEST_CASE("ice that two hull spheres crush in one place is displaced once", "[contact][crushing]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 4, 0.4), 0.1, 0.2, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.4), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0, 0, -0.19), Quaternion::Identity(), 0, false);
    std::vector<Contact> contacts(2);
    std::vector<Constraint> constraints(2);
    for (std::size_t k = 0; k < 2; ++k) {
        contacts[k].crushes_a = false;
        contacts[k].sphere_b = 7;
        constraints[k].a = 0;
        constraints[k].b = 1;
        constraints[k].normal = -Vec3::UnitZ();
        constraints[k].arm_a = constraints[k].arm_b = Vec3::Zero();
        constraints[k].gap = -0.01;
        constraints[k].max_impulse = constraints[k].impact_normal = 1.0;
    }
    ContactLaw law;
    law.crushing_pressure = 1e6;
    Overlaps().crush(w.scene, contacts, constraints, law, kDt);
    CHECK((w.scene.crushed.displacement_of(1, 7) - Vec3(0, 0, -0.01)).norm() < tolerance(1e-15));
}
