// SPDX-License-Identifier: GPL-3.0-or-later
/// A run folder in memory, as read_run_folder() would give it.
#pragma once

#include "postprocess/read/read_run_folder.hpp"
#include "tests/common/fixtures.hpp"

namespace ice::test {

/// make_run() with a summary of made-up numbers that no other text of the report contains.
inline read::RunFolder make_folder(const RunSize& size = {}) {
    read::RunFolder folder;
    folder.data = make_run(size);
    Summary s;
    s.title = folder.data.header.title;
    s.dimension = size.dimension;
    s.steps = 450;
    s.simulated_s = 4.5;
    s.wall_s = 0.9;
    s.threads = 2;
    s.floes_total = 6;
    s.floes_moved = 5;
    s.average_from = 1.5;
    s.resistance = {1107.0, 1006.0, 101.0, 143.0, 1320.0, 12.0};
    s.lateral = {-3.0, -2.0, -1.0, 36.0, 55.0, 4.0};
    s.vertical = {441.0, 402.0, 39.0, 7.0, 480.0, 2.0};
    s.regions["bottom"] = {37, 8.25, {-777.0, 5.0, 333.0}};
    s.regions["bottom"].force_peaks = {3, 640.0, 880.0, 923.0, {{923.0, 1200.0}, {871.0, 3600.0}}};
    s.regions["bottom"].line_load_peaks = {1, 600.0, 1700.0, 1800.0, {{1800.0, 1200.0}}};
    s.panels = {0.5, 0.1, 2, 1, {{"bottom", folder.data.panels.panels[0]}}};
    s.ship.length = 8.0;
    s.ship.draught = 0.7;
    s.ice.thickness = 0.2;
    s.ice.density = 900.0;
    s.ice.friction_ship_ice = 0.1;
    s.ice.friction_ice_ice = 0.35;
    s.ice.crushing_pressure = 1.25e6;
    s.ice.hold = {"until-hull-contact"};
    s.travel = {4.5, 0.5625, 0.375};
    s.formulas = {{"Lindqvist 1989", "submersion", 954.0, true}};
    s.contacts_mean = 3.25;
    s.energy["kinetic_J"] = 12.5;
    s.energy["ship_work_J"] = 8400.0;
    s.energy["drag_J"] = 1470.0;
    s.energy["residual_J"] = -6.0;
    s.lindqvist_submersion = 954.0;
    s.warnings = {{.text = "a floe <7> left the field & sank"}};
    folder.summary = s;
    return folder;
}

inline std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

/// What is wrong with the tags of an XML text, or "": every tag closed, in the right order.
inline std::string tag_fault(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return "a tag without end";
        if (text[at + 1] == '!' || text[at + 1] == '?') continue;
        const bool closing = text[at + 1] == '/';
        const std::size_t first = at + (closing ? 2 : 1);
        const std::string name = text.substr(first, text.find_first_of(" />\n", first) - first);
        if (closing) {
            if (open.empty() || open.back() != name) return "unexpected </" + name + ">";
            open.pop_back();
        } else if (text[end - 1] != '/') {
            open.push_back(name);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

/// The page without what lies in its scripts, style and comments
inline std::string markup_of(std::string html) {
    for (const auto& [begin, end] : {std::pair("<script", "</script>"),
                                     std::pair("<style", "</style>"), std::pair("<!--", "-->")})
        for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at))
            html.erase(at, html.find(end, at) + std::string(end).size() - at);
    return html;
}

}  // namespace ice::test
