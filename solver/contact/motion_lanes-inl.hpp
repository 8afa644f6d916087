// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of as many bodies as the machine has lanes, each number of theirs in lanes. Included once
// per instruction set, hence the guard that lets it in again for each.
#if defined(ICE_MOTION_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ICE_MOTION_LANES_INL
#undef ICE_MOTION_LANES_INL
#else
#define ICE_MOTION_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "solver/contact/contact_rows.hpp"
#include "solver/shape/vector_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMotionLanes = hn::MaxLanes(Tag());

// Entry k of row i becomes entry i of row k: first within blocks of two by two, then the blocks.
// Number by number through memory a block of pairs takes as long as two or three of its contacts.
HWY_INLINE void Transpose(Lanes* rows) {
    [[maybe_unused]] const Tag d;
#if HWY_TARGET != HWY_SCALAR
    Lanes pairs[kMotionLanes];  // of entries k and k + 1 at even and odd k
    for (std::size_t k = 0; k + 1 < kMotionLanes; k += 2) {
        pairs[k] = hn::InterleaveLower(d, rows[k], rows[k + 1]);
        pairs[k + 1] = hn::InterleaveUpper(d, rows[k], rows[k + 1]);
    }
    if constexpr (kMotionLanes <= 2)
        for (std::size_t k = 0; k < kMotionLanes; ++k) rows[k] = pairs[k];
    for (std::size_t k = 0; kMotionLanes == 4 && k < 2; ++k) {
        rows[k] = hn::ConcatLowerLower(d, pairs[k + 2], pairs[k]);
        rows[k + 2] = hn::ConcatUpperUpper(d, pairs[k + 2], pairs[k]);
    }
    for (std::size_t k = 0; kMotionLanes == 8 && k < 2; ++k) {
        const auto even = [&](std::size_t r) HWY_ATTR {
            return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(pairs[r + 2]), pairs[r]);
        };
        const auto odd = [&](std::size_t r) HWY_ATTR {
            return hn::OddEvenBlocks(pairs[r + 2], hn::SwapAdjacentBlocks(pairs[r]));
        };
        rows[k] = hn::ConcatLowerLower(d, even(k + 4), even(k));
        rows[k + 2] = hn::ConcatLowerLower(d, odd(k + 4), odd(k));
        rows[k + 4] = hn::ConcatUpperUpper(d, even(k + 4), even(k));
        rows[k + 6] = hn::ConcatUpperUpper(d, odd(k + 4), odd(k));
    }
#else
    static_cast<void>(rows);
#endif
}

// The eight numbers of each body's motion.
struct Motions {
    Lanes entry[8];
};

// @param body  local numbers of as many bodies as there are lanes; any will do for -1
HWY_INLINE Motions LoadMotions(const std::int32_t* body, const std::vector<BodyMotion>& motion) {
    Motions out;
    for (std::size_t part = 0; part < 8; part += kMotionLanes) {
        for (std::size_t k = 0; k < kMotionLanes; ++k)
            out.entry[part + k] = hn::Load(
                Tag(), motion[static_cast<std::size_t>(body[k] < 0 ? 0 : body[k])].v + part);
        Transpose(out.entry + part);
    }
    return out;
}

// @param moves  of as many bodies as there are lanes: those for which it is zero keep their motion
HWY_INLINE void StoreMotions(Motions motions, const std::int32_t* body, const double* moves,
                             std::vector<BodyMotion>& motion) {
    for (std::size_t part = 0; part < 8; part += kMotionLanes) {
        Transpose(motions.entry + part);
        for (std::size_t k = 0; k < kMotionLanes; ++k)
            if (moves[k] != 0.0)
                hn::Store(motions.entry[part + k], Tag(),
                          motion[static_cast<std::size_t>(body[k])].v + part);
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
