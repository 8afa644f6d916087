// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "solver/flow/panel_sums.hpp"

namespace ice {

/// Sets a flow's residual, worst, worst_place and net_flux: the normal velocity that is left at
/// three points of each element, weighted by its size, and the share of the sources that does not
/// vanish in sinks [-]. Sums run in the elements' order. Without sources the net flux is 0, without
/// elements the residual is NaN.
/// @param elements   panels or lines, each with its outward normal
/// @param size_of    area of a panel [m2], length of a line [m]
/// @param direction  of the body's motion, at speed 1
/// @param points     three on each element, in their order, a little into the water [m]
template <class Flow, class Element, class Size>
void set_residual(Flow& flow, const std::vector<Element>& elements, const Size& size_of,
                  const Vec3& direction, std::span<const Vec3> points) {
    const std::vector<FlowSample> samples = flow_at(flow, points);
    double squares = 0.0, sizes = 0.0, net = 0.0, all = 0.0;
    for (std::size_t j = 0; j < elements.size(); ++j) {
        // the body's normal velocity, less the water's: zero where no water passes through
        const double size = size_of(elements[j]);
        for (std::size_t q = 3 * j; q < 3 * j + 3; ++q) {
            const double off = std::abs((samples[q].velocity - direction).dot(elements[j].normal));
            squares += size * off * off;
            sizes += size;
            if (off > flow.worst) {
                flow.worst = off;
                flow.worst_place = points[q];
            }
        }
        net += flow.strength[j] * size;
        all += std::abs(flow.strength[j] * size);
    }
    flow.residual = std::sqrt(squares / sizes);
    flow.net_flux = all > 0.0 ? net / all : 0.0;
}

}  // namespace ice
