// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings of a run. Each says by how much the mean resistance is affected, from a measured value;
// an event that affects neither mean nor pictures gives no warning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "solver/record/run_statistics.hpp"
#include "solver/record/warn_of_trend.hpp"

namespace ice {

namespace {

// A mean that comes from a hundredth of the steps by more than this is one of hits, and Student's
// interval of few hits is too narrow: with 0.64 to 0.78 (the paper's 3D case, rigid) seeds differ
// by more than it, with 0.24 (its 2D case at 1 m/s) they do not. A share of the mean [-]; only the
// warning depends on it.
constexpr double kWorryingPeaks = 0.5;

// The share of sum |f| that the 1 % of steps with the largest |f| carry; 0 below 100 steps.
double share_of_peaks(std::vector<double> force) {
    for (double& f : force) f = std::abs(f);
    std::sort(force.begin(), force.end(), std::greater<>());
    const auto few = force.begin() + static_cast<std::ptrdiff_t>(force.size() / 100);
    const double all = std::accumulate(force.begin(), force.end(), 0.0);
    return all == 0.0 ? 0.0 : std::accumulate(force.begin(), few, 0.0) / all;
}

std::string name_of(std::int32_t body) {
    return body == 0 ? std::string("the hull") : fmt::format("floe {}", body);
}

// A share that was not measured counts as unknown, and is worth a warning.
bool matters(std::optional<double> share) { return !share || *share > kMatters; }

// Moves that open overlaps put energy in, which the ship did not have to deliver: as a share of its
// work. The report has the deepest overlap in any case.
std::optional<double> share_of_separation(const Summary& summary) {
    const auto energy = [&](const char* key) {
        const auto found = summary.energy.find(key);
        return found == summary.energy.end() ? 0.0 : found->second;
    };
    const double work = std::abs(energy("ship_work_J"));
    return work > 0.0 ? std::optional(std::abs(energy("separation_J")) / work) : std::nullopt;
}

// Whether the averaged time is long enough; a trend that was measured says more than its length.
void warn_of_averages(Summary& summary) {
    const ForceStatistics& r = summary.resistance;
    if (r.mean == 0.0 || !std::isfinite(r.mean)) return;
    if (r.trend_significant.value_or(false))
        summary.warnings.push_back(warn_of_trend(summary));
    else if (summary.travel.distance > 0.0 && is_short(summary.travel.averaged_lengths))
        summary.warnings.push_back(warn_of_short_averages(summary));
}

}  // namespace

// How far the mean moves when these steps are left out, as a share of it.
std::optional<double> RunStatistics::change_without(const Doubtful& kind, double mean) const {
    const auto all = static_cast<std::int64_t>(total_[0].count());
    if (all == 0 || mean == 0.0) return std::nullopt;
    if (kind.steps == all) return 1.0;
    const double without = -(total_[0].sum() - kind.force) / static_cast<double>(all - kind.steps);
    return std::abs((mean - without) / mean);
}

void RunStatistics::warn(Summary& summary) const {
    auto& warnings = summary.warnings;
    const double mean = summary.resistance.mean;
    // each warning only where it matters for the mean, by something measured
    if (summary.residual_share > kMatters)
        warnings.push_back(judged(
            fmt::format("{} of {} steps did not reach contact.tolerance: raise contact.iterations",
                        unconverged_, steps_),
            summary.residual_share));
    // a jam or an overlap is worth a warning only where the mean depends on it
    if (jammed_steps_ > 0 && matters(change_without(jam_, mean)))
        warnings.push_back(warn_of_jam(summary));
    const auto blocks = total_[0].blocks();  // the steps themselves, unless they are very many
    if (const double peaks = share_of_peaks({blocks.begin(), blocks.end()}); peaks > kWorryingPeaks)
        warnings.push_back(judged(
            fmt::format(
                "1 % of the steps carry {:.0f} % of the force along x, so the interval of the mean "
                "may be too narrow: run several seeds (icesolve --seeds)",
                100.0 * peaks),
            peaks));
    if (max_overlap_ > options_.worrying_overlap && matters(share_of_separation(summary)))
        warnings.push_back(warn_of_overlap(summary));
    if (unseen_overlap_ > options_.worrying_overlap && matters(unseen_share()))
        warnings.push_back(warn_of_unseen());
    if (closing_speed_ > options_.tunnelling_speed) warnings.push_back(warn_of_tunnelling(summary));
    warn_of_averages(summary);
    if (contacts_max_ == 0.0) {
        Warning nothing;
        nothing.text = "nothing touched anything: does the hull reach the ice?";
        nothing.affects_mean = true;  // without a share: the mean is zero
        warnings.push_back(nothing);
    }
    judge_start(summary);
}

// Warnings of the start without a verdict are about bodies that go into or through each other: wide
// spacings, long steps, a hull without spheres, overlaps that were allowed. The run has measured
// that; the largest share is the verdict.
void RunStatistics::judge_start(Summary& summary) const {
    std::optional<double> share;
    for (const auto& measured : {share_of_separation(summary), unseen_share(),
                                 change_without(fast_, summary.resistance.mean)})
        if (measured) share = std::max(share.value_or(0.0), *measured);
    for (Warning& w : summary.warnings)
        if (!w.affects_mean) w = judged(w.text, share);
}

// The part of the load on the hull that floes in worrying overlaps bring, and where a floe lies in
// the hull without pressing on it, the load of a mean floe, which it may lack.
std::optional<double> RunStatistics::unseen_share() const {
    const UnseenLoads& u = unseen_loads_;
    if (checks_ == 0) return std::nullopt;
    if (u.all == 0.0 || u.pressing == 0) return u.missing > 0 ? 1.0 : 0.0;
    return std::abs(u.doubtful / u.all) +
           static_cast<double>(u.missing) / static_cast<double>(u.pressing);
}

Warning RunStatistics::warn_of_jam(const Summary& summary) const {
    return judged(
        fmt::format(
            "jam: in {} of {} steps a floe squeezed between the hull and other ice could not move "
            "aside, first floe {} at t = {:.2f} s, x = {:.2f}, y = {:.2f}, z = {:.2f} m; {}",
            jammed_steps_, steps_, first_jam_floe_, first_jam_time_, first_jam_point_.x(),
            first_jam_point_.y(), first_jam_point_.z(),
            options_.rigid ? "with rigid contact the force there depends on time_step and "
                             "iterations: set contact.crushing_pressure"
                           : "the solver ran out of iterations there: raise contact.iterations"),
        change_without(jam_, summary.resistance.mean));
}

Warning RunStatistics::warn_of_overlap(const Summary& summary) const {
    return judged(
        fmt::format("overlap reached {:.1f} mm at t = {:.2f} s: bodies were pushed into each "
                    "other, so pictures and single loads are wrong there; use finer ice spheres, "
                    "lower simulation.time_step or raise contact.iterations",
                    1e3 * max_overlap_, deepest_time_),
        share_of_separation(summary));
}

Warning RunStatistics::warn_of_unseen() const {
    return judged(
        fmt::format("{} and floe {} overlapped by {:.3g} m more than their contacts show, at t = "
                    "{:.2f} s; {} of {} checks of the solids found such a pair: pictures and "
                    "loads on these floes are wrong; use finer ice spheres",
                    name_of(unseen_a_), unseen_b_, unseen_overlap_, unseen_time_, doubtful_checks_,
                    checks_),
        unseen_share());
}

Warning RunStatistics::warn_of_tunnelling(const Summary& summary) const {
    return judged(
        fmt::format("{} and floe {} met at {:.3g} m/s at t = {:.2f} s; above {:.3g} m/s, a contact "
                    "sphere's diameter per step, bodies may pass through each other: lower "
                    "simulation.time_step",
                    name_of(closing_a_), closing_b_, closing_speed_, closing_time_,
                    options_.tunnelling_speed),
        change_without(fast_, summary.resistance.mean));
}

}  // namespace ice
