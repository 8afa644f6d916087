// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/certify/find_cut_back.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"

namespace ice {

namespace {

// Cut [radii] that is worth a line of the report: a right-angled edge loses 0.41. A smaller value
// reports every sharp edge, a larger one leaves shorter cuts unsaid.
constexpr double kDepthWorthSaying = 0.5;
// Distance of levels [radii], at least: several in each sphere, so that no dip is missed. A larger
// value misses short cuts, a smaller one takes longer.
constexpr double kStep = 0.25;
// Levels at most [-], which bounds the time on a fine set of a large hull: every triangle meets
// many. Fewer have larger distances and miss short cuts there.
constexpr int kMostLevels = 2000;
// Extent of a section that nothing reaches.
constexpr double kNone = std::numeric_limits<double>::infinity();

// Equally spaced values of a coordinate.
struct Levels {
    double low = 0.0, step = 1.0;
    int count = 0;

    Levels(double from, double to, double radius) {
        if (!(to > from)) return;
        count = std::clamp(static_cast<int>((to - from) / (kStep * radius)) + 1, 2, kMostLevels);
        low = from;
        step = (to - from) / (count - 1);
    }
    double at(int k) const { return low + k * step; }
    int first_above(double x) const {
        return static_cast<int>(std::clamp(std::ceil((x - low) / step), 0.0, double(count)));
    }
    int last_below(double x) const {
        return static_cast<int>(std::clamp(std::floor((x - low) / step), -1.0, count - 1.0));
    }
};

// Extent along one axis of the sections at levels of another.
struct Extents {
    explicit Extents(int count)
        : low(static_cast<std::size_t>(count), kNone),
          high(static_cast<std::size_t>(count), -kNone) {}
    void extend(int k, double from, double to) {
        const auto kk = static_cast<std::size_t>(k);
        low[kk] = std::min(low[kk], from);
        high[kk] = std::max(high[kk], to);
    }
    std::vector<double> low, high;
};

Extents sections_of(const TriangleMesh& mesh, int across, int along, const Levels& levels) {
    Extents out(levels.count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            Vec3 a = mesh.corner(t, c), b = mesh.corner(t, (c + 1) % 3);
            if (a[across] > b[across]) std::swap(a, b);
            for (int k = levels.first_above(a[across]); k <= levels.last_below(b[across]); ++k) {
                // an edge in the level itself counts with its first end
                const double rise = b[across] - a[across];
                const double part = rise > 0.0 ? (levels.at(k) - a[across]) / rise : 0.0;
                const double x = a[along] + part * (b[along] - a[along]);
                out.extend(k, x, x);
            }
        }
    return out;
}

Extents sections_of(const SphereSet& set, int across, int along, const Levels& levels) {
    Extents out(levels.count);
    for (std::size_t s = 0; s < set.surface_count; ++s) {
        const Vec3& c = set.centers[s];
        const double r = set.radii[s];
        for (int k = levels.first_above(c[across] - r); k <= levels.last_below(c[across] + r);
             ++k) {
            // the circle in which the level cuts the sphere
            const double aside = levels.at(k) - c[across];
            const double reach = std::sqrt(std::max(r * r - aside * aside, 0.0));
            out.extend(k, c[along] - reach, c[along] + reach);
        }
    }
    return out;
}

// The least cut within half a spacing: the dip between two neighbouring spheres is no cut.
std::vector<double> without_dips(const std::vector<double>& cuts, const Levels& levels,
                                 double spacing) {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(0.5 * spacing / levels.step));
    std::vector<double> out(cuts.size());
    for (auto at = cuts.begin(); at != cuts.end(); ++at)
        out[at - cuts.begin()] = *std::min_element(at - std::min(reach, at - cuts.begin()),
                                                   at + std::min(reach + 1, cuts.end() - at));
    return out;
}

// The deepest cut and the range round it in which cuts are worth saying.
void add_deepest(const char* part, const std::vector<double>& all, const Levels& levels,
                 double spacing, double least, std::vector<CutBack>& out) {
    const std::vector<double> cuts = without_dips(all, levels, spacing);
    const auto deepest = std::max_element(cuts.begin(), cuts.end());
    if (deepest == cuts.end() || *deepest <= least) return;
    auto from = deepest, to = deepest;
    while (from != cuts.begin() && *(from - 1) > least) --from;
    while (to + 1 != cuts.end() && *(to + 1) > least) ++to;
    out.push_back({part, *deepest, levels.at(static_cast<int>(from - cuts.begin())),
                   levels.at(static_cast<int>(to - cuts.begin()))});
}

}  // namespace

void find_cut_back(const SphereSet& set, SpheresReport& report) {
    ICE_ASSERT(set.surface_count <= set.centers.size() && set.radii.size() == set.centers.size() &&
               !set.mesh.triangles.empty());
    report.cut_back.clear();
    if (set.dimension != 3) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : set.mesh.vertices) box.extend(v);
    const double r = set.radius, least = kDepthWorthSaying * r;
    const IceBelt& belt = report.belt;
    // without a belt a radius from the ends: no sphere's centre is nearer to them
    const Levels heights(belt ? std::max(belt.low, box.min().z()) : box.min().z() + r,
                         belt ? std::min(belt.high, box.max().z()) : box.max().z() - r, r);
    const Levels stations(box.min().x() + r, box.max().x() - r, r);
    std::vector<double> fore, aft, down;
    const Extents hull = sections_of(set.mesh, 2, 0, heights);
    const Extents spheres = sections_of(set, 2, 0, heights);
    for (std::size_t k = 0; k < hull.low.size(); ++k) {
        const double length = std::max(hull.high[k] - hull.low[k], 0.0);
        // no more than the section is long: a level without spheres has none to measure from
        fore.push_back(std::min(hull.high[k] - spheres.high[k], length));
        aft.push_back(std::min(spheres.low[k] - hull.low[k], length));
    }
    const Extents sections = sections_of(set.mesh, 0, 2, stations);
    const Extents reached = sections_of(set, 0, 2, stations);
    for (std::size_t k = 0; k < sections.low.size(); ++k)
        down.push_back(std::min(reached.low[k] - sections.low[k],
                                std::max(sections.high[k] - sections.low[k], 0.0)));
    add_deepest("stem", fore, heights, set.spacing, least, report.cut_back);
    add_deepest("stern", aft, heights, set.spacing, least, report.cut_back);
    add_deepest("keel", down, stations, set.spacing, least, report.cut_back);
}

}  // namespace ice
