// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ice::statistics {

/// At most `most` rows of `count` rows, evenly chosen in rising order, with the first and the last.
/// `most` below 2 counts as 2; no rows give none.
inline std::vector<std::size_t> choose_frames(std::size_t count, std::size_t most) {
    std::vector<std::size_t> chosen;
    const std::size_t kept = std::min(count, std::max<std::size_t>(2, most));
    for (std::size_t k = 0; k < kept; ++k)
        chosen.push_back(kept < 2 ? 0 : k * (count - 1) / (kept - 1));
    return chosen;
}

}  // namespace ice::statistics
