// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of floes, as many at a time as the machine has lanes, compiled once per instruction set.
// The mathematics is in advance_floes_reference.cpp and rotation.cpp. Mul then Add, not MulAdd: a
// fused product would differ from it.
#include "solver/integrate/advance_floes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/integrate/advance_floes_simd.cpp"
#include <hwy/foreach_target.h>  // must precede highway.h
#include <hwy/highway.h>

#include "solver/integrate/rotation.hpp"
#include "solver/scene/body_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {

// Eigen's order of operations, as the reference has it.
HWY_INLINE Quaternions Product(Quaternions a, Quaternions b) {
    return {hn::Sub(hn::Add(hn::Mul(a.w, b.x), hn::Mul(a.y, b.z)),
                    hn::Sub(hn::Mul(a.z, b.y), hn::Mul(a.x, b.w))),
            hn::Add(hn::Add(hn::Mul(a.w, b.y), hn::Mul(a.y, b.w)),
                    hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z))),
            hn::Add(hn::Sub(hn::Mul(a.w, b.z), hn::Mul(a.y, b.x)),
                    hn::Add(hn::Mul(a.z, b.w), hn::Mul(a.x, b.y))),
            hn::Sub(hn::Sub(hn::Mul(a.w, b.w), hn::Mul(a.y, b.y)),
                    hn::Add(hn::Mul(a.z, b.z), hn::Mul(a.x, b.x)))};
}
HWY_INLINE Quaternions Normalized(Quaternions q) {
    const Lanes square = hn::Add(hn::Add(hn::Mul(q.x, q.x), hn::Mul(q.z, q.z)),
                                 hn::Add(hn::Mul(q.y, q.y), hn::Mul(q.w, q.w)));
    const Lanes length = hn::Sqrt(square);
    const Quaternions unit{hn::Div(q.x, length), hn::Div(q.y, length), hn::Div(q.z, length),
                           hn::Div(q.w, length)};
    return Choose(hn::Gt(square, hn::Zero(Tag())), unit, q);
}

// exponential_map() but for angles beyond 1 rad, which are noted.
struct ExponentialMap {
    Mask beyond;

    HWY_INLINE ExponentialMap() : beyond(hn::FirstN(Tag(), 0)) {}
    HWY_INLINE Quaternions operator()(Vectors angle) {
        const Tag d;
        const Lanes one = All(1.0);
        const Vectors half = Scale(All(0.5), angle);
        const Lanes x2 = Dot(half, half);
        beyond = hn::Or(beyond, hn::Gt(x2, All(kRotationSeries.kLargest)));
        // Horner's scheme. Lanes of small angles need the first terms only: they begin with these,
        // so that their bits do not depend on the other lanes.
        Lanes sinc = one, cosine = one;
        const auto add_term = [&](std::size_t k) HWY_ATTR {
            sinc = hn::Sub(one, hn::Mul(hn::Mul(x2, All(kRotationSeries.of_sinc[k])), sinc));
            cosine = hn::Sub(one, hn::Mul(hn::Mul(x2, All(kRotationSeries.of_cosine[k])), cosine));
        };
        const Mask small = hn::Le(x2, All(kRotationSeries.kSmall));
        if (!hn::AllTrue(d, small)) {
            for (std::size_t k = kRotationSeries.kTerms; k > kRotationSeries.kFewTerms; --k)
                add_term(k);
            sinc = hn::IfThenElse(small, one, sinc);
            cosine = hn::IfThenElse(small, one, cosine);
        }
        for (std::size_t k = kRotationSeries.kFewTerms; k >= 1; --k) add_term(k);
        return {hn::Mul(sinc, half.x), hn::Mul(sinc, half.y), hn::Mul(sinc, half.z), cosine};
    }
};

// advance_orientation() from its first angle, k1: equation (18). The chain of products is long, and
// eight floes side by side take little longer than one.
HWY_INLINE Quaternions Turn(Quaternions q, const Matrices& inverse_inertia,
                            Vectors angular_momentum, Vectors k1, Lanes dt, ExponentialMap& map) {
    const auto turn = [&](Vectors angle) HWY_ATTR {
        const Matrices r = RotationOf(Product(map(angle), q));
        return Scale(dt, Turned(r, inverse_inertia, angular_momentum));
    };
    const Lanes half = All(0.5), two = All(2.0), six = All(6.0);
    const Vectors k2 = turn(Scale(half, k1));
    const Vectors k3 = turn(Sub(Scale(half, k2), Scale(All(0.125), Cross(k1, k2))));
    const Vectors k4 = turn(k3);
    const Vectors sum = Add(Add(Add(k1, Scale(two, k2)), Scale(two, k3)), k4);
    const Vectors whole = Sub(sum, Scale(half, Cross(k1, k4)));
    const Vectors angle{hn::Div(whole.x, six), hn::Div(whole.y, six), hn::Div(whole.z, six)};
    return Normalized(Product(map(angle), q));
}

