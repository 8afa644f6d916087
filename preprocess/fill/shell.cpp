// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/shell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "preprocess/fill/edge_chains.hpp"
#include "preprocess/fill/offset_surface.hpp"
#include "preprocess/fill/point_grid.hpp"

namespace ice {

namespace {

// In units of the spacing.
constexpr double kEdgeSeparation = 0.5;   // between spheres of different edges
constexpr double kFaceSeparation = 0.75;  // a hexagon's seams: nearer than this is not placed
constexpr double kMirrorGap = 0.36;       // half of kFaceSeparation: a sphere and its image
constexpr double kPatchSeparation = 0.4;  // for spheres that close the gaps a front leaves
constexpr double kPatchMirrorGap = 0.15;
constexpr double kCovered = 0.6;  // every reachable sample has a sphere this near; with
                                  // samples 1/4 apart the surface between them has 0.65

class ShellMaker {
public:
    ShellMaker(const SurfaceTree& tree, const ShellOptions& options)
        : tree_(tree), o_(options), placed_(options.spacing) {}

    std::vector<Vec3> make(const std::vector<SurfaceSample>& samples) {
        const double step = 0.05 * o_.spacing;
        const auto lines = o_.dimension == 2 ? trace_section(tree_, o_.radius, step)
                                             : trace_sharp_edges(tree_, o_.radius, step);
        for (const auto& line : lines) place_line(line);
        if (o_.dimension == 3) advance_front();
        cover(samples);
        return placed_.points();
    }

private:
    // Places a settled centre, with its mirror image, unless a neighbour is too near.
    bool place(Vec3 c, double separation, double mirror_gap = kMirrorGap) {
        if (o_.mirror && std::abs(c.y()) < 1e-6 * o_.radius) c.y() = 0.0;
        if (o_.mirror && c.y() < 0.0) c.y() = -c.y();
        if (o_.mirror && c.y() > 0.0 && c.y() < mirror_gap * o_.spacing) {
            const auto middle = on_centre_plane(c);
            if (!middle) return false;
            c = *middle;
        }
        if (placed_.nearest(c, separation * o_.spacing).index >= 0) return false;
        placed_.add(c);
        if (o_.mirror && c.y() > 0.0) placed_.add(Vec3(c.x(), -c.y(), c.z()));
        return true;
    }

    // A centre just off the plane of symmetry moves into it and settles there: Newton on the
    // distance along its gradient within the plane.
    std::optional<Vec3> on_centre_plane(Vec3 c) const {
        c.y() = 0.0;
        for (int step = 0; step < 40; ++step) {
            const Foot foot = tree_.closest(c);
            const double lack = o_.radius - foot.distance;
            if (!foot.inside) return std::nullopt;
            if (std::abs(lack) <= 1e-10 * o_.radius) return c;
            Vec3 away = (c - foot.point) / foot.distance;
            away.y() = 0.0;
            if (away.norm() < 0.1) return std::nullopt;  // the surface lies along the plane
            c += lack / away.squaredNorm() * away;
        }
        return std::nullopt;
    }

    void place_line(const std::vector<Vec3>& starts) {
        std::vector<Vec3> path;
        const auto flush = [&] {
            // the samples near a corner all settle in it: equal neighbours are one
            std::vector<Vec3> line;
            for (const Vec3& c : path)
                if (line.empty() || (c - line.back()).norm() > 1e-7 * o_.radius) line.push_back(c);
            path.clear();
            if (line.size() == 1) place(line[0], kEdgeSeparation);
            if (line.size() < 2) return;
            for (const Vec3& start : resample(line, o_.spacing))
                if (const auto c = settle(tree_, start, o_.radius)) place(*c, kEdgeSeparation);
        };
        for (const Vec3& start : starts) {
            const auto c = settle(tree_, start, o_.radius);
            // a jump means the edge is too sharp for a sphere on the way
            if (c && !path.empty() && (*c - path.back()).norm() > o_.spacing) flush();
            if (c)
                path.push_back(*c);
            else
                flush();
        }
        flush();
    }

    void advance_front() {
        for (; front_ < placed_.points().size(); ++front_) {
            const Vec3 c = placed_.points()[front_];
            if (o_.mirror && c.y() < 0.0) continue;  // its image did it
            const Vec3 n = (tree_.closest(c).point - c).normalized();
            Vec3 along = heading(c, front_);
            along -= along.dot(n) * n;
            if (along.norm() < 1e-3 * o_.spacing) along = n.unitOrthogonal();
            along.normalize();
            const Vec3 across = n.cross(along);
            for (int k = 0; k < 6; ++k) {
                static const double kCos[6] = {1, 0.5, -0.5, -1, -0.5, 0.5};
                const double sine = k % 3 == 0 ? 0.0 : (k < 3 ? 1.0 : -1.0) * std::sqrt(0.75);
                const Vec3 start = c + o_.spacing * (kCos[k] * along + sine * across);
                if (placed_.nearest(start, 0.6 * o_.spacing).index >= 0) continue;
                if (const auto next = settle(tree_, start, o_.radius))
                    place(*next, kFaceSeparation);
            }
        }
    }

    // Towards the nearest sphere already there, so that hexagons line up.
    Vec3 heading(const Vec3& c, std::size_t self) const {
        double best = 1.3 * o_.spacing;
        Vec3 out = Vec3::Zero();
        // the nearest but itself: look a little off the centre in both directions
        for (int d = 0; d < 3; ++d)
            for (const double sign : {-1.0, 1.0}) {
                const auto near =
                    placed_.nearest(c + 0.5 * sign * o_.spacing * Vec3::Unit(d), best);
                if (near.index < 0 || static_cast<std::size_t>(near.index) == self) continue;
                const Vec3 to = placed_.points()[static_cast<std::size_t>(near.index)] - c;
                if (to.norm() >= best || to.norm() == 0.0) continue;
                best = to.norm();
                out = to;
            }
        return out;
    }

    void cover(const std::vector<SurfaceSample>& samples) {
        for (const SurfaceSample& sample : samples) {
            if (o_.mirror && sample.point.y() < 0.0) continue;
            const Vec3 start = sample.point - o_.radius * sample.normal;
            if (placed_.nearest(start, kCovered * o_.spacing).index >= 0) continue;
            const auto c = settle(tree_, start, o_.radius);
            if (!c || placed_.nearest(*c, kCovered * o_.spacing).index >= 0) continue;
            // a part that no edge leads to starts a front of its own
            if (place(*c, kPatchSeparation, kPatchMirrorGap) && o_.dimension == 3) advance_front();
        }
    }

    const SurfaceTree& tree_;
    ShellOptions o_;
    PointGrid placed_;
    std::size_t front_ = 0;
};

}  // namespace

std::vector<Vec3> make_shell(const SurfaceTree& tree, const std::vector<SurfaceSample>& samples,
                             const ShellOptions& options) {
    return ShellMaker(tree, options).make(samples);
}

bool is_mirror_symmetric(const SurfaceTree& tree) {
    const TriangleMesh& mesh = tree.mesh();
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const double tolerance = 1e-7 * box.diagonal().norm();
    const auto image = [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); };
    for (const Vec3& v : mesh.vertices)
        if (tree.closest(image(v)).distance > tolerance) return false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        if (tree.closest(image(middle)).distance > tolerance) return false;
    }
    return true;
}

}  // namespace ice
