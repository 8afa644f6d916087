// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/base/assert.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::views {

/// A straight scale: value `low` at pixel `from`, value `high` at pixel `to`; low > high turns it.
struct Axis {
    double low = 0.0, high = 1.0, from = 0.0, to = 1.0;  ///< in the axis' unit; [px]
    bool logarithmic = false;  ///< values are exponents: ticks at whole ones, as powers of ten
    /// Place of a value [px]. @pre low and high differ
    double pixel(double value) const {
        ICE_ASSERT(low != high);
        return from + (value - low) / (high - low) * (to - from);
    }
};

/// Round values (1, 2, 5 times a power of ten) inside [low, high], at most about `most` of them.
/// A range without extent, or not finite, gives one tick, `low`. @param most a count, >= 1
std::vector<double> choose_ticks(double low, double high, int most);

/// A tick's label with no more decimals than the step between the ticks needs.
std::string tick_label(double value, double step);

/// Widens a range to round values; one without extent becomes [value - 1, value + 1], in its unit.
void widen(double& low, double& high);

/// Width of the widest tick label that draw_axes() puts beside an upright axis [px].
double label_width(const Axis& y);

/// Grid lines, tick labels and titles of a plot area: `x` runs right, `y` upwards (from > to).
/// @param x_title, y_title with units, e.g. "time [s]"
std::string draw_axes(const Axis& x, const Axis& y, const std::string& x_title,
                      const std::string& y_title);

}  // namespace ice::views
