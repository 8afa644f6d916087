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
#include <cstdint>
#include <vector>

#include "common/math/vector_lanes-inl.hpp"
#include "solver/contact/contact_rows.hpp"

HWY_BEFORE_NAMESPACE();
namespace ice::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
// Entries k and k + 1 of rows k and k + 1 change places, for even k, in each two entries.
HWY_INLINE void TransposeTwos(Lanes* rows) {
    const Tag d;
    for (std::size_t k = 0; k < kMostLanes; k += 2) {
        const Lanes upper = hn::InterleaveUpper(d, rows[k], rows[k + 1]);
        rows[k] = hn::InterleaveLower(d, rows[k], rows[k + 1]);
        rows[k + 1] = upper;
    }
}
#endif

// Entry k of row i becomes entry i of row k: first within blocks of two by two, then the blocks.
// Fetching motions number by number takes a block of pairs as long as two or three contacts.
HWY_INLINE void Transpose([[maybe_unused]] Lanes* rows) {
    static_assert(kMostLanes == 1 || kMostLanes == 2 || kMostLanes == 4 || kMostLanes == 8);
#if HWY_TARGET != HWY_SCALAR
    [[maybe_unused]] const Tag d;
    if constexpr (kMostLanes > 1) TransposeTwos(rows);
    // four lanes have two blocks of two numbers, eight have four
    if constexpr (kMostLanes == 4)
        for (std::size_t k = 0; k < 2; ++k) {
            const Lanes upper = hn::ConcatUpperUpper(d, rows[k + 2], rows[k]);
            rows[k] = hn::ConcatLowerLower(d, rows[k + 2], rows[k]);
            rows[k + 2] = upper;
        }
    if constexpr (kMostLanes == 8)
        for (std::size_t k = 0; k < 2; ++k) {
            const auto even = [&](std::size_t r) HWY_ATTR {
                return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(rows[r + 2]), rows[r]);
            };
            const auto odd = [&](std::size_t r) HWY_ATTR {
                return hn::OddEvenBlocks(rows[r + 2], hn::SwapAdjacentBlocks(rows[r]));
            };
            const Lanes low_even = even(k), low_odd = odd(k);
            const Lanes high_even = even(k + 4), high_odd = odd(k + 4);
            rows[k] = hn::ConcatLowerLower(d, high_even, low_even);
            rows[k + 2] = hn::ConcatLowerLower(d, high_odd, low_odd);
            rows[k + 4] = hn::ConcatUpperUpper(d, high_even, low_even);
            rows[k + 6] = hn::ConcatUpperUpper(d, high_odd, low_odd);
        }
#endif
}

// The eight numbers of each body's motion.
struct Motions {
    Lanes entry[8];
};

// @param body  local numbers of as many bodies as there are lanes; -1 for lanes that are not used,
//              which get some body's
HWY_INLINE Motions LoadMotions(const std::int32_t* body, const std::vector<BodyMotion>& motion) {
    Motions out;
    for (std::size_t part = 0; part < 8; part += kMostLanes) {
        for (std::size_t k = 0; k < kMostLanes; ++k)
            out.entry[part + k] = hn::Load(
                Tag(), motion[static_cast<std::size_t>(body[k] < 0 ? 0 : body[k])].v + part);
        Transpose(out.entry + part);
    }
    return out;
}

// @param moves  of as many bodies as there are lanes: those for which it is zero keep their motion
HWY_INLINE void StoreMotions(Motions motions, const std::int32_t* body, const double* moves,
                             std::vector<BodyMotion>& motion) {
    for (std::size_t part = 0; part < 8; part += kMostLanes) {
        Transpose(motions.entry + part);
        for (std::size_t k = 0; k < kMostLanes; ++k)
            if (moves[k] != 0.0)
                hn::Store(motions.entry[part + k], Tag(),
                          motion[static_cast<std::size_t>(body[k])].v + part);
    }
}

}  // namespace ice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
