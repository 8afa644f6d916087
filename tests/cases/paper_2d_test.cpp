// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's 2D observations (its Figures 3 to 6) on the recorded trajectories and forces.
//
// Tolerances: 1e-9 is rounding of a sum over the steps; 0.5 % of the work is the bound of the
// energy ledger's warning.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/cases/run_view.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::CaseRun;

namespace {

// The hull of meshes/paper-hull-2d.obj in the ship frame [m].
constexpr double kBowSlope = 35.0;  // degrees; the bow rises forwards
constexpr double kBowFoot = 7.858, kKeel = -1.2, kBottomEnd = 2.4, kSlopeEnd = 1.2;

// What happened to a floe, in the order of the paper's Figure 3 (a) to (f).
struct Story {
    bool turned = false;     // lies along the bow, within 10 degrees of its slope, touching it
    bool slid = false;       // ... and got at least 0.5 m deeper while it did
    bool under = false;      // lies along the bottom, within 10 degrees, touching the hull
    bool propeller = false;  // touches the slope of the propeller region, pushing forwards
    bool behind = false;     // ends behind the ship, at the surface

    bool complete() const { return turned && slid && under && propeller && behind; }
};

Story story_of(const CaseRun& run, std::size_t floe) {
    Story s;
    double first_depth = 0.0;
    for (const RunFrame& frame : run.data.frames) {
        const Vec3 at = CaseRun::in_ship(frame, floe);
        const Vec3& force = frame.contact_force[floe];  // of the ship on the floe
        const double slope = CaseRun::slope(frame.orientation[floe]);
        if (force.isZero(0.0)) continue;
        if (at.x() > kBowFoot && std::abs(slope - kBowSlope) < 10.0) {
            if (!s.turned) first_depth = at.z();
            s.turned = true;
            s.slid = s.slid || at.z() < first_depth - 0.5;
        }
        if (s.slid && at.x() > kBottomEnd && at.x() < kBowFoot && at.z() < kKeel - 0.15 &&
            std::abs(slope) < 10.0)
            s.under = true;
        if (s.under && at.x() < kBottomEnd + 0.3 && at.x() > kSlopeEnd - 0.4 && force.x() < 0.0)
            s.propeller = true;
    }
    const RunFrame& last = run.data.frames.back();
    // the piece is 1 m long: its centre is up to 0.5 m deep when it floats on end
    s.behind = CaseRun::in_ship(last, floe).x() < 0.0 && last.position[floe].z() > -0.5;
    return s;
}

struct MeanForces {
    double x = 0.0, z = 0.0;  // mean of the magnitudes [N/m]
};

// Over the whole run: the same 26 m of travel at every speed.
MeanForces mean_magnitudes(const CaseRun& run) {
    MeanForces m;
    for (const HistoryRow& row : run.data.history) {
        const Vec3 f = row.contact_force + row.friction_force;
        m.x += std::abs(f.x());
        m.z += std::abs(f.z());
    }
    const auto count = static_cast<double>(run.data.history.size());
    return {m.x / count, m.z / count};
}

}  // namespace

TEST_CASE(
    "2D: pieces turn along the bow, slide down it, lie along the bottom, hit the propeller "
    "region and end behind the ship at the surface",
    "[cases]") {
    const std::string name = GENERATE("paper-2d-u0.2", "paper-2d-u0.5", "paper-2d-u0.8");
    const CaseRun run(name);
    int complete = 0, turned = 0;
    for (std::size_t floe = 0; floe < run.floes(); ++floe) {
        const Story s = story_of(run, floe);
        complete += s.complete();
        turned += s.turned && s.slid;
    }
    CAPTURE(name, complete, turned);
    CHECK(turned >= 20);   // of the 26 that the ship meets: it happens one after another
    CHECK(complete >= 1);  // the paper follows one piece
}

TEST_CASE("2D at 1.0 m/s: pieces turn along the bow, lie along the bottom and end behind the ship",
          "[cases]") {
    const CaseRun run("paper-2d-u1.0");
    int under = 0, behind = 0;
    for (std::size_t floe = 0; floe < run.floes(); ++floe) {
        const Story s = story_of(run, floe);
        under += s.under;
        behind += s.under && s.behind;
    }
    CHECK(under >= 1);
    CHECK(behind >= 1);
}

TEST_CASE("2D: the ship travels 26 m and leaves pieces behind", "[cases]") {
    const CaseRun run(GENERATE("paper-2d-u0.2", "paper-2d-u0.5", "paper-2d-u0.8", "paper-2d-u1.0"));
    const double start = run.data.frames.front().ship_position.x();
    CHECK(run.data.history.back().ship_position.x() - start == Near(26.0).epsilon(1e-9));
    CHECK(run.summary.floes_behind >= 8);
    // the energy ledger explains the ship's work
    CHECK(std::abs(run.summary.energy.at("residual_share")) < tolerance(0.005));
}

TEST_CASE("2D: pieces push the bow backwards and the propeller region forwards", "[cases]") {
    const std::string name =
        GENERATE("paper-2d-u0.2", "paper-2d-u0.5", "paper-2d-u0.8", "paper-2d-u1.0");
    const CaseRun run(name);
    CHECK(run.summary.regions.at("bow").hits > 0);
    CHECK(run.summary.regions.at("propeller").hits > 0);
    CHECK(run.summary.regions.at("bow").mean[0] < 0.0);
    // at 1 m/s the pieces pass below the propeller region: the few that hit its first corner decide
    if (name != "paper-2d-u1.0") CHECK(run.summary.regions.at("propeller").mean[0] > 0.0);
}

TEST_CASE("2D: friction is smaller than contact force", "[cases]") {
    const CaseRun run(GENERATE("paper-2d-u0.2", "paper-2d-u0.5", "paper-2d-u0.8", "paper-2d-u1.0"));
    CHECK(run.summary.resistance.friction_mean > 0.0);
    CHECK(run.summary.resistance.friction_mean < run.summary.resistance.contact_mean);
}

TEST_CASE("2D: mean |f_x| and |f_z| grow from 0.5 over 0.8 to 1.0 m/s", "[cases]") {
    const MeanForces slow = mean_magnitudes(CaseRun("paper-2d-u0.5"));
    const MeanForces middle = mean_magnitudes(CaseRun("paper-2d-u0.8"));
    const MeanForces fast = mean_magnitudes(CaseRun("paper-2d-u1.0"));
    CHECK(middle.x > slow.x);
    CHECK(fast.x > middle.x);
    CHECK(middle.z > slow.z);
    CHECK(fast.z > middle.z);
}
