// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/extrapolation.hpp"

#include <algorithm>

namespace ice {

namespace {

// A squeezed floe's impulse grows by the same step in every sweep: beta is 1 to rounding. Where the
// ice crushes at last, the way must go on to there, and only beyond this have the sweeps turned
// elsewhere. Between rigid bodies that cannot give way it would go on for ever.
constexpr double kAfreshBounded = 1.1, kAfreshRigid = 0.8;

}  // namespace

void Extrapolation::begin(const ContactRows& contacts, bool bounded) {
    afresh_ = bounded ? kAfreshBounded : kAfreshRigid;
    memory_.before.resize(contacts.rows.size());
    for (std::size_t r = 0; r < contacts.rows.size(); ++r)
        memory_.before[r] = contacts.rows[r].impulse;
    memory_.way.assign(contacts.rows.size(), RowImpulses{});
    memory_.motion_before = contacts.motion;
    memory_.motion_way.assign(contacts.motion.size(), BodyMotion{});
    last_size_ = -1.0;
}

void Extrapolation::advance(ContactRows& contacts) {
    const double size = measure_change(contacts.rows, memory_);
    double beta = last_size_ > 0.0 ? size / last_size_ : 0.0;
    beta = beta > afresh_ ? 0.0 : std::min(beta, 1.0);
    last_size_ = size;
    move_on(contacts.rows, contacts.motion, beta, memory_);
}

}  // namespace ice
