// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/long_series.hpp"

#include <algorithm>
#include <cmath>

#include "common/formats/checkpoint_file.hpp"
#include "solver/record/statistics.hpp"

namespace ice {

// Blocks have equal lengths, so that the mean of two means is that of all their values.
double LongSeries::joined(double a, double b) const {
    return join_ == Join::mean ? 0.5 * (a + b) : std::max(a, b);
}

void LongSeries::add(double value) {
    ++count_;
    sum_ += value;
    // The largest amount, with its sign.
    if (std::abs(value) > std::abs(largest_)) largest_ = value;
    if (length_ > 1) {  // Welford, Technometrics 4, 1962
        const double off = value - middle_;
        middle_ += off / static_cast<double>(count_);
        squares_ += off * (value - middle_);
    }
    const bool begins = resting_ == 0;
    // values wait until a block is whole; a full series halves its blocks, so memory is bounded
    rest_ = join_ == Join::mean ? (begins ? value : rest_ + value)
                                : (begins ? value : std::max(rest_, value));
    if (++resting_ < length_) return;
    blocks_.push_back(join_ == Join::mean ? rest_ / static_cast<double>(length_) : rest_);
    resting_ = 0;
    if (blocks_.size() >= most_) halve();
}

void LongSeries::halve() {
    // from here on single values are no longer kept: their variance is continued by Welford's
    // sums
    if (length_ == 1) {
        middle_ = mean();
        for (const double value : blocks_) squares_ += (value - middle_) * (value - middle_);
    }
    for (std::size_t k = 0; 2 * k < blocks_.size(); ++k)
        blocks_[k] = joined(blocks_[2 * k], blocks_[2 * k + 1]);
    blocks_.resize(blocks_.size() / 2);
    length_ *= 2;
}

double LongSeries::standard_deviation() const {
    // while all single values are there, by their own sum: the same bits as of a plain list
    if (length_ == 1) return ice::standard_deviation(blocks_);
    return std::sqrt(squares_ / static_cast<double>(count_ - 1));
}

void LongSeries::carry(CheckpointFile& file, const std::string& name) {
    file.carry(name, blocks_);
    file.carry(name + ".count", count_);
    file.carry(name + ".length", length_);
    file.carry(name + ".sum", sum_);
    file.carry(name + ".largest", largest_);
    file.carry(name + ".rest", rest_);
    file.carry(name + ".resting", resting_);
    file.carry(name + ".middle", middle_);
    file.carry(name + ".squares", squares_);
}

}  // namespace ice