// Of no more floes than there are lanes.
void AdvancePart(Bodies& b, std::span<const std::int32_t> floes, const Advance& step) {
    const Tag d;
    const BodyLanes at(floes);
    const Lanes dt = All(step.dt), mass = at.Load(b.mass);
    const Vectors v = at.Load(b.velocity);
    Quaternions q = at.Load(b.orientation);
    Matrices r = RotationOf(q);
    Vectors momentum = Scale(mass, v);
    if (b.have_added_mass()) momentum = Add(momentum, Turned(r, at.Load(b, &Inertia::added), v));

    // Contacts and loads have changed the angular velocity since the start of the step, and the
    // angular momentum gains I times that change. A floe without a change keeps the bits of its
    // momentum: I w would differ from L by rounding.
    const Vectors change = Sub(at.Load(b.angular_velocity), at.Load(step.angular_velocity_start));
    const Mask changed = NotZero(change);
    Vectors angular_momentum = at.Load(b.angular_momentum);
    if (!hn::AllFalse(d, changed)) {
        const Vectors gain = Turned(r, at.Load(b, &Inertia::body), change);
        angular_momentum = Choose(changed, Add(angular_momentum, gain), angular_momentum);
    }

    // rotation without torque: L is constant, and w = I^-1 L changes with the orientation
    const Matrices inverse_inertia = at.Load(b, &Inertia::inverse);
    const Vectors k1 = Scale(dt, Turned(r, inverse_inertia, angular_momentum));
    const Vectors turn = at.Load(step.corrections.turn);
    const Mask spins = NotZero(k1), corrected = NotZero(turn);
    ExponentialMap map;
    if (!hn::AllFalse(d, spins))
        q = Choose(spins, Turn(q, inverse_inertia, angular_momentum, k1, dt, map), q);
    if (!hn::AllFalse(d, corrected)) q = Choose(corrected, Normalized(Product(map(turn), q)), q);
    // a lane turns by more than the series of the exponential map covers
    if (!hn::AllFalse(d, map.beyond)) return reference::advance_floes(b, floes, step);

    // where nothing turns, all that follows from the orientation is there
    const bool any_turns = !hn::AllFalse(d, hn::Or(spins, corrected));
    if (any_turns) {
        r = RotationOf(q);
        at.Store(q, b.orientation);
        at.Store(r, b.rotation);
    }
    const Matrices inverse_world = Turned(r, inverse_inertia);
    if (any_turns) at.Store(inverse_world, b.inverse_inertia_world);
    at.Store(angular_momentum, b.angular_momentum);
    at.Store(Product(inverse_world, angular_momentum), b.angular_velocity);
    at.Store(momentum, b.momentum);
    // Momentum is constant within the turn. Added mass turns with the floe, so that the same
    // momentum has another velocity after it.
    Vectors velocity{hn::Div(momentum.x, mass), hn::Div(momentum.y, mass),
                     hn::Div(momentum.z, mass)};
    if (b.have_added_mass()) {
        const Matrices excess = Turned(r, at.Load(b, &Inertia::inverse_excess));
        at.Store(excess, b.inverse_mass_excess);
        velocity = Add(velocity, Product(excess, momentum));
    }
    at.Store(velocity, b.velocity);
    const Vectors move = Add(Scale(dt, v), at.Load(step.corrections.shift));
    at.Store(Add(at.Load(b.position), move), b.position);
}

void AdvanceFloes(Bodies& bodies, std::span<const std::int32_t> floes, const Advance& step) {
    for (std::size_t k = 0; k < floes.size(); k += kMostLanes)
        AdvancePart(bodies, floes.subspan(k, std::min(kMostLanes, floes.size() - k)), step);
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ice {
HWY_EXPORT(AdvanceFloes);

void advance_floes(Bodies& bodies, std::span<const std::int32_t> floes, const Advance& step) {
    HWY_DYNAMIC_DISPATCH(AdvanceFloes)(bodies, floes, step);
}
}  // namespace ice
#endif
