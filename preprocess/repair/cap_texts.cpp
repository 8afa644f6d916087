// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/cap_texts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "preprocess/clean/stitch_open_edges.hpp"

namespace ice {

namespace {

// Area of one cap over the surface [-] that is worth a warning. These bounds choose texts alone; no
// mesh is changed or refused by them. Larger ones leave more unsaid, smaller ones say what changes
// nothing.
constexpr double kWorthWarning = 0.002;
// Volume in doubt over the whole [-], by all caps together, that is worth a warning.
constexpr double kDoubtWorthWarning = 0.005;
// Openings named one by one [-]; the others are counted. A larger value makes longer reports.
constexpr std::size_t kMostNamed = 5;
// Share of the open edges' vertices that lie beside another open edge [-], from which on the
// openings are reported as cracks. No vertex around a real opening does.
constexpr double kCracked = 0.25;

}  // namespace

std::string place(const Vec3& at) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", at.x(), at.y(), at.z());
}

std::vector<std::string> cap_warnings(const ClosedSurface& closed) {
    std::vector<std::string> out;
    std::vector<CapVerdict> large;
    for (const CapVerdict& cap : closed.caps) {
        // An open deck is reported whatever its size: it is the one cap that a user may not have
        // expected.
        if (cap.kind == CapKind::deck)
            out.push_back(fmt::format("the open deck at {} was closed by a cap of {:.3g} m2",
                                      place(cap.at), cap.area));
        else if (cap.kind != CapKind::hidden && cap.area > kWorthWarning * closed.surface)
            large.push_back(cap);
    }
    // the largest openings by name, as they change the volume most; the others by number
    std::stable_sort(large.begin(), large.end(),
                     [](const CapVerdict& l, const CapVerdict& r) { return l.area > r.area; });
    for (std::size_t k = 0; k < std::min(large.size(), kMostNamed); ++k)
        out.push_back(fmt::format(
            "an opening of {:.3g} m2 at {} was closed {}", large[k].area, place(large[k].at),
            large[k].kind == CapKind::continued ? "flat, in the plane of the faces beside it"
                                                : "by the smallest surface"));
    if (large.size() > kMostNamed)
        out.push_back(
            fmt::format("{} smaller openings were closed, too", large.size() - kMostNamed));
    if (closed.doubt > kDoubtWorthWarning)
        out.push_back(fmt::format(
            "{} openings were closed by guess, which leaves {:.2g} % of the volume in doubt",
            closed.caps.size(), 100.0 * closed.doubt));
    return out;
}

std::string fault_of(const CapVerdict& cap, const ClosedSurface& closed) {
    // Two faults look alike: many openings whose doubts add up, so that this one has less than
    // half, and one opening that is too large by itself. They have different remedies.
    if (closed.doubt > kMostDoubt && cap.doubt < 0.5 * closed.doubt * closed.volume)
        return fmt::format(
            "closing its {} openings leaves {:.2g} % of the volume in doubt ({:g} % may be), most "
            "of all that of {:.3g} m2 at {}",
            closed.caps.size(), 100.0 * std::min(closed.doubt, 1.0), 100.0 * kMostDoubt, cap.area,
            place(cap.at));
    return fmt::format(
        "an opening of {:.3g} m2 ({:.3g} % of the surface) at {} is too large to guess", cap.area,
        100.0 * cap.area / closed.surface, place(cap.at));
}

std::string fault_of_cracks(const TriangleMesh& open) {
    const WideCracks cracks = find_wide_cracks(open);
    const auto all = static_cast<double>(cracks.vertices);
    // Vertices around an opening have no other open edge beside them; those along a crack have the
    // other side of it.
    if (static_cast<double>(cracks.beside_another) <= kCracked * all) return "";
    return fmt::format(
        "of the {} vertices on those left, {} lie beside another open edge, up to {:.2g} m away: "
        "cracks between patches that were tessellated one by one, too wide to be stitched (a "
        "thousandth of the diagonal, a third of the edges beside them)",
        cracks.vertices, cracks.beside_another, cracks.widest);
}

}  // namespace ice
