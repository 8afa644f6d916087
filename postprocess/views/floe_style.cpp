// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/floe_style.hpp"

#include <fmt/format.h>

#include "postprocess/views/chart.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::views {

const FloeStyle& floe_style(FloeState state) {
    static const FloeStyle held{{210, 225, 237}, "held"}, moving{{133, 191, 232}, "moving"},
        behind{{243, 205, 130}, "behind the ship"}, absent{{255, 255, 255}, "not there"};
    switch (state) {
        case FloeState::held:
            return held;
        case FloeState::moving:
            return moving;
        case FloeState::behind:
            return behind;
        case FloeState::absent:
            break;
    }
    return absent;
}

TrailStyle trail_style(std::size_t k) {
    // Ten colours and three dash patterns have no common factor: 30 floes differ before a
    // pair of colour and dash comes again.
    static constexpr const char* kColors[]{"#332288", "#cc6677", "#117733", "#222222", "#3a9fc4",
                                           "#882255", "#8a8a1c", "#d55e00", "#aa4499", "#2a9d8f"};
    static constexpr const char* kDashes[]{"", "7 3", "2 2.5"};
    return {kColors[k % std::size(kColors)], kDashes[k % std::size(kDashes)]};
}

std::string draw_legend(double width) {
    std::string out = fmt::format(
        "<svg width=\"{}\" height=\"22\" role=\"img\" font-family=\"system-ui,Arial,sans-serif\" "
        "font-size=\"12\" fill=\"#222\"><title>Meaning of the colours</title>\n",
        pixels(width));
    double x = 8.0;
    const auto add = [&](const std::string& fill, const std::string& stroke, const char* text) {
        out += fmt::format(
            "<rect x=\"{}\" y=\"4\" width=\"16\" height=\"11\" fill=\"{}\" "
            "stroke=\"{}\" stroke-width=\"1.3\"/>",
            pixels(x), fill, stroke);
        out += text_element(x + 21.0, 14.0, text, "start");
        // 6.4 px is the mean width of a letter at this size; the browser's own font may differ a
        // little
        x += 21.0 + 6.4 * static_cast<double>(std::string(text).size()) + 12.0;
    };
    for (const FloeState state : {FloeState::held, FloeState::moving, FloeState::behind})
        add(shade(floe_style(state).color, 1.0), "#51697a", floe_style(state).meaning);
    add(shade(floe_style(FloeState::moving).color, 1.0), kOrange, "touched by the ship");
    add(shade(floe_style(FloeState::moving).color, 1.0), "#111", "tracked, with path");
    return out + "</svg>\n";
}

}  // namespace ice::views
