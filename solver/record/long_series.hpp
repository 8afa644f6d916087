// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ice {

class CheckpointFile;

/// A series of any length in bounded memory.
///
/// Fewer than `most` values are kept one by one. Beyond that neighbours are joined two by two,
/// again and again, so that fewer than `most` blocks of 1, 2, 4, ... values are kept. Count, mean,
/// largest value and standard deviation are those of all single values whatever the length.
class LongSeries {
public:
    /// Steps kept at most [-]: 512 kB, 22 minutes of steps of 0.02 s. Fewer join values sooner, and
    /// the spectrum sees less of short times; more costs memory.
    static constexpr std::size_t kMost = 65536;

    /// The value that represents a block.
    enum class Join { mean, largest };

    /// @param most  values kept at most, a power of two
    explicit LongSeries(Join join = Join::mean, std::size_t most = kMost)
        : join_(join), most_(most) {}

    /// Numbers are in the caller's unit throughout.
    void add(double value);

    /// Values added so far.
    std::size_t count() const { return static_cast<std::size_t>(count_); }
    bool empty() const { return count_ == 0; }
    /// In the order of the values; the last, unfinished block is left out.
    std::span<const double> blocks() const { return blocks_; }
    /// Values in a block: a power of two.
    std::size_t block_length() const { return static_cast<std::size_t>(length_); }

    /// 0 for no values.
    double sum() const { return sum_; }
    /// NaN for no values.
    double mean() const { return sum_ / static_cast<double>(count_); }
    /// The first of those with the largest amount, with its sign; 0 for none.
    double largest() const { return largest_; }
    /// About the mean; 0 for fewer than two values.
    double standard_deviation() const;

    /// Writes its state under `name`, or reads it.
    void carry(CheckpointFile& file, const std::string& name);

private:
    double joined(double a, double b) const;
    void halve();

    Join join_;
    std::size_t most_;
    std::vector<double> blocks_;
    std::int64_t count_ = 0, length_ = 1;
    double sum_ = 0.0, largest_ = 0.0;
    double rest_ = 0.0;         // of the unfinished block: the sum of its values, or the largest
    std::int64_t resting_ = 0;  // values in it
    // from the first halving on: mean so far, sum of squares about it (Welford)
    double middle_ = 0.0, squares_ = 0.0;
};

}  // namespace ice
