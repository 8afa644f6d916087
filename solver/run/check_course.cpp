// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/check_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/record/measure_particulars.hpp"
#include "solver/run/sheet_course.hpp"
#include "solver/scene/ice_extent.hpp"

namespace ice {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// Share of the averaged time without ice ahead that is worth a warning [-]: less changes a mean by
// less than its interval.
constexpr double kOpenShare = 0.02;
// Cells of the hull's cross section at most [-]. Fewer make distances coarser than a spacing.
constexpr double kMostCells = 4e6;

// The hull's cross section in cells of y and z, with the foremost point in each [m]: of its
// spheres and of its mesh, whose edges reach beyond them where they are sharp.
class Front {
public:
    // @param direction  +1 or -1: the ship moves along x or against it
    Front(const Scene& scene, double direction) : direction_(direction) {
        const Shape& hull = scene.shapes[0];
        const Vec3 place = scene.bodies.position[kShip];
        low_ = hull.box.min() + place;
        const Vec3 size = hull.box.sizes();
        // Cells as wide as the spheres' spacing, so that hardly a cell of the section is
        // without one; larger where the section is huge.
        cell_ = std::max(hull.spacing, std::sqrt(size.y() * size.z() / kMostCells));
        columns_ = count(size.y());
        rows_ = count(size.z());
        foremost_.assign(columns_ * rows_, -kNever);
        for (std::size_t k = 0; k < hull.center.size(); ++k)
            // spheres reach ahead of their centres by the radius
            add(place + hull.center[k], hull.radius[k]);
        for (const auto& t : hull.mesh.triangles)
            add_triangle(place + hull.mesh.vertices[t[0]], place + hull.mesh.vertices[t[1]],
                         place + hull.mesh.vertices[t[2]]);
    }

    // The ship's travel until it meets the cube around a sphere, in whose corners the edges and
    // corners of its floe lie; infinite where that is not in its path.
    double distance_to(const Vec3& centre, double radius) const {
        double least = kNever;
        for (int k = 0; k < 9; ++k) {
            const int beside = k % 3 - 1, above = k / 3 - 1;
            // nine points of the cube's face towards the ship
            least = std::min(least,
                             distance_to_point(centre + radius * Vec3(-direction_, beside, above)));
        }
        return least;
    }

private:
    void add(const Vec3& p, double ahead) {
        double& x = foremost_[index(at(p.y() - low_.y(), columns_), at(p.z() - low_.z(), rows_))];
        x = std::max(x, direction_ * p.x() + ahead);
    }
    // Points of a triangle no more than a cell apart: rows from its longest edge to the corner.
    void add_triangle(Vec3 a, Vec3 b, Vec3 c) {
        for (int k = 0; k < 2 && (b - a).norm() < std::max((c - b).norm(), (a - c).norm()); ++k) {
            std::swap(a, b);
            std::swap(b, c);
        }
        const double length = (b - a).norm();
        const double height = length > 0.0 ? (b - a).cross(c - a).norm() / length : 0.0;
        const double rows = std::ceil(height / cell_), most = std::ceil(length / cell_);
        for (double j = 0.0; j <= rows; ++j) {
            const double up = rows > 0.0 ? j / rows : 0.0;
            const double columns = std::ceil(most * (1.0 - up));
            for (double i = 0.0; i <= columns; ++i)
                add(a + up * (c - a) + (1.0 - up) * (columns > 0.0 ? i / columns : 0.0) * (b - a),
                    0.0);
        }
    }
    double distance_to_point(const Vec3& p) const {
        const double column = std::floor((p.y() - low_.y()) / cell_);
        const double row = std::floor((p.z() - low_.z()) / cell_);
        double x = foremost(column, row);
        // a cell without a sphere among others: its neighbours are used
        for (int k = 0; x == -kNever && k < 9; ++k) {
            const int beside = k % 3 - 1, above = k / 3 - 1;
            x = std::max(x, foremost(column + beside, row + above));
        }
        const double distance = direction_ * p.x() - x;
        // beside or behind the ship, whose bodies do not overlap the ice: passed already
        return distance < -2.0 * cell_ ? kNever : std::max(distance, 0.0);
    }

    // -infinity outside the section
    double foremost(double column, double row) const {
        if (column < 0 || row < 0 || column >= static_cast<double>(columns_) ||
            row >= static_cast<double>(rows_))
            return -kNever;
        return foremost_[index(static_cast<std::size_t>(column), static_cast<std::size_t>(row))];
    }
    std::size_t count(double length) const { return static_cast<std::size_t>(length / cell_) + 1; }
    std::size_t at(double offset, std::size_t most) const {
        return std::min(static_cast<std::size_t>(std::max(offset, 0.0) / cell_), most - 1);
    }
    std::size_t index(std::size_t column, std::size_t row) const { return row * columns_ + column; }

