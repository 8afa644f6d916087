// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/case/case_schema.hpp"

namespace ice {

/// Keys of [ship], [propulsion], [tow] and [mooring].
std::vector<CaseKey> ship_keys();

}  // namespace ice
