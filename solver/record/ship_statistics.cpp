// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/ship_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "common/base/assert.hpp"
#include "common/base/time_rounding.hpp"
#include "common/base/units.hpp"
#include "solver/record/periodogram.hpp"
#include "solver/record/statistics.hpp"
#include "solver/ship/delivered_power.hpp"

namespace ice {

namespace {

// A ship slower than this [m/s] for this time [s] counts as stuck in ice: it is noted in
// the summary, and nothing else depends on it. Larger speeds or shorter times note ramming, too.
constexpr double kSlow = 0.1;
constexpr double kStuckTime = 10.0;
// Ordinates of the periodogram that are searched for a period [-]: the shortest is a 400th of the
// series. More find shorter periods and take as much longer.
constexpr std::size_t kMostOrdinates = 400;

// Period of the largest ordinate of the periodogram [s]; 0 where nothing changes.
double dominant_period(const LongSeries& whole, double dt) {
    std::vector<double> series(whole.blocks().begin(), whole.blocks().end());
    const double mean =
        std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
    // The mean would be ordinate 0, and leak into the first ones.
    for (double& value : series) value -= mean;
    const std::size_t count = std::min((series.size() - 1) / 2, kMostOrdinates);
    if (count == 0 || standard_deviation(series) == 0.0) return 0.0;
    const std::vector<double> power = low_periodogram(series, count);
    // Ordinate j has j periods in the series; ordinates are counted from 1.
    const auto most = std::max_element(power.begin(), power.end()) - power.begin() + 1;
    return static_cast<double>(series.size() * whole.block_length()) * dt /
           static_cast<double>(most);
}

}  // namespace

void ShipStatistics::add(const FreeShip& ship, const Scene& scene, const Case& p, double time) {
    const Bodies& b = scene.bodies;
    const Vec3 ahead = axes_of(ship.angles()).translation.col(0);
    const double speed = ahead.dot(b.velocity[kShip]);
    // stuck: slower than 0.1 m/s for ten seconds on end
    if (std::abs(speed) >= kSlow) slow_since_ = time;
    stuck_ = stuck_ || time - slow_since_ >= kStuckTime;
    if (time < p.average_from - kTimeRounding) return;
    // Speed along the heading, not along x: a ship that yaws still advances.
    speed_.add(speed);
    thrust_.add(ship.loads().thrust);
    tow_.add(ship.loads().tow.force.x());
    mooring_.add(ship.loads().mooring.force.x());
    // the water's own speed is along the course
    power_ += delivered_power(p.propulsion, ship.loads().thrust, speed - p.current[0]);
    const ShipRig& rig = ship.rig();
    const Vec3 centre = b.position[kShip] + b.rotation[kShip] * rig.body.centre_of_gravity;
    const Vec3 off = centre - rig.anchor;
    const ShipAngles& turned = ship.angles();
    for (int k = 0; k < 6; ++k) {
        const double value = k < 3 ? off[k] : turned[k - 3];
        sum_[static_cast<std::size_t>(k)] += value;
        square_[static_cast<std::size_t>(k)] += value * value;
    }
}

FreeTravel ShipStatistics::travel(const FreeShip& ship, const Scene& scene, const Case& p) const {
    ICE_ASSERT(ship.is_free());
    const Bodies& b = scene.bodies;
    const ShipRig& rig = ship.rig();
    const Vec3 centre = b.position[kShip] + b.rotation[kShip] * rig.body.centre_of_gravity;
    const double mean = speed_.empty() ? b.velocity[kShip].x() : speed_.mean();
    return {rig.equilibrium.height, mean, centre.x() - rig.anchor.x(),
            mean * p.time_step * static_cast<double>(speed_.count())};
}

void ShipStatistics::fill(const FreeShip& ship, const Scene& scene, const Case& p,
                          Summary& summary) const {
    ICE_ASSERT(ship.is_free());
    const ShipRig& rig = ship.rig();
    std::map<std::string, double> out;
    out["mass_kg"] = rig.body.mass;
    if (rig.body.free[roll]) out["gm_m"] = rig.equilibrium.gm_transverse;
    // a moored ship is meant to stay
    if (rig.body.free[surge] && p.mooring.stiffness[surge] == 0.0) summary.ship.stuck = stuck_;

    const ShipEnergies& e = ship.energies();
    auto& energy = summary.energy;
    // (S3): changes since the start; the residual is the rest that no entry explains
    const double kinetic = ship.kinetic_energy(scene.bodies) - e.kinetic_start.value_or(0.0);
    const double potential = ship.potential_energy(scene, p) - e.potential_start.value_or(0.0);
    energy["thrust_work_J"] = e.thrust;
    energy["tow_work_J"] = e.tow;
    energy["mooring_work_J"] = e.mooring;
    energy["ship_ice_work_J"] = e.ice;
    energy["ship_losses_J"] = e.losses;
    energy["ship_separation_J"] = e.separation;
    energy["ship_kinetic_J"] = kinetic;
    energy["ship_potential_J"] = potential;
    energy["ship_residual_J"] = e.residual(kinetic + potential);
    if (!speed_.empty()) fill_means(rig, p, out);
    summary.ship.motion = {out.begin(), out.end()};
}

void ShipStatistics::fill_means(const ShipRig& rig, const Case& p,
                                std::map<std::string, double>& out) const {
    const MeanInterval speed = mean_interval(speed_);
    out["speed_ci95"] = speed.half_width;
    out["speed_std"] = speed_.standard_deviation();
    const double period = dominant_period(speed_, p.time_step);
    out["surge_period_s"] = period;
    // of a sinusoid with that period and the speed's deviation
    out["surge_amplitude_m"] =
        std::numbers::sqrt2 * out["speed_std"] * period / (2.0 * std::numbers::pi);
    out["thrust_mean_N"] = thrust_.mean();
    if (p.tow.stiffness > 0.0) {
        out["tow_fx_mean_N"] = tow_.mean();
        out["tow_fx_std_N"] = tow_.standard_deviation();
    }
    if (rig.body.free[surge] && p.mooring.stiffness[surge] > 0.0) {
        out["mooring_fx_mean_N"] = mooring_.mean();
        out["mooring_fx_std_N"] = mooring_.standard_deviation();
    }
    const auto steps = static_cast<double>(speed_.count());
    if (std::isfinite(power_)) out["delivered_power_mean_W"] = power_ / steps;
    constexpr const char* kNames[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    const bool moored = p.mooring.stiffness[surge] > 0.0;
    for (std::size_t k = 0; k < kFreedoms; ++k) {
        if (!rig.body.free[k] || (k == surge && !moored)) continue;
        const double unit = k < 3 ? 1.0 : kDegreesPerRadian;
        const char* const suffix = k < 3 ? "m" : "deg";
        const double mean = sum_[k] / steps;
        const std::string name(kNames[k]);
        out[name + "_mean_" + suffix] = unit * mean;
        out[name + "_std_" + suffix] =
            // Variance as mean of squares less square of the mean: rounding may take it below 0.
            unit * std::sqrt(std::max(0.0, square_[k] / steps - mean * mean));
    }
}

}  // namespace ice