    double direction_, cell_ = 0.0;
    Vec3 low_;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<double> foremost_;
};

// Time at which the ship has travelled a distance along its course [s]. @pre its speed does not
// change sign
double time_of(const Case& p, double distance) {
    // bisection: travel grows with time as the speed keeps its sign
    if (!(std::abs(p.ship_travel(0.0, p.duration)) > distance)) return kNever;
    double before = 0.0, after = p.duration;
    for (int k = 0; k < 60; ++k) {
        // 60 halvings: to the last digit of any duration
        const double middle = 0.5 * (before + after);
        (std::abs(p.ship_travel(0.0, middle)) < distance ? before : after) = middle;
    }
    return after;
}

void measure_clearance(const World& w, const Front& front, double direction, Course& course) {
    const Bodies& b = w.scene.bodies;
    course.clearance = course.clearance_fixed = kNever;
    if (w.edge.has_sheet()) {  // the sheet's tiles come with the ship
        const SheetCourse sheet = measure_sheet_course(w, direction);
        course.clearance = sheet.clearance;
        course.beside = sheet.beside;
    }
    for (std::size_t i = 1; i < b.size(); ++i) {
        // slots hold the sheet, which was measured above
        if (w.edge.has_slot(i)) continue;
        const Shape& shape = w.scene.shapes[static_cast<std::size_t>(b.shape[i])];
        double nearest = kNever;
        for (std::size_t k = 0; k < shape.center.size(); ++k)
            nearest =
                std::min(nearest, front.distance_to(b.position[i] + b.rotation[i] * shape.center[k],
                                                    shape.radius[k]));
        course.clearance = std::min(course.clearance, nearest);
        if (is_unbroken(w.scene, w.parameters, i))
            course.clearance_fixed = std::min(course.clearance_fixed, nearest);
    }
}

// The ship's travel until its foremost point is beyond the sheet and all loose floes within its
// breadth.
double distance_through(const World& w, double direction) {
    const Eigen::AlignedBox3d hull = box_of(w.scene, kShip);
    double far = -kNever, sheet = 0.0;
    if (w.edge.has_sheet())
        if (const SheetCourse course = measure_sheet_course(w, direction);
            std::isfinite(course.through))
            sheet = course.through;
    for (std::size_t i = 1; i < w.scene.bodies.size(); ++i) {
        if (w.edge.has_slot(i) || is_unbroken(w.scene, w.parameters, i)) continue;
        const Eigen::AlignedBox3d box = box_of(w.scene, i);
        // loose floes beside the path are not met
        if (box.max().y() < hull.min().y() || box.min().y() > hull.max().y()) continue;
        far = std::max(far, direction > 0.0 ? box.max().x() : -box.min().x());
    }
    return std::max(far - (direction > 0.0 ? hull.max().x() : -hull.min().x()), sheet);
}

bool any_floe_moves(const Bodies& b) {
    return std::any_of(b.velocity.begin() + 1, b.velocity.end(),
                       [](const Vec3& v) { return !v.isZero(0.0); });
}

// Whether neither the ship nor any ice or water has a speed.
bool nothing_moves(const World& w) {
    const Case& p = w.parameters;
    return !w.ship.is_free() && p.current == std::array{0.0, 0.0} &&
           std::all_of(p.speed_table.begin(), p.speed_table.end(),
                       [](const auto& row) { return row.second == 0.0; });
}

// Faults of the time at which the ship meets the ice; at most one warning.
void warn_of_meeting(const Case& p, const Course& c, std::vector<Warning>& warnings) {
    // From the gravest to the mildest: a run without ice needs no word about its averages.
    const double averaged = p.duration - p.average_from;
    const char* const longer = p.has_level_ice() ? "a longer level_ice.extent" : "a longer field";
    if (c.clearance == kNever && c.beside) {
        warnings.push_back(
            {fmt::format("the ship passes beside the level ice, which lies from y = {:g} to {:g} "
                         "m, and meets nothing: move hull.position or level_ice.extent",
                         p.level_ice.extent[2], p.level_ice.extent[3]),
             true});
    } else if (c.clearance == kNever && p.ship_travel(0.0, p.duration) < 0.0) {
        warnings.push_back(
            {fmt::format("the ship moves astern, {:.4g} m at {:.4g} m/s, and no ice lies on its "
                         "course: its bow is at +x; give hull.speed without the minus sign, or "
                         "put hull.position after the ice",
                         c.travel, p.ship_travel(0.0, p.duration) / p.duration),
             true});
    } else if (c.clearance == kNever) {
        warnings.push_back({fmt::format("no ice lies on the ship's course: it moves {:.4g} m and "
                                        "meets nothing; put hull.position before the ice, along +x",
                                        c.travel),
                            true});
    } else if (c.meets_at == kNever) {
        warnings.push_back(
            {fmt::format("the ship never meets the ice: it moves {:.4g} m, and the first ice on "
                         "its course is {:.4g} m ahead; move hull.position on, or lengthen "
                         "simulation.duration",
                         c.travel, c.clearance),
             true});
    } else if (c.meets_at > p.average_from) {
        warnings.push_back(
            {fmt::format("forces are averaged from {:.4g} s, but the ship meets the ice at {:.4g} "
                         "s, after {:.4g} m: set output.average_from later, or move hull.position "
                         "on",
                         p.average_from, c.meets_at, c.clearance),
             true, (c.meets_at - p.average_from) / averaged});
    } else if (c.leaves_at < p.average_from) {
        warnings.push_back(
            {fmt::format("the bow leaves the ice at {:.4g} s, before forces are averaged from "
                         "{:.4g} s: set output.average_from and simulation.duration earlier, or "
                         "use {}",
                         c.leaves_at, p.average_from, longer),
             true, 1.0});
    } else if (p.duration - c.leaves_at > kOpenShare * averaged) {
        warnings.push_back(
            {fmt::format("the bow leaves the ice at {:.4g} s, and forces are averaged "
                         "up to {:.4g} s: shorten simulation.duration, or use {}",
                         c.leaves_at, p.duration, longer),
             true, (p.duration - c.leaves_at) / averaged});
    }
}

}  // namespace

