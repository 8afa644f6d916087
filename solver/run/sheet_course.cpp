// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/sheet_course.hpp"

#include <algorithm>
#include <limits>

#include "solver/live_edge/hull_outlines.hpp"

namespace ice {

namespace {

constexpr double kNotMet = std::numeric_limits<double>::infinity();

// The part of the outlines between two heights y [m]; empty where there is none.
Eigen::AlignedBox2d part_abreast(const std::vector<Loop>& outlines, const Eigen::AlignedBox2d& hull,
                                 double low, double high) {
    Eigen::AlignedBox2d out;
    for (const Loop& outline : outlines)
        for (const Loop& part : common_part(outline, loop_of({Vec2(hull.min().x() - 1.0, low),
                                                              Vec2(hull.max().x() + 1.0, high)})))
            for (const Vec2& corner : part) out.extend(corner);
    return out;
}

}  // namespace

SheetCourse measure_sheet_course(const World& w, double direction) {
    const auto& [from, to, starboard, port] = w.parameters.level_ice.extent;
    const double half = 0.5 * w.edge.thickness();
    const std::vector<Loop> outlines =
        hull_outlines(w.scene, w.edge.height() + half, w.edge.height() - half);
    SheetCourse out;
    for (const Loop& outline : outlines)
        for (const Vec2& corner : outline) out.hull.extend(corner);
    // a section has no sides
    const Eigen::AlignedBox2d part =
        w.edge.is_strip() ? out.hull : part_abreast(outlines, out.hull, starboard, port);
    out.beside = part.isEmpty();
    if (out.beside) {
        out.clearance = out.through = kNotMet;
        return out;
    }
    // along the course, so that both directions have one formula
    const bool ahead = direction > 0.0;
    const double near = ahead ? from : -to, far = ahead ? to : -from;
    const double bow = ahead ? part.max().x() : -part.min().x();
    const double stern = ahead ? part.min().x() : -part.max().x();
    const double foremost = ahead ? out.hull.max().x() : -out.hull.min().x();
    out.to_clear = direction * (near - bow);
    out.clearance = stern >= far ? kNotMet : std::max(near - bow, 0.0);
    out.through = stern >= far ? kNotMet : std::max(far - foremost, 0.0);
    return out;
}

}  // namespace ice
