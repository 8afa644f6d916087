// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/certify/judge_spheres.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "common/formats/widest_spacing.hpp"

namespace ice {

namespace {

// Thickness of the ice over the draught [-] where none is given: 0.8 m for 8 m. A larger value
// makes the guessed ice belt higher.
constexpr double kIceOfDraught = 0.1;
// Half height of the ice belt [ice thicknesses]. A higher belt judges more of the hull strictly.
constexpr double kBelt = 2.0;
// Protrusion [radii] worth a warning: rounding has 1e-9, a sphere on the wrong side 2. A larger
// value leaves spheres unsaid that reach out, a smaller one warns of rounding.
constexpr double kMostProtrusion = 0.01;
// Covering radius [spacings] worth a warning: a layer's own is 0.61 to 0.66. A smaller value warns
// of ordinary layers, a larger one leaves uncovered places unsaid.
constexpr double kMostCover = 0.75;
// A lattice that leaves more than this share of the surface [-] without a sphere is worth a
// warning: edges leave less, a face between two layers of the lattice more. A smaller value warns
// of edges, a larger one leaves small faces unsaid.
constexpr double kMostUnfitted = 0.01;

}  // namespace

void set_ice_belt(const TriangleMesh& solid, std::optional<double> draught,
                  std::optional<double> ice_thickness, SpheresReport& report) {
    if (!draught) {
        if (ice_thickness)
            throw bad_input("--ice-thickness", "has no meaning without the waterline",
                            "give --draught, from the lowest point to the water");
        return;
    }
    Eigen::AlignedBox3d box;
    for (const Vec3& v : solid.vertices) box.extend(v);
    if (*draught >= box.sizes().z())
        throw bad_input("--draught",
                        fmt::format("{:g} m is not less than the solid's depth, {:.4g} m", *draught,
                                    box.sizes().z()),
                        "give the height of the water over the lowest point; see --units and --up");
    IceBelt& belt = report.belt;
    belt.draught = *draught;
    belt.thickness = ice_thickness.value_or(kIceOfDraught * *draught);
    // The draught counts from the lowest point, whatever the mesh's origin is.
    const double water = box.min().z() + *draught;
    belt.low = water - kBelt * belt.thickness;
    belt.high = water + kBelt * belt.thickness;
    if (!ice_thickness)
        report.guessed["ice thickness"] =
            fmt::format("{:.3g} m, a tenth of the draught, in the ice belt", belt.thickness);
}

void judge_spheres(const SphereSet& set, Arrangement arrangement, SpheresReport& report) {
    // Each bound has its effect on a run: spheres outside the solid push ice before the hull is
    // there, wide gaps let ice through, parts that are cut back meet it too late.
    std::vector<std::string>& out = report.warnings;
    const double r = set.radius;
    if (report.outside_dropped > 0)
        out.push_back(fmt::format(
            "{} spheres stood outside the solid, where its faces cross, and were dropped",
            report.outside_dropped));
    if (report.protrusion_max > kMostProtrusion * r)
        out.push_back(fmt::format("a sphere reaches {:.2g} m out of the solid, {:.2g} radii",
                                  report.protrusion_max, report.protrusion_max / r));
    if (report.covering_radius > kMostCover * set.spacing)
        out.push_back(fmt::format(
            "a place of the surface that a sphere could touch is {:.3g} m, {:.2f} spacings, from "
            "the nearest, at ({:.4g}, {:.4g}, {:.4g})",
            report.covering_radius, report.covering_radius / set.spacing, report.covering_at[0],
            report.covering_at[1], report.covering_at[2]));
    if (arrangement == Arrangement::lattice && report.unfitted_share > kMostUnfitted)
        out.push_back(fmt::format(
            "the lattice has no sphere at {:.2g} % of the surface, so that bodies enter each other "
            "by up to {:.2g} m there: use --arrangement conforming, or, for a plate, a --radius "
            "whose double divides the thickness",
            100.0 * report.unfitted_share, report.gap_max));
    for (const CutBack& cut : report.cut_back)
        // More than a radius, and in the belt alone: elsewhere the hull meets no ice, and below a
        // radius the spheres' own size is coarser.
        if (report.belt && cut.part != "keel" && cut.by > r)
            out.push_back("in the ice belt " + cut_back_text(cut) +
                          ": use a smaller --radius for loads there");
    if (!report.thin_features.empty())
        out.push_back(fmt::format("parts too thin for a sphere of radius {:g} m: {}", r,
                                  report.thin_features.size()));
    // A spacing is often exactly the bound, written in decimal digits: rounding is no fault.
    const double widest = kWidestSpacing * r;
    if (set.spacing > widest * (1.0 + kSpacingRounding))
        out.push_back(fmt::format(
            "the surface spheres are {:g} m apart: bodies may pass between them above {:g} radii; "
            "use --spacing {:g} or less",
            set.spacing, kWidestSpacing, widest));
}

}  // namespace ice
