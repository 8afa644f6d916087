// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts and the removal of overlap never add energy, in a frame where the ship is at rest.
//
// Tolerances: 1e-6 is the error of the free rotation's integration, see motion_test.
#include <catch2/catch.hpp>
#include <random>

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/integrate/integrate.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/validation/table.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

enum class Meeting { head_on, offset_with_spin, wedge, non_convex, wall };

// Numbers of one seed: uniform in [-1, 1].
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }
    Vec3 vector(double size) {
        const double x = number(), y = number(), z = number();
        return size * Vec3(x, y, z);
    }
    Quaternion turn(double most) {
        const double angle = most * number();
        return Quaternion(Eigen::AngleAxisd(angle, vector(1.0).normalized()));
    }

private:
    std::mt19937 engine_;
};

// An L, 0.9 x 0.9 m and 0.3 m thick, 1 m broad: its corner catches the other one's arm.
SphereSet angle_iron() {
    const std::vector<Vec3> corner = {{0, 0, 0},     {0.9, 0, 0},   {0.9, 0, 0.3},
                                      {0.3, 0, 0.3}, {0.3, 0, 0.9}, {0, 0, 0.9}};
    Section section;
    section.loops.emplace_back();
    for (std::size_t k = 0; k < corner.size(); ++k) {
        const Vec3& a = corner[k];
        const Vec3& b = corner[(k + 1) % corner.size()];
        const Vec3 along = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(along.z(), 0, -along.x()), 0});
    }
    FillOptions options;
    options.radius = 0.05;
    options.surface_only = true;
    SpheresReport report;
    return fill_spheres(extrude(section, {"hull"}), options, report);
}

const SphereSet& floe_set(Meeting meeting) {
    static const SphereSet box = test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1);
    static const SphereSet angle = angle_iron();
    return meeting == Meeting::non_convex ? angle : box;
}

void add_moving(World& w, const Vec3& position, const Quaternion& turn, const Vec3& velocity,
                const Vec3& spin, std::int32_t group = 0) {
    Bodies& b = w.scene.bodies;
    const std::size_t i = add_floe(w.scene, 1, 900.0, position, turn, group, false);
    b.momentum[i] = b.mass[i] * velocity;
    b.angular_momentum[i] = turn * (b.inertia(i) * (turn.conjugate() * spin));
    update_derived(b, i);
}

// The solver's defaults; what it leaves unsolved is part of the question.
World meeting_world(Meeting meeting, const Case& parameters, unsigned seed) {
    World w = test::plate_world(parameters, Vec3(8, 4, 0.4), 0.1, 0.2,
                                meeting == Meeting::wall ? 0.7 : 50.0);
    test::add_shape(w, floe_set(meeting));
    Random r(seed);
    const auto both = [&](double pose, double speed, double spin) {
        for (const double side : {-1.0, 1.0}) {
            const Vec3 at = Vec3(0.8 * side, 0, 0) + r.vector(pose);
            const Quaternion turn = r.turn(pose > 0.0 ? 3.1 : 0.0);
            const Vec3 velocity = Vec3(-1.5 * side, 0, 0) + r.vector(speed);
            add_moving(w, at, turn, velocity, r.vector(spin));
        }
    };
    if (meeting == Meeting::head_on) both(0.0, 0.0, 0.0);
    if (meeting == Meeting::offset_with_spin || meeting == Meeting::non_convex) both(0.1, 0.3, 2.0);
    if (meeting == Meeting::wedge) {
        // a floe on its side runs between two held blocks that leave it too little room
        w.parameters.floes.resize(2);
        w.parameters.floes[0].hold = Hold::always;
        w.parameters.floes[1].hold = Hold::never;
        const double gap = 0.15 + 0.1 * r.number();
        for (const double side : {-1.0, 1.0})
            add_floe(w.scene, 1, 900.0, Vec3(0, side * (0.4 + gap), 0),
                     Quaternion(Eigen::AngleAxisd(0.15 * side, Vec3::UnitZ())), 0, true);
        const Quaternion on_edge(Eigen::AngleAxisd(1.57, Vec3::UnitX()));
        const Vec3 at = Vec3(-1.3, 0, 0) + r.vector(0.05);
        const Vec3 velocity = Vec3(2, 0, 0) + r.vector(0.3);
        add_moving(w, at, on_edge * r.turn(0.3), velocity, r.vector(0.3), 1);
    }
    if (meeting == Meeting::wall) {
        const Vec3 at = Vec3(0, 0, -0.1) + r.vector(0.1);
        const Quaternion turn = r.turn(3.1);
        const Vec3 velocity = Vec3(0, 0, 2) + r.vector(0.5);
        add_moving(w, at, turn, velocity, r.vector(2.0));
    }
    return w;
}

