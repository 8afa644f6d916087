// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// HTML: ship, ice and speeds of the runs in a line each, from their summaries' `ship`, `ice` and
/// settings; values that differ between runs are given as a range, unknown ones are left out. Runs
/// from before summaries had these give the speeds alone. "" where nothing is known.
std::string head_facts(const Sweep& sweep);

}  // namespace ice::sweep
