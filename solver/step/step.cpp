// SPDX-License-Identifier: GPL-3.0-or-later
// The stages have the numbers of docs/method.md, section 2.
// In:  bodies at time t.   Out: bodies at t + dt, and the impulses in world.constraints.
#include "solver/step/step.hpp"

#include <algorithm>

#include "common/base/timer.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/step/release_touched.hpp"

namespace ice {

namespace {

// Contacts are found this much [m] before they touch, beyond the motion at the bodies' speeds. More
// lists more contacts that carry nothing. With 0.2 mm the narrow phase took 8 % less time; the
// overlaps stayed, the last digits changed.
constexpr double kMargin = 5e-4;

// Least upward acceleration that the margin counts with, over gravity [-]: ice nearly as dense as
// water hardly rises, but floes also fall, pitch and are pushed. More lists more contacts that
// carry nothing; less finds those of floes that fall later and deeper.
constexpr double kLeastLift = 0.2;

// Runs one stage and adds its time to the table.
template <class Work>
void timed(World& w, Stage stage, const Work& work) {
    const Timer timer;
    work();
    w.stage_seconds[static_cast<std::size_t>(stage)] += timer.seconds();
}

// kMargin, plus the distance that buoyancy moves a floe in the step, or kLeastLift if that is more
// [m]. A floe that begins to fall through air moves farther: at steps of 0.01 s its contact
// is found when it is 0.3 mm deep.
double contact_margin(const Case& p) {
    const double lift = std::max(p.water_density / p.ice_density - 1.0, kLeastLift);
    return kMargin + lift * p.gravity * p.time_step * p.time_step;
}

// The edge of level ice breaks and follows the ship: the contacts of bodies that have another
// shape now are forgotten. Mass that comes into the scene or leaves it is no work.
void renew_edge(World& w) {
    w.edge.drift_until(w.time);
    if (!w.edge.is_due(w.scene)) return;
    const double before = potential_energy(w.scene, w.parameters);
    if (!w.edge.renew(w.scene, w.parameters, w.time)) return;
    *w.ledger.potential_start += potential_energy(w.scene, w.parameters) - before;
    w.warm_start = {};
    w.recess.forget(w.edge.changed());
    w.motion.forget(w.scene, w.edge.changed());
    w.pairs = {};
    w.finder.forget(w.edge.changed());
}

// The contacts of the step; a released floe may touch neighbours that were held with it.
void find_and_release(World& w) {
    const Case& p = w.parameters;
    do {
        timed(w, Stage::broad, [&] {
            w.motion.update(w.scene, p.time_step);
            w.pairs.update(w.scene, w.motion, contact_margin(p));
        });
        timed(w, Stage::narrow, [&] {
            w.finder.find(w.scene, w.pairs.pairs(), w.motion, ContactRule(p), p.time_step,
                          contact_margin(p), w.contacts);
        });
    } while (release_touched(w.scene, p, w.contacts));
}

}  // namespace

void begin_step(World& w) {
    release_bent(w.scene.bodies);
    w.ledger.begin(w.scene, w.parameters);
    timed(w, Stage::broad, [&] { renew_edge(w); });
}

void step(World& w) {
    const double dt = w.parameters.time_step;
    const ContactLaw& law = w.parameters.contact;
    Bodies& bodies = w.scene.bodies;
    begin_step(w);

    // 1 ship: a prescribed course takes the speed at mid-step; a free ship keeps its velocity of
    // the last step
    w.ship.start_step(w.parameters, w.scene, w.time);
    w.scene.water.follow(bodies.position[kShip], w.scene.ship_velocity);

    find_and_release(w);  // 2 broad, 3 narrow, 4 release
    w.start.take(bodies);
    // 4a recess, 5 impacts: on the velocities before the loads, so that ice at rest does not bounce
    timed(w, Stage::contact, [&] {
        build_constraints(bodies, w.contacts, law, dt, w.constraints);
        w.recess.move_spheres(w.scene, law, dt, w.contacts, w.constraints);
        w.impacts = w.solver.resolve_impacts(bodies, w.constraints, law, dt);
    });

    // 6 loads: gravity, buoyancy and drag change velocities; 7 rest: contacts then carry them
    timed(w, Stage::water, [&] {
        measure_loads(w.scene, w.parameters, w.loads);
        add_applied(bodies, w.applied_loads, w.loads);
        apply_loads(bodies, w.loads, dt);
        w.ship.apply_loads(w.parameters, w.scene, w.time);
    });
    timed(w, Stage::contact, [&] {
        w.warm_start.recall(w.contacts, w.constraints);
        w.rest = w.solver.resolve_rest(bodies, w.constraints, law, dt);
        w.warm_start.remember(w.contacts, w.constraints, w.solver.resting());
    });

    // 8 overlap that the finite step left is taken out of the poses, not of the velocities; where
    // the ice crushes, out of the ice
    timed(w, Stage::contact, [&] {
        w.crush_solids.cut(w.scene, w.contacts, w.constraints, law, dt);
        w.overlaps.correct_positions(w.scene, w.constraints, w.crush_solids.uncut(), dt,
                                     w.corrections);
        w.overlaps.crush(w.scene, w.contacts, w.constraints, law, dt);
    });
    timed(w, Stage::integrate, [&] {  // 9 move
        enter_step(w.scene, w.parameters, w.constraints, w.loads, w.corrections, w.start, w.ledger);
        w.ship.enter_step(w.scene, w.constraints, w.corrections, dt);
        advance(w.scene, {w.start.angular_velocity, w.corrections, dt});
        w.ship.turn(w.scene, w.corrections, dt);
        w.ledger.kinetic_change += kinetic_energy(bodies) - w.start.kinetic;
    });
    w.bent.find(w.scene, w.parameters, w.constraints);  // 10 bend
    w.edge.find(w.parameters, w.contacts, w.constraints);
    ++w.steps;
    w.time = static_cast<double>(w.steps) * dt;
}

}  // namespace ice
