// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/run_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "solver/record/statistics.hpp"

namespace ice {

namespace {

// @param contact, friction  sums of its parts over the same steps
// @param sign  -1 for the resistance, which is positive against +x @param dt  of a step [s]
ForceStatistics statistics(const LongSeries& total, double contact, double friction, double sign,
                           double dt) {
    ForceStatistics out;
    const MeanInterval interval = mean_interval(total);
    out.mean = sign * interval.mean + 0.0;  // no -0
    out.ci95 = interval.half_width;
    out.correlation_time = interval.correlation_time * dt;
    out.effective_samples = interval.effective_samples;
    out.trend = sign * interval.trend + 0.0;
    out.trend_significant = interval.trend_significant;
    const auto steps = static_cast<double>(total.count());  // of none the means are no number
    out.contact_mean = sign * (contact / steps) + 0.0;
    out.friction_mean = sign * (friction / steps) + 0.0;
    out.std = total.standard_deviation();
    if (total.largest() != 0.0) out.max = sign * total.largest();
    return out;
}

// The resistance as breaking and all else, which add up to it in floating point numbers, too: the
// difference of two numbers within a factor of 2 is exact (Sterbenz, Floating-Point Computation,
// 1974), and of two positive parts one at least is half of the whole.
void split_resistance(double breaking, ForceStatistics& out) {
    out.submersion_mean = out.mean - breaking;
    out.breaking_mean = out.mean - *out.submersion_mean;
}

}  // namespace

RunStatistics::RunStatistics(StatisticsOptions options)
    : options_(std::move(options)), regions_(options_.region_names.size()) {}

void RunStatistics::add(const StepRecord& record, double time, double dt,
                        std::optional<double> residual) {
    // of all steps, not of the averaged ones alone: a fault at the start spoils the run, too
    ++steps_;
    unconverged_ += residual ? 1 : 0;
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

    const bool averaged = is_averaged(time);
    add_regions(record, averaged);
    if (!averaged) return;
    residual_ += residual.value_or(0.0);
    add_averaged(record, dt);
}

void RunStatistics::add_check(const OverlapFound& found, const StepRecord& record, double time) {
    // seldom, as it costs a search in the meshes: overlaps beyond those of the contacts
    ++checks_;
    if (found.deepest > max_overlap_) {
        max_overlap_ = found.deepest;
        deepest_time_ = time;
    }
    std::vector<UnseenOverlap> worrying;
    for (const UnseenOverlap& pair : found.unseen) {
        if (pair.depth > options_.worrying_overlap) worrying.push_back(pair);
        if (pair.depth <= unseen_overlap_) continue;
        unseen_overlap_ = pair.depth;
        unseen_time_ = time;
        unseen_a_ = pair.a;
        unseen_b_ = pair.b;
    }
    doubtful_checks_ += worrying.empty() ? 0 : 1;
    if (is_averaged(time)) add_unseen_loads(worrying, record);
}

// The share of the load from floes whose overlap the contacts do not show, and the number of floes
// that should press on the hull and do not: both bound the error of the mean.
void RunStatistics::add_unseen_loads(const std::vector<UnseenOverlap>& worrying,
                                     const StepRecord& record) {
    std::set<std::int32_t> pressing, doubtful, in_hull;
    for (const UnseenOverlap& pair : worrying) {
        doubtful.insert({pair.a, pair.b});
        if (pair.a == 0) in_hull.insert(pair.b);
    }
    for (const RegionImpulse& r : record.regions) {
        pressing.insert(r.floe);
        unseen_loads_.all += r.impulse.x();
        if (doubtful.contains(r.floe)) unseen_loads_.doubtful += r.impulse.x();
    }
    unseen_loads_.pressing += std::ssize(pressing);
    unseen_loads_.missing += std::count_if(in_hull.begin(), in_hull.end(), [&](std::int32_t floe) {
        return !pressing.contains(floe);
    });
}

void RunStatistics::add_averaged(const StepRecord& record, double dt) {
    // sums; fill() divides them by the time
    averaged_time_ += dt;
    impulse_ += record.impulse;
    contact_ += record.contact_force;
    friction_ += record.friction_force;
    breaking_x_ += record.breaking_x;
    const Vec3 force = record.contact_force + record.friction_force;
    for (int d = 0; d < 3; ++d) total_[d].add(force[d]);
    const auto add_to = [&](Doubtful& kind) {
        kind.force += force.x();
        ++kind.steps;
    };
    // the force of doubtful steps by itself: the warning states the mean without them
    if (record.jammed_contacts > 0) add_to(jam_);
    if (record.closing_speed > options_.tunnelling_speed) add_to(fast_);
}

void RunStatistics::add_regions(const StepRecord& record, bool averaged) {
    // pairs of floe and region that touch in this step
    std::set<std::pair<std::int32_t, std::int32_t>> now;
    for (const RegionImpulse& r : record.regions) {
        Region& region = regions_[static_cast<std::size_t>(r.region)];
        // A hit is counted when a floe begins to touch a region, not in each step of the touch.
        now.emplace(r.floe, r.region);
        if (!touching_.contains({r.floe, r.region})) ++region.hits;
        region.max_impulse = std::max(region.max_impulse, r.impulse.norm());
        if (!averaged) continue;
        region.impulse += r.impulse;
        region.friction += r.friction;
    }
    touching_.swap(now);
}

void RunStatistics::add_jam(const StepRecord& record, double time) {
    // all jammed steps are counted; of the first one the place is kept
    if (record.jammed_contacts == 0) return;
    if (jammed_steps_++ > 0) return;
    first_jam_time_ = time;
    first_jam_floe_ = record.jammed_floe;
    first_jam_point_ = record.jam_point;
}

void RunStatistics::fill(Summary& summary) const {
    summary.average_from = options_.average_from;
    // resistance is positive when it slows the ship
    const double dt = averaged_time_ / static_cast<double>(total_[0].count());
    summary.resistance = statistics(total_[0], contact_.x(), friction_.x(), -1.0, dt);
    if (options_.bends)
        split_resistance(-breaking_x_ / static_cast<double>(total_[0].count()) + 0.0,
                         summary.resistance);
    summary.lateral = statistics(total_[1], contact_.y(), friction_.y(), 1.0, dt);
    summary.vertical = statistics(total_[2], contact_.z(), friction_.z(), 1.0, dt);
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
    // Without a check the key is null, not zero: nothing was measured.
    if (checks_ > 0) summary.unseen_overlap = unseen_overlap_;
    summary.unconverged_steps = unconverged_;
    if (impulse_ > 0.0) summary.residual_share = residual_ / impulse_;
    summary.energy["kinetic_J"] = kinetic_;
    summary.energy["kinetic_max_J"] = kinetic_max_;
    warn(summary);
}

}  // namespace ice
