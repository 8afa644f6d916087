// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ice {

class CheckpointFile;

/// A quantile of the forces of windows, in bounded memory.
///
/// Up to kExact forces are kept one by one. From then on they are counted in classes, 128 between
/// two powers of two, so that the quantile is within 0.4 % of the exact one; sum and largest are
/// exact whatever the number.
class WindowForces {
public:
    /// Forces kept one by one at most [-]: 8 kB, 100 s under load in windows of 0.1 s. More keeps
    /// quantiles exact for longer and costs memory for each of some thousand panels.
    static constexpr std::size_t kExact = 1024;

    /// @param force  > 0 [N]
    void add(double force);

    bool empty() const { return largest_ == 0.0; }
    /// Sum of all forces added [N]; 0 for none.
    double sum() const { return sum_; }
    double largest() const { return largest_; }  ///< [N]; 0 for none
    /// The force [N] below which `share` [-] of `windows` windows lie: those added, and zeros.
    /// @pre windows is at least the number of those added
    double quantile(double share, std::int64_t windows) const;

    /// Writes the state of many under `name`, or reads it; their number is known.
    static void carry(CheckpointFile& file, const std::string& name,
                      std::vector<WindowForces>& all);

private:
    struct Class {
        std::int32_t number, count;
    };
    void count(double force);
    std::int64_t added() const;  // how many

    std::vector<double> forces_;        // [N], until there are classes
    std::vector<Class> classes_;        // by number
    double sum_ = 0.0, largest_ = 0.0;  // [N]
};

}  // namespace ice
