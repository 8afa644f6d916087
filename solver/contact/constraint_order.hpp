// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "solver/contact/constraints.hpp"

namespace ice {

/// Are they ordered by (a, b)? A precondition of the solver's stages. True for none.
inline bool are_ordered(const std::vector<Constraint>& constraints) {
    return std::is_sorted(constraints.begin(), constraints.end(), [](const auto& l, const auto& r) {
        return std::tie(l.a, l.b) < std::tie(r.a, r.b);
    });
}

}  // namespace ice
