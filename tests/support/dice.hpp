// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers drawn for tests, the same in every run.
#pragma once

#include <random>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::test {

struct Dice {
    std::mt19937 random;
    std::uniform_real_distribution<double> unit{-1.0, 1.0};

    double number() { return unit(random); }  ///< from -1 to 1
    Vec3 vector() { return Vec3(number(), number(), number()); }
};

}  // namespace ice::test
