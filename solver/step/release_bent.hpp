// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/contact/constraints.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Finds floes held until they bend whose load reached their breaking load in the step just done
/// (docs/method.md, section 5).
///
/// The load is the downward part of all impulses, friction included, that the ship and moving floes
/// give the floe in the step, over the step: F = -sum (J_n n + J_t) . z / dt [N], equation (26),
/// summed in the order of the contacts. The floe is released when F >= breaking_load f(v_n), f
/// being bending.factor_table and v_n the mean of the contacts' closing speeds, weighted by their
/// normal impulses [m/s]; a contact that opens counts with 0. In the step that breaks it, it is
/// held: release_bent() releases it as the next one begins.
class BentFloes {
public:
    /// @pre the constraints hold the impulses of the step just done
    void find(Scene& scene, const Case& parameters, const std::vector<Constraint>& constraints);

private:
    struct Load {
        double down = 0.0;     // impulse [N s]
        double normal = 0.0;   // sum of normal impulses [N s]
        double closing = 0.0;  // the same times closing speeds [N m]
    };
    void add(std::int32_t floe, double up, const Constraint& c);

    std::vector<Load> loads_;            // per body, all zero between steps
    std::vector<std::int32_t> pressed_;  // bodies with a load
};

/// Releases the floes that were found by BentFloes in the step before: Bodies::held is 2.
void release_bent(Bodies& bodies);

}  // namespace ice
