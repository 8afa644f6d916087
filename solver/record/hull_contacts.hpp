// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "common/formats/run_data.hpp"
#include "solver/contact/constraints.hpp"

namespace ice {

class CheckpointFile;

/// Collects where floes press on the hull between two frames; the load map is made of it.
class HullContacts {
public:
    /// Adds the impulses of a step. @param contacts one per constraint, same order
    void add(const Bodies& bodies, const std::vector<Contact>& contacts,
             const std::vector<Constraint>& constraints);

    /// The contacts since the last call as mean forces [N] over `span` [s], sorted by floe and
    /// sphere; earlier sums are dropped. Without a span there are none.
    std::vector<HullContact> take(double span);

    /// Writes or sets its state, by the file's direction (recorder_state.cpp).
    void carry(CheckpointFile& file);

private:
    struct Sum {
        double weight = 0.0;                           ///< normal impulse [N s]
        Vec3 point = Vec3::Zero();                     ///< ship frame, times weight
        Vec3 push = Vec3::Zero(), rub = Vec3::Zero();  ///< impulses on the ship [N s]
    };
    std::map<std::pair<std::int32_t, std::int32_t>, Sum> sums_;  ///< by (floe, hull sphere)
};

}  // namespace ice
