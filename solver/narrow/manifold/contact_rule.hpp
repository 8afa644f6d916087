// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"

namespace ice {

/// How contacts are found: where their normals come from, and whether ice can be crushed. Rigid ice
/// needs no shares of the surface: a convex hull and convex floes then meet as solids.
struct ContactRule {
    NormalRule normal;
    bool crushes = true;

    ContactRule(NormalRule n, bool c = true) : normal(n), crushes(c) {}
    explicit ContactRule(const Case& c) : ContactRule(c.normal, !c.contact.is_rigid()) {}
};

}  // namespace ice
