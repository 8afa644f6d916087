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
/// restarted with beta = 0 where |g|^2 grows (Silcowitz-Hansen, Niebe, Erleben, The Visual Computer
/// 26, 2010: a nonsmooth nonlinear conjugate gradient method). |g|^2 is sum g^2 k(n), an energy.
/// Bodies' velocities move along with the impulses, so momentum stays balanced to rounding; bounds
/// and cones are restored by the next sweep, which therefore always comes last.
class ConjugateGradient {
public:
    /// Before the first sweep of a stage.
    /// @param bounded  impulses have a bound that they may grow to
    void begin(const ContactRows& contacts, bool bounded);
    /// Between two sweeps: takes the change by the last one and advances the impulses.
    void advance(ContactRows& contacts);

private:
    SweepMemory memory_;
    double last_size_ = -1.0;
    double restart_ = 1.0;  // where |g|^2 / |g_last|^2 exceeds it
};

}  // namespace ice
