// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sensitivity/rank_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ice::sensitivity {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// s^2 / n, the squared standard error of the mean [N^2]; NaN for one value
double square_error(const std::vector<double>& values, double mean) {
    const auto n = static_cast<double>(values.size());
    double square = 0.0;
    for (const double value : values) square += (value - mean) * (value - mean);
    return square / (n - 1.0) / n;
}

}  // namespace

Estimate estimate_ensemble(const Seeds& ensemble) {
    Estimate out = sweep::estimate_mean(ensemble.resistance);
    if (ensemble.resistance.size() == 1) out.half = ensemble.half.front();
    return out;
}

Estimate estimate_difference(const Seeds& a, const Seeds& b) {
    const Estimate first = estimate_ensemble(a), second = estimate_ensemble(b);
    const double mean = second.mean - first.mean;
    // without a scatter between seeds the runs' own intervals count, as independent errors
    if (a.resistance.size() < 2 || b.resistance.size() < 2)
        return {mean, std::hypot(first.half, second.half)};
    const double qa = square_error(a.resistance, first.mean);
    const double qb = square_error(b.resistance, second.mean);
    if (!std::isfinite(qa + qb)) return {mean, kNaN};
    // runs that are equal to the last digit, as for an input without effect
    if (qa + qb == 0.0) return {mean, 0.0};
    // Degrees of freedom by Welch and Satterthwaite: both ensembles may scatter differently. A
    // pooled variance would let a quiet base hide the scatter of a changed run.
    const double freedom = (qa + qb) * (qa + qb) /
                           (qa * qa / static_cast<double>(a.resistance.size() - 1) +
                            qb * qb / static_cast<double>(b.resistance.size() - 1));
    return {mean, student_quantile(freedom, 0.05) * std::sqrt(qa + qb)};
}

bool Change::significant() const { return std::abs(difference.mean) > difference.half; }

double RankedInput::largest() const {
    double most = 0.0;
    for (const Change& change : changes)
        if (std::isfinite(change.difference.mean))
            most = std::max(most, std::abs(change.difference.mean));
    return most;
}

std::vector<RankedInput> rank_inputs(const Study& study) {
    std::vector<RankedInput> out;
    for (const Input& input : study.inputs) {
        out.push_back({input.name, input.base, input.source, {}});
        for (const Seeds& value : input.values)
            out.back().changes.push_back(
                {value.label, estimate_ensemble(value), estimate_difference(study.base, value)});
    }
    // stable: equal inputs stay in the plan's order, and the page is the same at each call
    std::stable_sort(out.begin(), out.end(), [](const RankedInput& a, const RankedInput& b) {
        return a.largest() > b.largest();
    });
    return out;
}

}  // namespace ice::sensitivity
