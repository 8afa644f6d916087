// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/sensitivity/read_study.hpp"

namespace ice::sensitivity {

/// The tornado chart as an SVG file's text.
std::string make_tornado(const Study& study);

/// Text for a terminal: the case's resistance with its interval, the model's error beside it,
/// a line per value with the difference, its 95 % interval and its share of the resistance,
/// "*" where the interval leaves out zero; then inputs that were left out, with reasons.
std::string study_text(const Study& study);

/// The study as a page, with the chart and the source of each range. One file without script that
/// loads nothing; valid XML.
std::string make_study_page(const Study& study);

}  // namespace ice::sensitivity
