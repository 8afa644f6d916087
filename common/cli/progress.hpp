// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/base/timer.hpp"

namespace ice {

/// Progress of long work on stderr: on a terminal one line, as wide as it, redrawn at most 10 times
/// a second, elsewhere a line per 10 %, nothing when quiet. It has the time left from 1 s and 1 %
/// on. Not for several threads at once.
class Progress {
public:
    Progress(std::string label, bool quiet);
    /// @param fraction  done [-], cut to [0, 1]
    /// @param note      short text behind the bar, e.g. "12.3x real time"
    void update(double fraction, const std::string& note);
    /// Ends the line.
    void finish();

private:
    std::string label_;
    bool quiet_, terminal_;
    int last_tenth_ = -1;
    double last_drawn_ = -1.0;
    Timer timer_;
};

}  // namespace ice
