// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/certify/certify_solid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/timer.hpp"
#include "preprocess/certify/compare_with_source.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/symmetry.hpp"

namespace ice {

namespace {

// Least extent over the length [-] up to which a mesh is flat: rounding of its coordinates. A
// larger value refuses thin plates as flat; with a smaller one the message for a flat mesh is about
// the radius.
constexpr double kFlatMesh = 1e-9;
// Size of a repaired solid over the mesh's [-], at most: a shrink wrap lies outside. With 1 the
// early refusal would refuse a radius that the wrap has room for; a larger value refuses fewer
// radii early, and their repair would take time without use.
constexpr double kRepaired = 1.01;
// A warning names the parts of the mesh that were left out of the solid where they have more than
// this share of the mesh's area [-]. A larger value leaves lost parts unsaid, a smaller one warns
// of scraps; the solid is the same.
constexpr double kWorthSaying = 1e-3;

std::string place(const std::array<double, 3>& at) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", at[0], at[1], at[2]);
}

void warn_of(const char* what, const SurfaceDistance& d, double radius, SpheresReport& report) {
    // A distance below a radius changes no contact by more than the spheres do themselves.
    if (d.max <= radius) return;
    report.warnings.push_back(
        fmt::format("{} up to {:.3g} m, {:.2g} radii, at {} ({:.2g} m at the 99th percentile)",
                    what, d.max, d.max / radius, place(d.at), d.p99));
}

void judge_distances(const std::string& name, double radius, bool refuse, SpheresReport& report) {
    const SourceCheck& s = report.source;
    const IceBelt& belt = report.belt;
    // Loads come from the ice belt: there a repair that moves the surface by more than a sphere's
    // radius is refused, elsewhere it is a warning.
    for (const SurfaceDistance* d : {&belt.to_solid, &belt.to_source})
        if (belt && refuse && d->p99 > radius)
            throw bad_input(
                name,
                fmt::format("was repaired to a solid that lies {:.3g} m from it in the ice belt "
                            "(99th percentile; {:.3g} m at {}), more than the radius of {:g} m",
                            d->p99, d->max, place(d->at), radius),
                "mend it there in the program that made it; --repair wrap takes the solid as it "
                "is");
    warn_of("the mesh lies outside the solid that was filled by", s.to_solid, radius, report);
    warn_of("the solid that was filled lies off the mesh by", s.to_source, radius, report);
    if (belt && belt.to_solid.max > radius && s.to_solid.max > belt.to_solid.max)
        warn_of("in the ice belt the mesh lies outside the solid by", belt.to_solid, radius,
                report);
    if (s.left_out_area > kWorthSaying * s.area)
        report.warnings.push_back(
            fmt::format("{:.3g} m2 of the mesh, at {}, are no surface of the solid and were left "
                        "out",
                        s.left_out_area, place(s.left_out_at)));
}

}  // namespace

void refuse_thin_mesh(const std::string& name, const TriangleMesh& surface, double radius,
                      int dimension) {
    // Only a bound, but a cheap one: it catches wrong units before the repair.
    const Vec3 size = bounding_box(surface).sizes();
    // a sphere that fits has at most half of the least extent; in 2D a disc, in x-z
    const double most = 0.5 * (dimension == 3 ? size.minCoeff() : std::min(size.x(), size.z()));
    if (most <= kFlatMesh * size.maxCoeff())
        throw bad_input(
            name,
            fmt::format("is not the closed surface of a solid: it is flat, {:.4g} x {:.4g} x "
                        "{:.4g} m",
                        size.x(), size.y(), size.z()),
            "export the surface of a body");
    if (radius <= most * kRepaired) return;
    throw bad_input(
        "--radius",
        fmt::format("no {} of radius {:g} m fits into the solid: the mesh is {:.4g} x "
                    "{:.4g} x {:.4g} m",
                    dimension == 3 ? "sphere" : "disc", radius, size.x(), size.y(), size.z()),
        fmt::format("give --radius below {:.3g} m, or the unit of the file with --units", most));
}

bool was_mirrored(const SpheresReport& report) {
    return std::any_of(report.repairs.begin(), report.repairs.end(), [](const auto& repair) {
        return repair.first == "half hull mirrored across y = 0";
    });
}

void certify_solid(const std::string& name, TriangleMesh surface, const TriangleMesh& solid,
                   double radius, bool wrapped, SpheresReport& report) {
    const Timer timer;
    // the mesh as read is the half: its image makes it comparable with the whole solid
    if (was_mirrored(report)) add_mirror_image(surface);
    compare_with_source(surface, solid, radius, report);
    judge_distances(name, radius, !wrapped, report);
    report.seconds["compare"] = timer.seconds();
}

}  // namespace ice
