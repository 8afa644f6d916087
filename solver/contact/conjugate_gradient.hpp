// SPDX-License-Identifier: GPL-3.0-or-later
/// Conjugate gradients between the sweeps: docs/method.md, section 4.
#pragma once

#include "solver/contact/sweep_memory.hpp"

namespace ice {

/// Accelerates the sweeps of the contact solver by nonlinear conjugate gradients (NNCG).
///
/// Sweeps alone converge slowly where many contacts share a load (a face's spheres, a chain of
/// floes): after a hundred of them nine tenths of the error may be left. After each sweep, with g
/// the change it made to the impulses and d the direction so far,
///
///     beta = |g|^2 / |g_last|^2,   impulses += beta d,   d = beta d + g,
///
/// equation (11), with beta at most 1, and restarted with beta = 0 where the ratio exceeds a limit:
/// 1.1 where impulses are bounded, 0.8 for rigid ice (Silcowitz-Hansen, Niebe, Erleben, The Visual
/// Computer 26, 2010: a nonsmooth nonlinear conjugate gradient method). |g|^2 is sum g^2 k(n), an
/// energy [J].
/// Bodies' velocities move along with the impulses, so momentum stays balanced to rounding; bounds
/// and cones are restored by the next sweep, which therefore always comes last.
class ConjugateGradient {
public:
    /// Before the first sweep of a solution: forgets the direction of the one before.
    /// @param bounded  impulses have a bound that they may grow to (a finite crushing pressure)
    void begin(const ContactRows& contacts, bool bounded);
    /// Between two sweeps: takes the change by the last one and advances impulses and velocities.
    /// The first call after begin() has no direction yet and leaves them as they are.
    void advance(ContactRows& contacts);

private:
    SweepMemory memory_;
    double last_size_ = -1.0;
    double restart_ = 1.0;  // where |g|^2 / |g_last|^2 exceeds it
};

}  // namespace ice
