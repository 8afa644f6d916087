// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/line_of_action.hpp"

#include "common/base/time_rounding.hpp"

namespace ice::statistics {

namespace {

std::optional<Vec3> center_of_load(const RunData& run, double from) {
    double weight = 0.0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t f = 1; f < run.frames.size(); ++f) {
        const double begin = run.frames[f - 1].time;
        // forces of a frame are means since the one before: with that time they are impulses
        if (begin < from - kTimeRounding) continue;
        for (const HullContact& c : run.frames[f].hull_contacts) {
            const double impulse = c.normal_force.norm() * (run.frames[f].time - begin);
            weight += impulse;
            sum += impulse * c.point;
        }
    }
    if (!(weight > 0.0)) return std::nullopt;
    return sum / weight;
}

}  // namespace

LineOfAction find_line_of_action(const RunData& run, double from) {
    LineOfAction out;
    out.from = from;
    out.to = run.history.empty() ? from : run.history.back().time;
    out.center = center_of_load(run, from);
    double count = 0.0;
    for (const HistoryRow& row : run.history) {
        if (row.time < from - kTimeRounding) continue;
        out.force += row.contact_force + row.friction_force;
        out.moment += row.moment;
        ++count;
    }
    if (count == 0.0) return out;
    out.force /= count;
    out.moment /= count;
    // Central axis of the mean load (Poinsot):
    // A force system is a force along its central axis and a couple about it. From the moment M_c
    // about c the axis passes through c + F x M_c / |F|^2, and the couple is M_c . F / |F|.
    const double size = out.force.squaredNorm();
    if (!(size > 0.0)) return out;
    const Vec3 c = out.center.value_or(Vec3::Zero());
    const Vec3 about_center = out.moment - c.cross(out.force);
    out.point = c + out.force.cross(about_center) / size;
    out.couple = about_center.dot(out.force) / std::sqrt(size);
    return out;
}

}  // namespace ice::statistics
