// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice::report {

/// Address, relative to a page in `folder`, of the sweep page that the run belongs to: sweep.html
/// one or two folders above, also where only the sweep's plan (runs.toml) is there yet, because the
/// page follows when all runs are done. "" for a run by itself.
std::string find_sweep(const std::filesystem::path& folder);

}  // namespace ice::report
