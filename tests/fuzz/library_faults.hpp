// SPDX-License-Identifier: GPL-3.0-or-later
/// Whose fault it was when a child process of rehearse() died.
#pragma once

#include "common/base/error.hpp"

namespace ice::fuzz {

/// A fault inside assimp or HDF5, in the child, is what rehearse() is for and no finding. This
/// reports one that happened in our own code there, which the caller cannot tell from theirs.
/// The address sanitizer's first stack decides.
void check_child_faults();

/// What a target returns: -1 after an input whose reading did not end, of which the fuzzer shall
/// make no others; 0 else.
int verdict(const Error& refusal);

}  // namespace ice::fuzz
