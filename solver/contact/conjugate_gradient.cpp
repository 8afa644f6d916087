// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/conjugate_gradient.hpp"

#include <algorithm>

namespace ice {

namespace {

// Ratios |g|^2 / |g_last|^2 above which the direction is dropped. For a squeezed floe every sweep
// adds the same impulse, so beta = 1 to rounding. Where impulses are bounded (crushing), the steps
// must go on until the bound is met: restart only where |g|^2 grows by 10 %. Without a bound they
// would diverge: restart at 0.8. Lower limits [-] restart more often and approach plain sweeps;
// higher ones go round the answer.
constexpr double kRestartBounded = 1.1, kRestartRigid = 0.8;

}  // namespace

void ConjugateGradient::begin(const ContactRows& contacts, bool bounded) {
    restart_ = bounded ? kRestartBounded : kRestartRigid;
    memory_.before.resize(contacts.rows.size());
    for (std::size_t r = 0; r < contacts.rows.size(); ++r)
        memory_.before[r] = contacts.rows[r].impulse;
    memory_.direction.assign(contacts.rows.size(), RowImpulses{});
    memory_.motion_before = contacts.motion;
    memory_.motion_direction.assign(contacts.motion.size(), BodyMotion{});
    last_size_ = -1.0;
}

void ConjugateGradient::advance(ContactRows& contacts) {
    // beta of equation (11); the first sweep has no direction to go on with
    const double size = measure_change(contacts.rows, memory_);
    double beta = last_size_ > 0.0 ? size / last_size_ : 0.0;
    beta = beta > restart_ ? 0.0 : std::min(beta, 1.0);
    last_size_ = size;
    move_on(contacts.rows, contacts.motion, beta, memory_);
}

}  // namespace ice
