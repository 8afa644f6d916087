// SPDX-License-Identifier: GPL-3.0-or-later
// The report's sections on the mean force's line of action, the moments, and the motion of a free
// ship.
#include <fmt/format.h>

#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/statistics/line_of_action.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

namespace {

// Decimals of a place in metres [-]: a centimetre is below the distance of the hull's spheres. More
// would show digits without meaning.
constexpr int kDecimals = 2;

std::string place(const Vec3& p, int dimension) {
    // in 2D without y, which has no meaning
    if (dimension == 2)
        return fmt::format("x {:.{}f}, z {:.{}f} m", p.x(), kDecimals, p.z(), kDecimals);
    return fmt::format("x {:.{}f}, y {:.{}f}, z {:.{}f} m", p.x(), kDecimals, p.y(), kDecimals,
                       p.z(), kDecimals);
}

std::string components(const ForceUnit& unit, const Vec3& v, int dimension) {
    if (dimension == 2)
        return fmt::format("x {}, z {} {}", unit.text(v.x()), unit.text(v.z()), unit.name);
    return fmt::format("x {}, y {}, z {} {}", unit.text(v.x()), unit.text(v.y()), unit.text(v.z()),
                       unit.name);
}

}  // namespace

std::string moment_section(const RunData& run, const RunFigures& figures) {
    if (figures.moments.empty()) return "";
    const int dimension = run.header.dimension;
    const auto load = statistics::find_line_of_action(run, figures.average_from);
    const ForceUnit moment = moment_unit(figures.unit);
    std::vector<std::pair<std::string, std::string>> rows{
        {"Mean force", components(figures.unit, load.force, dimension)}};
    // In a section only trim has a meaning.
    if (dimension == 2) {
        rows.emplace_back("Mean moment, trim, bow down",
                          moment.text(load.moment.y()) + " " + moment.name);
    } else {
        rows.emplace_back("Mean moment, heel, to starboard",
                          moment.text(load.moment.x()) + " " + moment.name);
        rows.emplace_back("Mean moment, trim, bow down",
                          moment.text(load.moment.y()) + " " + moment.name);
        rows.emplace_back("Mean moment, yaw, to port",
                          moment.text(load.moment.z()) + " " + moment.name);
    }
    if (load.center) rows.emplace_back("Centre of normal load", place(*load.center, dimension));
    if (load.point)
        rows.emplace_back("Point of attack of the mean force", place(*load.point, dimension));
    // A force and a moment in space are a force on a line and a couple about it; in a plane the
    // couple vanishes.
    if (dimension == 3 && load.point)
        rows.emplace_back("Couple left about that line",
                          moment.text(load.couple) + " " + moment.name);
    std::vector<std::string> charts;
    for (const History& h : figures.moments) charts.push_back(chart_holder(h.id, draw_history(h)));
    return section(
        "moments", "Point of attack and moments",
        fmt::format(
            "Means from {} to {} s. Places and moments are about the origin of the hull's mesh, "
            "axes "
            "of the ship (x forward, y to port, z up). The centre of normal load is the mean place "
            "of all contacts, weighted by force; the point of attack is the point of the mean "
            "force's line of action that is nearest to it.",
            views::readable(load.from), views::readable(load.to)),
        facts(rows) + report::figures(charts));
}

std::string motion_section(const RunData& run, const RunFigures& figures) {
    if (figures.motions.empty()) return "";
    std::vector<std::string> charts;
    for (const History& h : figures.motions) charts.push_back(chart_holder(h.id, draw_history(h)));
    return section("motion", "Motion of the ship",
                   fmt::format("Forces move the ship; motions that are locked are not shown. "
                               "Thin: samples; thick: moving averages over {} s.",
                               views::readable(average_window(run.history))),
                   report::figures(charts));
}

}  // namespace ice::report