// Energy of the floes' momenta in the pose that `inverse_inertia` was taken in: what contacts did
// to it, without the free rotation's own wobble (1e-6, see there).
double energy_of(const Bodies& b, const std::vector<Mat3>& inverse_inertia) {
    double energy = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i)
        if (!b.held[i])
            energy += 0.5 * (b.momentum[i].squaredNorm() / b.mass[i] +
                             b.angular_momentum[i].dot(inverse_inertia[i] * b.angular_momentum[i]));
    return energy;
}

// An unsolved rest r [m/s] of the contact conditions can do at most the work sum |J| r; twice that
// where both stages leave one.
double work_of_residual(const World& w) {
    double impulses = 0.0;
    for (const Constraint& c : w.constraints)
        impulses += c.total_normal() + c.total_tangent().norm();
    return 2.0 * impulses * std::max(w.impacts.residual, w.rest.residual);
}

struct Gain {
    double raw = 0.0;     // largest gain of energy in a step, as a share of the initial energy
    double beyond = 0.0;  // the same less the work of the residual
    double event = 0.0;   // gain over all steps
    bool met = false;
};

Gain run_meeting(World& w) {
    Bodies& b = w.scene.bodies;
    const double start = energy_of(b, b.inverse_inertia_world);
    Gain out;
    for (int k = 0; k < 150; ++k) {
        const std::vector<Mat3> pose = b.inverse_inertia_world;
        const double before = energy_of(b, pose);
        step(w);
        const double gain = energy_of(b, pose) - before;
        out.raw = std::max(out.raw, gain / start);
        out.beyond = std::max(out.beyond, (gain - work_of_residual(w)) / start);
        for (const Constraint& c : w.constraints) out.met = out.met || c.total_normal() > 0.0;
    }
    out.event = energy_of(b, b.inverse_inertia_world) / start - 1.0;
    return out;
}

Case law(double restitution, double friction, NormalRule rule) {
    Case p = test::empty_space(0.01);
    p.contact.restitution = restitution;
    p.contact.friction_ship_ice = p.contact.friction_ice_ice = friction;
    p.normal = rule;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    return p;
}

constexpr unsigned kSeeds = 60;

}  // namespace

TEST_CASE("contacts never add energy: head-on, with spin, wedged, non-convex, against a wall",
          "[validation][conservation]") {
    const auto [name, meeting] =
        GENERATE(std::pair("two floes head-on", Meeting::head_on),
                 std::pair("two floes, any pose and spin", Meeting::offset_with_spin),
                 std::pair("floe wedged between two held ones", Meeting::wedge),
                 std::pair("two L-shaped floes, any pose and spin", Meeting::non_convex),
                 std::pair("floe against a wall, any pose and spin", Meeting::wall));
    const NormalRule rule = GENERATE(NormalRule::surface, NormalRule::centres);
    const auto [e, mu] = GENERATE(std::pair(0.0, 0.0), std::pair(0.0, 0.3), std::pair(0.3, 0.0),
                                  std::pair(0.3, 0.3), std::pair(0.5, 0.3), std::pair(1.0, 0.0));
    int met = 0;
    const unsigned seeds = meeting == Meeting::head_on ? 1 : kSeeds;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        World w = meeting_world(meeting, law(e, mu, rule), seed);
        const Gain gain = run_meeting(w);
        CAPTURE(name, seed, e, mu, gain.raw);
        met += gain.met;
        // 1e-12: rounding, of a hundred contacts
        test::validate({std::string(name) + ": energy gained in a step, of the initial one", "",
                        0.0, gain.beyond, test::within(1e-12),
                        "contacts only lose energy; less the work of the solver's residual"});
        if (e < 1.0) CHECK(gain.event <= tolerance(1e-6));  // the free rotation's own wobble
    }
    CHECK(met >= static_cast<int>(0.9 * seeds));
}

TEST_CASE("oblique hits with friction lose energy also where Newton's restitution would add it",
          "[validation][conservation]") {
    // e = 1 and mu = 0.3: the law alone gains up to a third of the energy (Kane and Levinson, 1985)
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
        World w = meeting_world(Meeting::wall, law(1.0, 0.3, NormalRule::surface), seed);
        test::validate({"floe against a wall at e = 1 with mu = 0.3: energy gained in a step", "",
                        0.0, run_meeting(w).beyond, test::within(1e-12),
                        "the rebound is weakened until nothing is gained"});
    }
}

