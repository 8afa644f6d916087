// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/summary_file.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// Describes a case before it runs, a line for each of ship, ice, course, contacts and spheres: the
/// numbers by which a user sees a wrong draught, unit or duration.
std::string describe_case(const World& world);

/// Ice and release rules in one line, printed beside the resistance.
std::string describe_rules(const Summary& summary);

}  // namespace ice
