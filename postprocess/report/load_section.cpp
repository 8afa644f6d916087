// SPDX-License-Identifier: GPL-3.0-or-later
// The report's map of the mean load on the hull, seen from several sides.
#include <fmt/format.h>

#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/views/load_view.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::readable;
using views::ViewFrom;

std::string draw_hull_loads(const RunData& run, const statistics::LoadMap& map, double end,
                            const std::string& what) {
    const PressureUnit unit = choose_pressure_unit(end);
    const views::HullLoad hull{run.header.shapes[0].mesh, map.mesh, map.load, end,
                               -run.frames.front().ship_position.z()};
    // A section of 2D shows all of its load from one side.
    const std::vector<ViewFrom> sides =
        run.header.dimension == 2 ? std::vector<ViewFrom>{ViewFrom::side}
                                  : std::vector<ViewFrom>{ViewFrom::below, ViewFrom::front,
                                                          ViewFrom::side, ViewFrom::port};
    std::vector<std::string> pictures;
    for (const ViewFrom from : sides) pictures.push_back(views::draw_load_view(hull, from, 560.0));
    return "<div class=\"natural\"><div class=\"legend\">" +
           views::draw_load_legend(readable(0.5 * end / unit.pascals), readable(end / unit.pascals),
                                   unit.name, what) +
           "</div>\n" + report::figures(pictures) + "</div>\n";
}

std::string load_section(const RunData& run, const RunFigures& figures) {
    const statistics::LoadMap& map = figures.load;
    if (!(map.force > 0.0)) return "";
    // The colours do not end at the largest value: a single sphere at a corner would leave all else
    // pale.
    const double end = statistics::scale_end(map);
    const PressureUnit unit = choose_pressure_unit(end);
    double largest = 0.0;
    for (const double p : map.load) largest = std::max(largest, p);
    return section(
        "load", "Load map of the hull",
        fmt::format(
            "Normal load of the ice per area of hull, mean over {} to {} s; each contact "
            "is spread over {:.2g} m. Colours end at {} {}, which 99 % of the loaded area stays "
            "below; the largest is {} {}. The sum of all normal forces is {} {} on the "
            "average (their amounts: forces from port and starboard do not cancel).",
            readable(map.from), readable(map.to), map.radius, readable(end / unit.pascals),
            unit.name, readable(largest / unit.pascals), unit.name, figures.unit.text(map.force),
            figures.unit.name),
        draw_hull_loads(run, map, end, "mean normal load"));
}

}  // namespace ice::report
