// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ice {

/// Spheres of a hexagonal layer per square of its spacing [-]: 2 / sqrt(3), to four digits. It
/// estimates how many spheres a surface takes: a larger value refuses fills that have room and
/// drafts wider spacings, a smaller one begins fills that run out of memory.
constexpr double kHexagonal = 1.155;

}  // namespace ice
