// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/spheres_report.hpp"

namespace ice {

/// The one-screen report of a finished set.
std::string report_text(const SpheresReport& report, const std::string& output);

}  // namespace ice
