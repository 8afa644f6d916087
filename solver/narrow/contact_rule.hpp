// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solver/case/case.hpp"

namespace ice {

/// How contacts are found: where their normals come from, and whether ice can give way.
struct ContactRule {
    NormalRule normal;
    bool crushes = true;

    ContactRule(NormalRule n, bool c = true) : normal(n), crushes(c) {}
    explicit ContactRule(const Case& c)
        : ContactRule(c.normal, std::isfinite(c.crushing_pressure)) {}
};

}  // namespace ice
