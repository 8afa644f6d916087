// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/cli/console.hpp"

namespace ice {

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), quiet_(quiet), terminal_(stderr_is_terminal()) {}

void Progress::update(double fraction, const std::string& note) {
    if (quiet_) return;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const double now = timer_.seconds();
    const double left = fraction > 0.0 ? now * (1.0 - fraction) / fraction : 0.0;
    if (!terminal_) {
        const int tenth = static_cast<int>(fraction * 10.0 + 1e-9);
        if (tenth == last_tenth_) return;
        last_tenth_ = tenth;
        fmt::print(stderr, "{} {:3d} %, {:.0f} s left, {}\n", label_, tenth * 10, left, note);
        return;
    }
    if (last_drawn_ >= 0.0 && now - last_drawn_ < 0.1 && fraction < 1.0) return;
    last_drawn_ = now;
    const int filled = static_cast<int>(fraction * 30.0);
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} %, {:.0f} s left, {}\033[K", label_, "",
               filled, "", 30 - filled, 100.0 * fraction, left, note);
    std::fflush(stderr);
}

void Progress::finish() {
    if (!quiet_ && terminal_ && last_drawn_ >= 0.0) fmt::print(stderr, "\n");
}

}  // namespace ice
