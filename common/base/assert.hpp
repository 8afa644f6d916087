// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>

/// Checks a precondition: where it fails, the program says which and where, and aborts.
///
/// Alive in builds without NDEBUG: the presets debug, asan-ubsan and tsan. Elsewhere it costs
/// nothing: the condition is compiled and never evaluated. For faults of the caller's code; faults
/// of input are errors (error.hpp) in every build.
#ifdef NDEBUG
#define ICE_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define ICE_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ice::assertion_failed(#condition, __FILE__, __LINE__))
#endif

namespace ice {

/// Prints the condition with its place to stderr and aborts.
[[noreturn]] inline void assertion_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: precondition does not hold: %s\n", file, line, condition);
    std::abort();
}

}  // namespace ice
