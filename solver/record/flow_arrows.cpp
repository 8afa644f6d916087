// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/flow_arrows.hpp"

#include <cmath>
#include <set>

#include "common/geometry/winding_number.hpp"
#include "solver/flow/wetted_panels.hpp"

namespace ice {

namespace {

// Places on the water, and cells along the hull, before some are left out [-]: as many as a picture
// can show. More hide each other, fewer leave parts of the flow out.
constexpr double kSurfacePlaces = 1200.0, kAlong = 25.0;
// Least speed of an arrow, in ship speeds [-]: shorter ones are not seen. A larger value leaves out
// slow flow, a smaller one draws dots.
constexpr double kLeast = 0.01;
// Pieces of the wetted surface, from which cells are drawn, at most [-]: a hull that takes more has
// no arrows along it. More take longer. All of these matter to pictures alone.
constexpr std::size_t kMostPieces = 20000;
// How far an arrow along the hull is off its panel, and below the surface at least [cells]: there
// the table's flow is that around the hull. A larger value draws the flow farther away, a smaller
// one that between nodes in the hull.
constexpr double kOffPanelCells = 0.1;

class Sampler {
public:
    explicit Sampler(const Scene& scene)
        : scene_(scene),
          grid_(scene.water.grid),
          height_(scene.bodies.position[kShip].z()),
          hull_(scene.shapes[0].mesh) {}

    FlowArrows sample() {
        const double d = 1.0 / grid_.per_spacing;
        low_ = grid_.origin;
        high_ = low_ + d * Vec3(grid_.last_x, grid_.last_y, grid_.last_z);
        if (grid_.symmetric) low_.y() = -high_.y();
        if (scene_.dimension == 2)
            sample_plane(2);
        else
            sample_plane(1);
        if (scene_.dimension == 3) sample_hull();
        return std::move(out_);
    }

private:
    void add(const Vec3& at) {
        const Vec3 w = reference::look_up_flow(grid_, at).velocity;
        if (w.norm() < kLeast) return;
        out_.point.push_back(at);
        out_.velocity.push_back(w);
    }

    // Even places in the plane of x and `axis`.
    void sample_plane(Eigen::Index axis) {
        // squares of equal area, so that the number of arrows does not depend on the hull's
        // size
        const double step =
            std::sqrt((high_.x() - low_.x()) * (high_[axis] - low_[axis]) / kSurfacePlaces);
        for (double x = low_.x() + 0.5 * step; x < high_.x(); x += step)
            for (double other = high_[axis] - 0.5 * step; other > low_[axis]; other -= step) {
                Vec3 at(x, 0.0, 0.0);
                at[axis] = other;
                // in the surface itself the hull may end
                if (!hull_.contains(Vec3(x, at.y(), std::min(at.z(), -1e-3 * step) - height_)))
                    add(at);
            }
    }

    // One place of each cell that the wetted surface crosses.
    void sample_hull() {
        const Eigen::AlignedBox3d& box = scene_.shapes[0].box;
        const double cell = (box.max().x() - box.min().x()) / kAlong;
        const auto panels = split_triangles(scene_.shapes[0].mesh, cell, kMostPieces);
        std::set<std::array<long, 3>> taken;
        for (const SourcePanel& panel : panels) {
            const Vec3 at =
                panel.centre + Vec3(0, 0, height_) + kOffPanelCells * cell * panel.normal;
            if (at.z() > -kOffPanelCells * cell) continue;
            const Vec3 c = (at / cell).array().floor();
            if (taken.insert({std::lround(c.x()), std::lround(c.y()), std::lround(c.z())}).second)
                add(at);
        }
    }

    const Scene& scene_;
    const FlowGrid& grid_;
    double height_;  // of the hull mesh's origin
    WindingNumber hull_;
    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
    FlowArrows out_;
};

}  // namespace

FlowArrows flow_arrows(const Scene& scene) {
    return scene.water.grid.empty() ? FlowArrows{} : Sampler(scene).sample();
}

}  // namespace ice
