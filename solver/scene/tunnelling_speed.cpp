// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/tunnelling_speed.hpp"

#include <algorithm>
#include <limits>

namespace ice {

double tunnelling_speed(const Scene& scene, double time_step) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Shape& shape : scene.shapes)
        for (const double radius : shape.radius) smallest = std::min(smallest, radius);
    return 2.0 * smallest / time_step;
}

}  // namespace ice