TEST_CASE("a touching row that is opening when it is struck gains no energy",
          "[validation][conservation]") {
    // the opening contact may close with e of its speed (Moreau); were it stopped, masses 1 with
    // speeds 10, 0, 1 m/s (50.5 J) would go on with (-3, 7, 7) at e = 1 (53.5 J)
    const double e = GENERATE(0.3, 1.0);
    World w = test::plate_world(law(e, 0.0, NormalRule::surface), Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    test::add_shape(w, floe_set(Meeting::head_on));
    w.parameters.contact.iterations = 1000;
    w.parameters.contact.tolerance = 1e-12;
    const double speed[] = {10.0, 0.0, 1.0};
    for (int k = 0; k < 3; ++k)
        add_moving(w, {k * (1.0 - 1e-6), 0, 0}, Quaternion::Identity(), {speed[k], 0, 0},
                   {0, 0, 0});
    const double before = kinetic_energy(w.scene.bodies);
    step(w);
    const double gain = kinetic_energy(w.scene.bodies) / before - 1.0;
    test::validate({"touching row of three, opening, struck without friction: energy gained", "",
                    0.0, gain, test::at_most_expected(), "contacts only lose energy"});
}

TEST_CASE("removing overlap moves floes, and nothing else: no force, no speed",
          "[validation][conservation]") {
    const double depth = GENERATE(0.01, 0.05);
    World w = test::plate_world(law(0.3, 0.3, GENERATE(NormalRule::surface, NormalRule::centres)),
                                Vec3(8, 4, 0.4), 0.1, 0.2, 0.15 - depth);
    test::add_shape(w, floe_set(Meeting::head_on));
    const Quaternion level = Quaternion::Identity();
    for (const double z : {0.0, -0.3 + depth})
        add_moving(w, Vec3(0, 0, z), level, {0, 0, 0}, {0, 0, 0});
    double force = 0.0, overlap = 0.0, first = 0.0;
    for (int k = 0; k < 400; ++k) {
        step(w);
        overlap = 0.0;
        for (const Constraint& c : w.constraints) {
            force += c.total_normal() + c.total_tangent().norm();
            overlap = std::max(overlap, -c.gap);
        }
        if (k == 0) first = overlap;
    }
    REQUIRE(first > 0.9 * depth);
    test::validate({"floes and hull overlapping at rest: impulses in 400 steps", "N s", 0.0, force,
                    test::within(0.0), "overlap is removed from poses"});
    test::validate({"floes and hull overlapping at rest: kinetic energy afterwards", "J", 0.0,
                    kinetic_energy(w.scene.bodies), test::within(0.0), "the same"});
    // overlaps.cpp leaves a fiftieth of a radius, so that contacts that just touch stay contacts
    const double left = kToleratedOverlap * w.scene.shapes[1].largest_radius;
    test::validate({"floes and hull overlapping at rest: overlap afterwards", "m", left, overlap,
                    test::within(2e-5), "all but the fiftieth of a radius that is left alone"});
}

TEST_CASE("a floe turning freely keeps its angular momentum and energy",
          "[validation][conservation]") {
    World w = test::plate_world(law(0.3, 0.3, NormalRule::surface), Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    test::add_shape(w, floe_set(Meeting::head_on));
    // near the unstable middle axis: the worst case for an integrator; |w| dt = 0.05
    const Vec3 spin = 5.0 * Vec3(0.1, 1.0, 0.1).normalized();
    add_moving(w, {0, 0, 0}, Quaternion::Identity(), {0, 0, 0}, spin);
    const Bodies& b = w.scene.bodies;
    const Vec3 momentum = b.angular_momentum[1];
    const double energy = kinetic_energy(b);
    double worst = 0.0;
    for (int k = 0; k < 10000; ++k) {
        step(w);
        worst = std::max(worst, std::abs(kinetic_energy(b) / energy - 1.0));
    }
    test::validate({"torque-free rotation, 10000 steps of w dt = 0.05: angular momentum", "", 0.0,
                    (b.angular_momentum[1] - momentum).norm() / momentum.norm(),
                    test::within(1e-13), "it is the state"});
    test::validate({"torque-free rotation, 10000 steps of w dt = 0.05: energy", "", 0.0, worst,
                    test::within(1e-6), "rule (18) keeps it to fourth order"});
}
