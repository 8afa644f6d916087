// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace ice::detail {

/// Share of a distance or pitch [-] by which ranges are widened, so that rounding leaves nothing
/// out; an exact comparison follows. A larger value costs a few comparisons more.
inline constexpr double kSlack = 1e-6;

/// Numbers of the rows, or points of a row, that may lie between two reals, both in steps from
/// number 0; `from` > `to` where there is none.
struct Range {
    std::int64_t from, to;

    Range(double low, double high, std::int64_t count) {
        const double last = static_cast<double>(count - 1);
        from =
            low > 0.0 ? static_cast<std::int64_t>(std::min(low + (1.0 - kSlack), last + 1.0)) : 0;
        to = high >= -kSlack ? static_cast<std::int64_t>(std::min(high + kSlack, last)) : -1;
    }
};

}  // namespace ice::detail
