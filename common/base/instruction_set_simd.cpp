// SPDX-License-Identifier: GPL-3.0-or-later
// Which of Highway's targets the kernels run on: the best that the machine has, or the one named.
#include <hwy/targets.h>

#include <array>
#include <cstdint>
#include <string>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"

namespace ice {

namespace {

struct Target {
    std::string_view name;
    std::int64_t bit;
};

// best first; AVX3 is Highway's name for AVX-512
constexpr std::array<Target, 4> kTargets{
    {{"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}, {"scalar", HWY_SCALAR}}};

// Targets for one number at a time. Every machine has them, and Highway reports them only in builds
// that contain nothing else.
constexpr std::int64_t kScalarBits = HWY_SCALAR | HWY_EMU128;

// Highway's SupportedTargets() also makes the best of them the chosen one: the caller must choose
// again afterwards.
std::int64_t supported() { return hwy::SupportedTargets() | kScalarBits; }

std::string_view& in_use() {
    static std::string_view name = "";  // none chosen yet: the best
    return name;
}

const Target& best_of(std::int64_t targets) {
    for (const Target& t : kTargets)
        if ((targets & t.bit) != 0) return t;
    return kTargets.back();
}

}  // namespace

void set_instruction_set(std::string_view name) {
    hwy::DisableTargets(0);
    const std::int64_t all = supported();
    const Target& wanted = [&]() -> const Target& {
        for (const Target& t : kTargets)
            if (t.name == name) return t;
        return best_of(all);
    }();
    if ((all & wanted.bit) == 0)
        throw bad_input("--simd", "this machine lacks " + std::string(name),
                        "the best it has is " + std::string(best_of(all).name));
    // better targets have lower bits
    hwy::DisableTargets((wanted.bit - 1) & ~kScalarBits);
    hwy::GetChosenTarget().Update(supported());
    in_use() = wanted.name;
}

std::string_view instruction_set() {
    if (in_use().empty()) set_instruction_set("auto");
    return in_use();
}

}  // namespace ice
