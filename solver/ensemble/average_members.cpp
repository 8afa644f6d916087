// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ensemble/average_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "common/base/assert.hpp"
#include "common/base/uncertainty.hpp"
#include "solver/record/statistics.hpp"
#include "solver/record/warn_of_trend.hpp"

namespace ice {

namespace {

using Members = std::vector<Member>;

template <class Value>
std::vector<double> column(const Members& members, const Value& value) {
    std::vector<double> out;
    for (const Member& m : members) out.push_back(static_cast<double>(value(m.summary)));
    return out;
}

template <class Value>
double mean_over(const Members& members, const Value& value) {
    return student_interval(column(members, value)).mean;
}

template <class Value>
double largest(const Members& members, const Value& value) {
    const auto all = column(members, value);
    return *std::max_element(all.begin(), all.end());
}

template <class Value>
std::int64_t rounded_mean(const Members& members, const Value& value) {
    return std::llround(mean_over(members, value));
}

ForceStatistics average(const Members& members, ForceStatistics Summary::*force) {
    const auto mean = [&](double ForceStatistics::*part) {
        return mean_over(members, [&](const Summary& s) { return s.*force.*part; });
    };
    ForceStatistics out;
    // members differ in their seed only and are independent: Student's interval of their means
    const MeanInterval interval =
        student_interval(column(members, [&](const Summary& s) { return (s.*force).mean; }));
    out.mean = interval.mean;
    out.ci95 = interval.half_width;
    out.contact_mean = mean(&ForceStatistics::contact_mean);
    out.friction_mean = mean(&ForceStatistics::friction_mean);
    out.std = mean(&ForceStatistics::std);
    // only cases that bend ice have these
    for (const auto part : {&ForceStatistics::breaking_mean, &ForceStatistics::submersion_mean})
        if ((members.front().summary.*force).*part)
            out.*part = mean_over(
                members, [&](const Summary& s) { return (s.*force.*part).value_or(std::nan("")); });
    // the peak of all, with its sign
    for (const Member& m : members)
        if (const double peak = (m.summary.*force).max; std::abs(peak) > std::abs(out.max))
            out.max = peak;
    // The members are the samples: the interval is theirs, not that of one history.
    out.effective_samples = static_cast<double>(members.size());
    return out;
}

// sums with shares 1 / n are means
void add_share(std::array<double, 3>& sum, const std::array<double, 3>& value, double share) {
    for (std::size_t d = 0; d < 3; ++d) sum[d] += share * value[d];
}

std::map<std::string, RegionStatistics> average_regions(const Members& members) {
    std::map<std::string, RegionStatistics> out;
    const double share = 1.0 / static_cast<double>(members.size());
    for (const Member& m : members)
        for (const auto& [name, region] : m.summary.regions) {
            RegionStatistics& sum = out[name];
            // Hits add up over the members, forces are means of means.
            sum.hits += region.hits;
            sum.max_impulse = std::max(sum.max_impulse, region.max_impulse);
            add_share(sum.mean, region.mean, share);
            add_share(sum.contact_mean, region.contact_mean, share);
            add_share(sum.friction_mean, region.friction_mean, share);
        }
    return out;
}

// @param share  1 / n for means, 1 for sums
std::map<std::string, double> average_numbers(const Members& members,
                                              std::map<std::string, double> Summary::*numbers,
                                              double share) {
    std::map<std::string, double> out;
    for (const Member& m : members)
        for (const auto& [key, value] : m.summary.*numbers) out[key] += share * value;
    return out;
}

void average_counts(const Members& all, Summary& out) {
    const auto sum = static_cast<double>(all.size());
    const auto mean = [&](auto member) {
        return rounded_mean(all, [&](const Summary& s) { return s.*member; });
    };
    // Work adds up over the members, properties of one run are averaged, bounds are the worst of
    // all.
    out.steps = std::llround(sum * mean_over(all, [](const Summary& s) { return s.steps; }));
    out.simulated_s = sum * mean_over(all, [](const Summary& s) { return s.simulated_s; });
    out.wall_s = sum * mean_over(all, [](const Summary& s) { return s.wall_s; });
    out.unconverged_steps =
        std::llround(sum * mean_over(all, [](const Summary& s) { return s.unconverged_steps; }));
    out.ice_spheres = mean(&Summary::ice_spheres);
    out.floes_total = mean(&Summary::floes_total);
    out.floes_moved = mean(&Summary::floes_moved);
    out.floes_behind = mean(&Summary::floes_behind);
    out.contacts_mean = mean_over(all, [](const Summary& s) { return s.contacts_mean; });
    out.contacts_max = largest(all, [](const Summary& s) { return s.contacts_max; });
    out.max_overlap = largest(all, [](const Summary& s) { return s.max_overlap; });
    out.unseen_overlap = largest(all, [](const Summary& s) { return s.unseen_overlap; });
    out.residual_share = mean_over(all, [](const Summary& s) { return s.residual_share; });
}

// Cracks of the members in which pieces broke off.
std::optional<CrackParticulars> average_cracks(const Members& all) {
    std::vector<CrackParticulars> known;
    for (const Member& m : all)
        if (m.summary.cracks) known.push_back(*m.summary.cracks);
    return mean_cracks(known);
}

// Ship, ice and travel: one case, but fields of their own.
void average_particulars(const Members& all, Summary& out) {
    const auto mean = [&](auto particulars, auto member) {
        return mean_over(all, [&](const Summary& s) { return s.*particulars.*member; });
    };
    for (auto member : {&IceParticulars::thickness, &IceParticulars::floe_size_mean,
                        &IceParticulars::concentration})
        out.ice.*member = mean(&Summary::ice, member);
    out.cracks = average_cracks(all);
    out.ice.floes = rounded_mean(all, [](const Summary& s) { return s.ice.floes; });
    out.ice.floe_size_min = -largest(all, [](const Summary& s) { return -s.ice.floe_size_min; });
    out.ice.floe_size_max = largest(all, [](const Summary& s) { return s.ice.floe_size_max; });
    out.ship.speed_mean = mean(&Summary::ship, &ShipParticulars::speed_mean);
    for (auto member : {&TravelParticulars::distance, &TravelParticulars::lengths,
                        &TravelParticulars::averaged_lengths})
        out.travel.*member = mean(&Summary::travel, member);
}

// Do more members show a trend than chance explains? Each shows one by chance with kTrendChance,
// so of nine runs without a trend one in eleven sets would warn; so many members must show one that
// chance gives them with no more than kTrendChance together: 1 of 1, 2 of 2 to 15, 3 of 16 to 44.
bool have_trend(const Members& members) {
    const auto showing = std::count_if(members.begin(), members.end(), [](const Member& m) {
        return m.summary.resistance.trend_significant.value_or(false);
    });
    if (showing == 0) return false;
    if (members.size() == 1) return true;  // by the definition of kTrendChance
    return chance_of_at_least(showing, std::ssize(members), kTrendChance) <= kTrendChance;
}

bool warns_of_trend(const Summary& s) {
    return s.resistance.trend_significant.value_or(false) && s.resistance.mean != 0.0;
}

// A member's own trend, in an ensemble that has none. Within less than a ship length a trend has a
// cause, the floes that still spread along the hull, and is no chance.
bool is_chance(const Member& m, const Warning& warning, bool trend) {
    return !trend && warns_of_trend(m.summary) && !is_short(m.summary.travel.averaged_lengths) &&
           warning.text == warn_of_trend(m.summary).text;
}

auto find(const Member& m, const std::string& text) {
    return std::find_if(m.summary.warnings.begin(), m.summary.warnings.end(),
                        [&](const Warning& w) { return w.text == text; });
}

// A member's trend replaces its warning of short averages. Where other members have that warning,
// it is true of this one as well, and is added: it is then a warning of all, not of the others.
Members with_short_averages(const Members& members) {
    Members out = members;
    for (Member& m : out) {
        if (!warns_of_trend(m.summary) || !is_short(m.summary.travel.averaged_lengths)) continue;
        const Warning brief = warn_of_short_averages(m.summary);
        const bool elsewhere =
            std::any_of(members.begin(), members.end(), [&](const Member& other) {
                return find(other, brief.text) != other.summary.warnings.end();
            });
        if (elsewhere) m.summary.warnings.push_back(brief);
    }
    return out;
}

// A warning that all members share once, any other one with the seed of its member.
std::vector<Warning> gather_warnings(const Members& reported) {
    const Members members = with_short_averages(reported);
    const bool trend = have_trend(members);
    std::vector<Warning> shared, single;
    for (const Member& m : members)
        for (Warning warning : m.summary.warnings) {
            // one member's trend, where as many as chance explains have one, is no warning of
            // the ensemble
            if (is_chance(m, warning, trend)) continue;
            const bool everywhere =
                std::all_of(members.begin(), members.end(), [&](const Member& other) {
                    return find(other, warning.text) != other.summary.warnings.end();
                });
            if (!everywhere) {
                warning.text = fmt::format("seed {}: {}", m.seed, warning.text);
                single.push_back(warning);
            } else if (&m == &members.front()) {
                for (const Member& other : members)  // the worst verdict of all
                    if (const Warning& w = *find(other, warning.text);
                        w.share.value_or(0.0) > warning.share.value_or(0.0))
                        warning = w;
                shared.push_back(warning);
            }
        }
    shared.insert(shared.end(), single.begin(), single.end());
    return shared;
}

// Of all members: one step that lost momentum is a fault of them all.
std::map<std::string, double> worst_imbalance(const Members& members) {
    std::map<std::string, double> out;
    for (const Member& m : members)
        for (const auto& [kind, value] : m.summary.imbalance)
            out[kind] = std::max(out[kind], value);
    return out;
}

}  // namespace

Summary average_members(const std::vector<Member>& members) {
    ICE_ASSERT(!members.empty());
    // starts as the first member's summary: values that are not replaced below are equal in all
    Summary out = members.front().summary;
    const double share = 1.0 / static_cast<double>(members.size());
    average_counts(members, out);
    out.resistance = average(members, &Summary::resistance);
    out.lateral = average(members, &Summary::lateral);
    out.vertical = average(members, &Summary::vertical);
    out.regions = average_regions(members);
    out.energy = average_numbers(members, &Summary::energy, share);
    out.stage_seconds = average_numbers(members, &Summary::stage_seconds, 1.0);
    out.state_hash = 0;  // no one state
    out.panels = {};     // maxima and rates of single histories
    out.imbalance = worst_imbalance(members);
    average_particulars(members, out);
    out.ensemble = Ensemble{out.resistance.mean, out.resistance.ci95, {}, {}};
    out.warnings = gather_warnings(members);
    for (const Member& m : members) {
        out.ensemble->means.push_back(m.summary.resistance.mean);
        out.ensemble->seeds.push_back(m.seed);
    }
    return out;
}

}  // namespace ice
