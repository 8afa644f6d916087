// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/cli/console.hpp"

namespace ice {

namespace {

// The remaining time is shown once a second and a hundredth of the work are done: the start of a
// run says little about the rest.
std::string time_left(double fraction, double elapsed) {
    if (elapsed < 1.0 || fraction < 0.01) return "";
    const double left = elapsed * (1.0 - fraction) / fraction;
    return left < 0.5 ? "" : fmt::format(", {:.0f} s left", left);
}

// On one line of the terminal: the bar gets the columns beside the words, the words lose their end.
std::string bar_line(const std::string& label, double fraction, const std::string& words) {
    // Columns of the bar [-]: at most 30, so that a step of it is about 3 %; below 5 it says
    // nothing, and the words alone are shown. A longer bar leaves less room for the words.
    constexpr int kBar = 30, kShortestBar = 5;
    const int width = std::max(terminal_width() - 1, 1);  // in the last column some terminals wrap
    const int taken = static_cast<int>(label.size() + words.size()) + 4;  // blanks and brackets
    const int bar = std::min(kBar, width - taken);
    if (bar < kShortestBar)
        return fmt::format("{} {}", label, words).substr(0, static_cast<std::size_t>(width));
    const int filled = static_cast<int>(fraction * bar);
    return fmt::format("{} [{:#<{}}{:.<{}}] {}", label, "", filled, "", bar - filled, words);
}

// Not fmt::print, which throws if stderr has no reader.
void show(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), quiet_(quiet), terminal_(stderr_is_terminal()) {}

void Progress::update(double fraction, const std::string& note) {
    if (quiet_) return;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const double now = timer_.seconds();
    const std::string left = time_left(fraction, now);
    if (!terminal_) {
        // 1e-9: a sum of steps may end just below the tenth
        const int tenth = static_cast<int>(fraction * 10.0 + 1e-9);
        if (tenth == last_tenth_) return;
        last_tenth_ = tenth;
        show(fmt::format("{} {:3d} %{}, {}\n", label_, tenth * 10, left, note));
        return;
    }
    // ten times a second: a terminal over a network is no slower for it
    if (last_drawn_ >= 0.0 && now - last_drawn_ < 0.1 && fraction < 1.0) return;
    last_drawn_ = now;
    const std::string words = fmt::format("{:3.0f} %{}, {}", 100.0 * fraction, left, note);
    show("\r" + bar_line(label_, fraction, words) + "\033[K");
}

void Progress::finish() {
    if (!quiet_ && terminal_ && last_drawn_ >= 0.0) show("\n");
}

}  // namespace ice
