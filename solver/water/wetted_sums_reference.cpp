// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "solver/water/drag.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice::reference {

namespace {

constexpr std::size_t kLanes = PanelBlock::kLanes;

// Sums in a fixed order: Eigen's depends on its vector width.
struct Vector {
    double x, y, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
double dot(Vector a, Vector b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
Vector get(const Vec3& from) { return {from[0], from[1], from[2]}; }
Vector get(const double (&from)[3][kLanes], std::size_t lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
}

// A sum for each lane of the blocks, then over the lanes.
using Sum = std::array<double, kLanes>;
double total(const Sum& s) {
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}
struct VectorSum {
    Sum x{}, y{}, z{};

    void add(Vector v, std::size_t lane) {
        x[lane] += v.x;
        y[lane] += v.y;
        z[lane] += v.z;
    }
    Vec3 totals() const { return {total(x), total(y), total(z)}; }
};

bool wet(double z) { return z <= 0.0; }

// The heights of a triangle's corners; where the water cuts it, `apex` is the corner alone on its
// side.
struct Heights {
    double z[3];
    bool cut = false;
    std::size_t apex = 2;

    Heights(const PanelBlock& block, std::size_t lane, const WaterPlane& water) {
        for (std::size_t k = 0; k < 3; ++k)
            z[k] = dot(get(water.up), get(block.corner[k], lane)) + water.height;
        const bool differ_01 = wet(z[0]) != wet(z[1]), differ_12 = wet(z[1]) != wet(z[2]);
        cut = differ_01 || differ_12;
        if (differ_01) apex = differ_12 ? 1 : 0;
    }
    // share of the edge from the apex to the k-th corner after it that is on the apex' side
    double part(std::size_t k) const { return z[apex] / (z[apex] - z[(apex + k) % 3]); }
    bool tip_is_wet() const { return wet(z[apex]); }
};

double share_of(const PanelBlock& block, std::size_t lane, const WaterPlane& water) {
    const Heights h(block, lane, water);
    return ice::wetted_share(h.z[0], h.z[1], h.z[2]);
}

}  // namespace

WettedIntegrals integrate_wetted(const PanelBlocks& facets, const WaterPlane& water) {
    WettedIntegrals out;
    Sum volume{};
    VectorSum first;
    for (const PanelBlock& block : facets.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const Heights h(block, lane, water);
            for (const double z : h.z) (wet(z) ? out.any_wet : out.any_dry) = true;
            const double area = dot(get(water.up), get(block.area, lane));
            const Vector corner[3] = {get(block.corner[0], lane), get(block.corner[1], lane),
                                      get(block.corner[2], lane)};
            if (h.cut ? !h.tip_is_wet() : wet(h.z[0])) {
                const double sum = (h.z[0] + h.z[1]) + h.z[2];
                const Vector products =
                    (h.z[0] * corner[0] + h.z[1] * corner[1]) + h.z[2] * corner[2];
                volume[lane] += area * sum;
                first.add(area * (sum * ((corner[0] + corner[1]) + corner[2]) + products), lane);
            }
            if (h.cut) {
                const Vector p = corner[h.apex];
                const Vector q = corner[(h.apex + 1) % 3], r = corner[(h.apex + 2) % 3];
                const double s = h.part(1), t = h.part(2);
                const double tip = (s * t) * (area * h.z[h.apex]);
                const double sign = h.tip_is_wet() ? 1.0 : -1.0;
                // the corners' sum, and the apex once more: only its z is not 0
                const Vector sum = 4.0 * p + (s * (q - p) + t * (r - p));
                volume[lane] += sign * tip;
                first.add((sign * tip) * sum, lane);
            }
        }
    out.volume = total(volume) / 3.0;
    out.first = first.totals() / 12.0;
    return out;
}

FacingSums sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                      const Vec3& w) {
    Sum flow{};
    VectorSum first, square, mixed;
    for (const PanelBlock& block : panels.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double facing =
                dot(get(block.area, lane), get(v)) + dot(get(block.swing, lane), get(w));
            if (facing <= 0.0) continue;
            const double f = facing * share_of(block, lane, water);
            const Vector c = get(block.center, lane), g = f * c;
            flow[lane] += f;
            first.add(g, lane);
            square.add({g.x * c.x, g.y * c.y, g.z * c.z}, lane);
            mixed.add({g.x * c.y, g.x * c.z, g.y * c.z}, lane);
        }
    return {total(flow), first.totals(), square.totals(), mixed.totals()};
}

double sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v) {
    Sum sum{};
    for (const PanelBlock& block : panels.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double facing = dot(get(block.area, lane), get(v));
            if (facing <= 0.0) continue;
            sum[lane] += facing * share_of(block, lane, water);
        }
    return total(sum);
}

}  // namespace ice::reference
