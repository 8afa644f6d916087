// SPDX-License-Identifier: GPL-3.0-or-later
/// Which instruction set the vector kernels (*_simd.cpp) run on; results are the same on all.
#pragma once

#include <string_view>

namespace ice {

/// Restricts the kernels to "scalar", "sse4", "avx2" or "avx512" from now on; "auto" takes the best
/// that this machine has. Not while kernels run.
/// @throws Error (exit code 2) where the machine lacks it, naming the best it has
void set_instruction_set(std::string_view name);

/// The one in use: one of the four names above. The first call chooses the best unless
/// set_instruction_set() did.
std::string_view instruction_set();

}  // namespace ice
