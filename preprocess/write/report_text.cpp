// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/report_text.hpp"

#include <fmt/format.h>

namespace ice {

namespace {

std::string distance_text(const SurfaceDistance& d) {
    if (d.max == 0.0) return "the same surface";
    return fmt::format("{:.2g} m median, {:.2g} m p99, {:.2g} m at most, at {:.4g}, {:.4g}, {:.4g}",
                       d.p50, d.p99, d.max, d.at[0], d.at[1], d.at[2]);
}

}  // namespace

std::string report_text(const SpheresReport& r, const std::string& output) {
    const bool flat = r.dimension == 2;
    std::string out;
    const auto line = [&](const std::string& name, const std::string& value) {
        out += fmt::format("  {:<18}{}\n", name, value);
    };
    out += fmt::format("{}: {} {} of radius {:g} m\n", output, r.spheres,
                       flat ? "discs" : "spheres", r.radius);
    line("on the surface", fmt::format("{}, spaced {:g} m", r.surface_spheres, r.spacing));
    // Interior spheres cost memory in every later step: the report states it next to their number.
    if (r.spheres > r.surface_spheres)
        line("inside", fmt::format("{}, which no contact uses; --mode surface leaves them out and "
                                   "saves {:.2g} MB",
                                   r.spheres - r.surface_spheres,
                                   1e-6 * static_cast<double>(interior_bytes(r))));
    // Nine digits: readers compare volume and area with their mesh's; distances need two or three.
    line("volume", fmt::format("{:.9g} {}", r.volume, flat ? "m3 per metre of breadth" : "m3"));
    line("area", fmt::format("{:.9g} {}", r.area, flat ? "m2 per metre of breadth" : "m2"));
    line("centroid",
         fmt::format("{:.6g}, {:.6g}, {:.6g} m", r.centroid[0], r.centroid[1], r.centroid[2]));
    line("protrusion", fmt::format("{:.2g} m at most", r.protrusion_max));
    line("covering radius", fmt::format("{:.3g} m ({:.2f} of the spacing)", r.covering_radius,
                                        r.covering_radius / r.spacing));
    line("gap to surface", fmt::format("{:.2g} m median, {:.2g} m p99, {:.2g} m at most", r.gap_p50,
                                       r.gap_p99, r.gap_max));
    line("normal error", fmt::format("{:.2g} degrees mean, {:.2g} p99", r.normal_error_mean_deg,
                                     r.normal_error_p99_deg));
    if (r.source.known) line("mesh to solid", distance_text(r.source.to_solid));
    if (r.source.known) line("solid to mesh", distance_text(r.source.to_source));
    if (r.unfitted_share > 0.0)
        line("no sphere fits", fmt::format("{:.2g} % of the {}surface", 100.0 * r.unfitted_share,
                                           r.belt ? "wetted " : ""));
    // The lines below appear only if there is something to report.
    for (const CutBack& cut : r.cut_back) line("cut back", cut_back_text(cut));
    if (r.belt) line("ice belt", ice_belt_text(r));
    for (const auto& [step, count] : r.repairs)
        line("repaired", fmt::format("{}: {}", step, count));
    for (const auto& [what, value] : r.guessed) line("assumed", what + ": " + value);
    for (std::size_t k = 0; k < r.thin_features.size(); ++k) {
        const ThinFeature& f = r.thin_features[k];
        // Ten places are enough to see where the radius is too large; the JSON has all.
        if (k == 10) {
            line("too thin",
                 fmt::format("and {} more (--json lists all)", r.thin_features.size() - k));
            break;
        }
        line("too thin", fmt::format("{:.3g} m long at {:.4g}, {:.4g}, {:.4g} m", f.size, f.at[0],
                                     f.at[1], f.at[2]));
    }
    return out;
}

}  // namespace ice
