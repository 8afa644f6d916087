// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/summary_file.hpp"
#include "common/formats/warning.hpp"

namespace ice {

/// The straight line through the resistance of the averaged time, as a warning. Its share is half
/// of the line's change over the mean [-]: the mean of a state that lasts may be as far away as the
/// line's end. @pre the mean is not 0
Warning warn_of_trend(const Summary& summary);

/// Averages over less than a ship length, as a warning. Its share is the interval over the mean
/// [-]. The text is the same for all members of an ensemble that travel alike. @pre the mean is not
/// 0
Warning warn_of_short_averages(const Summary& summary);

}  // namespace ice