Course measure_course(const World& w) {
    const Case& p = w.parameters;
    Course course;
    const double travel = p.ship_travel(0.0, p.duration), direction = travel < 0.0 ? -1.0 : 1.0;
    course.travel = std::abs(travel);
    measure_clearance(w, Front(w.scene, direction), direction, course);
    course.meets_at = time_of(p, course.clearance);
    course.hits_fixed_at = time_of(p, course.clearance_fixed);
    course.through = distance_through(w, direction);
    course.leaves_at = time_of(p, course.through);
    return course;
}

std::vector<Warning> check_course(const World& w) {
    std::vector<Warning> warnings;
    const Case& p = w.parameters;
    if (p.ship.free[surge]) return warnings;  // its speed is a result
    if (any_floe_moves(w.scene.bodies)) return warnings;
    if (nothing_moves(w)) {
        // the mean is zero, and a share of it has no meaning
        warnings.push_back(
            {"hull.speed = 0 and no ice drifts: the ship meets no ice; give hull.speed or "
             "ice.drift_velocity",
             true});
        return warnings;
    }
    const Course course = measure_course(w);
    if (!(course.travel > 0.0)) return warnings;
    warn_of_meeting(p, course, warnings);
    // level ice that stays is wide of the hull's path by its making
    if (course.hits_fixed_at < p.duration && !p.has_level_ice())
        warnings.push_back(
            {fmt::format("the ship runs into unbroken ice, which cannot move, after {:.4g} m at "
                         "{:.4g} s: shorten simulation.duration, or move the ship or the ice",
                         course.clearance_fixed, course.hits_fixed_at),
             true,
             std::min((p.duration - course.hits_fixed_at) / (p.duration - p.average_from), 1.0)});
    return warnings;
}

std::optional<Warning> warn_of_short_averages(const World& w) {
    const Case& p = w.parameters;
    if (p.ship.free[surge]) return std::nullopt;
    const ShipParticulars ship = measure_ship(w.scene, p);
    const TravelParticulars travel = measure_travel(p, ship, p.duration);
    if (!(travel.distance > 0.0) || !is_short(travel.averaged_lengths) ||
        any_floe_moves(w.scene.bodies))
        return std::nullopt;
    const double missing = (1.0 - travel.averaged_lengths) * ship.length / travel.distance;
    return Warning{fmt::format(
        "forces are averaged over {}: floes need about one to pass along "
        "the hull; simulation.duration = {:.3g} with output.average_from = "
        "{:.3g} makes it one",
        averaged_text(travel.averaged_lengths), p.duration * (1.0 + missing), p.average_from)};
}

}  // namespace ice
