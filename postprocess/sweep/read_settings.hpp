// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// The plan of a sweep as the workflow leaves it (runs.toml).
struct Plan {
    struct Run {
        std::string name;                       ///< of its folder in runs/
        std::map<std::string, Setting> values;  ///< by dotted key
    };
    std::string title;
    std::vector<std::string> axes;  ///< dotted keys; may be empty
    std::vector<Run> runs;          ///< at least one
};

/// @throws Error (exit code 2) naming file, line and key.
Plan read_plan(const std::filesystem::path& file);

/// Settings of a case by dotted key; keys of several groups of floes carry the group's number,
/// from 1 ("floes.2.gap"). Titles and [output] are left out, because no force depends on them.
/// A missing or faulty file gives none.
std::map<std::string, Setting> read_settings(const std::filesystem::path& resolved_case);

}  // namespace ice::sweep
