// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "solver/record/statistics.hpp"

namespace ice {

namespace {

// Steps beyond this share that did not converge are worth a warning; a jam always is.
constexpr double kWorthWarning = 0.01;

// ... and so is a mean of which this share comes from a hundredth of the steps.
constexpr double kWorryingPeaks = 0.2;

// Share of sum |f| that the 1 % of steps with the largest |f| carry; 0 for fewer than 100 steps.
double share_of_largest(std::vector<double> force) {
    if (force.size() < 100) return 0.0;
    for (double& f : force) f = std::abs(f);
    std::sort(force.begin(), force.end(), std::greater<>());
    const auto few = force.begin() + static_cast<std::ptrdiff_t>(force.size() / 100);
    const double all = std::accumulate(force.begin(), force.end(), 0.0);
    return all > 0.0 ? std::accumulate(force.begin(), few, 0.0) / all : 0.0;
}

// @param contact, friction  sums of its parts over the same steps
ForceStatistics statistics(const std::vector<double>& total, double contact, double friction,
                           double sign) {
    ForceStatistics out;
    const MeanInterval interval = batch_means(total);
    out.mean = sign * interval.mean + 0.0;  // no -0
    out.ci95 = interval.half_width;
    const auto steps = static_cast<double>(total.size());  // of none the means are no number
    out.contact_mean = sign * (contact / steps) + 0.0;
    out.friction_mean = sign * (friction / steps) + 0.0;
    out.std = standard_deviation(total);
    for (const double force : total)
        if (std::abs(force) > std::abs(out.max)) out.max = sign * force;
    return out;
}

}  // namespace

Tally::Tally(TallyOptions options)
    : options_(std::move(options)), regions_(options_.region_names.size()) {}

void Tally::add(const StepRecord& record, double time, double dt, bool converged) {
    ++steps_;
    unconverged_ += converged ? 0 : 1;
    contacts_ += record.contacts;
    contacts_max_ = std::max<double>(contacts_max_, record.contacts);
    if (record.max_overlap > max_overlap_) {
        max_overlap_ = record.max_overlap;
        deepest_time_ = time;
    }
    if (record.closing_speed > closing_speed_) {
        closing_speed_ = record.closing_speed;
        closing_time_ = time;
        closing_a_ = record.closing_a;
        closing_b_ = record.closing_b;
    }
    kinetic_ = record.kinetic_energy;
    kinetic_max_ = std::max(kinetic_max_, kinetic_);
    add_jam(record, time);

    const bool averaged = time >= options_.average_from - 1e-9;
    add_regions(record, averaged);
    if (!averaged) return;
    averaged_time_ += dt;
    contact_ += record.contact_force;
    friction_ += record.friction_force;
    for (int d = 0; d < 3; ++d)
        total_[d].push_back(record.contact_force[d] + record.friction_force[d]);
}

void Tally::add_regions(const StepRecord& record, bool averaged) {
    std::set<std::pair<std::int32_t, std::int32_t>> now;
    for (const RegionImpulse& r : record.regions) {
        Region& region = regions_[static_cast<std::size_t>(r.region)];
        now.emplace(r.floe, r.region);
        if (!touching_.contains({r.floe, r.region})) ++region.hits;
        region.max_impulse = std::max(region.max_impulse, r.impulse.norm());
        if (!averaged) continue;
        region.impulse += r.impulse;
        region.friction += r.friction;
    }
    touching_.swap(now);
}

void Tally::add_jam(const StepRecord& record, double time) {
    if (record.jammed_contacts == 0) return;
    if (jammed_steps_++ > 0) return;
    first_jam_time_ = time;
    first_jam_floe_ = record.jammed_floe;
    first_jam_point_ = record.jam_point;
}

void Tally::fill(Summary& summary) const {
    summary.average_from = options_.average_from;
    // resistance is positive when it slows the ship
    summary.resistance = statistics(total_[0], contact_.x(), friction_.x(), -1.0);
    summary.lateral = statistics(total_[1], contact_.y(), friction_.y(), 1.0);
    summary.vertical = statistics(total_[2], contact_.z(), friction_.z(), 1.0);
    for (std::size_t r = 0; r < regions_.size(); ++r) {
        RegionStatistics& out = summary.regions[options_.region_names[r]];
        out.hits = regions_[r].hits;
        out.max_impulse = regions_[r].max_impulse;
        if (averaged_time_ <= 0.0) continue;
        const Vec3 friction = regions_[r].friction, contact = regions_[r].impulse - friction;
        for (int d = 0; d < 3; ++d) {
            const auto k = static_cast<std::size_t>(d);
            out.mean[k] = regions_[r].impulse[d] / averaged_time_;
            out.contact_mean[k] = contact[d] / averaged_time_;
            out.friction_mean[k] = friction[d] / averaged_time_;
        }
    }
    const double steps = std::max<double>(1.0, static_cast<double>(steps_));
    summary.contacts_mean = contacts_ / steps;
    summary.contacts_max = contacts_max_;
    summary.max_overlap = max_overlap_;
    summary.unconverged_steps = unconverged_;
    summary.energy["kinetic_J"] = kinetic_;
    summary.energy["kinetic_max_J"] = kinetic_max_;
    warn(summary);
}

void Tally::warn(Summary& summary) const {
    const double steps = std::max<double>(1.0, static_cast<double>(steps_));
    if (static_cast<double>(unconverged_) > kWorthWarning * steps)
        summary.warnings.push_back(
            {fmt::format("{} of {} steps ({:.0f} %) did not reach contact.tolerance within "
                         "contact.iterations; "
                         "raise the iterations, and trust the mean if it stays within its interval",
                         unconverged_, steps_, 100.0 * static_cast<double>(unconverged_) / steps)});
    if (jammed_steps_ > 0)
        summary.warnings.push_back({fmt::format(
            "jam: in {} of {} steps a floe squeezed between the hull and other ice could not "
            "give "
            "way, first floe {} at t = {:.2f} s, x = {:.2f}, y = {:.2f}, z = {:.2f} m; {}",
            jammed_steps_, steps_, first_jam_floe_, first_jam_time_, first_jam_point_.x(),
            first_jam_point_.y(), first_jam_point_.z(),
            options_.rigid ? "with rigid contact the force there depends on time_step and "
                             "iterations: set contact.crushing_pressure"
                           : "the solver ran out of iterations there: raise contact.iterations")});
    const double peaks = share_of_largest(total_[0]);
    if (peaks > kWorryingPeaks)
        summary.warnings.push_back(
            {fmt::format("{:.0f} % of the force along x comes from 1 % of "
                         "the steps: squeezed or hit floes, not "
                         "sliding ones, decide the mean",
                         100.0 * peaks)});
    if (max_overlap_ > options_.worrying_overlap)
        summary.warnings.push_back(
            {fmt::format("overlap reached {:.1f} mm at t = {:.2f} s: bodies were pushed through "
                         "each other; "
                         "lower time_step, raise contact.iterations or contact.crushing_pressure",
                         1e3 * max_overlap_, deepest_time_)});
    warn_of_tunnelling(summary);
    if (contacts_max_ == 0.0)
        summary.warnings.push_back(
            {"nothing touched anything: is the hull on its way to the ice?", true});
}

void Tally::warn_of_tunnelling(Summary& summary) const {
    if (closing_speed_ <= options_.tunnelling_speed) return;
    summary.warnings.push_back({fmt::format(
        "{} and floe {} met at {:.3g} m/s at t = {:.2f} s; above {:.3g} m/s, a contact "
        "sphere's "
        "diameter per step, bodies may pass through each other: lower simulation.time_step",
        closing_a_ == 0 ? std::string("the hull") : fmt::format("floe {}", closing_a_), closing_b_,
        closing_speed_, closing_time_, options_.tunnelling_speed)});
}

}  // namespace ice
