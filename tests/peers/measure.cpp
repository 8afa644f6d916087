// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/peers/measure.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "common/base/timer.hpp"
#include "solver/record/recorder.hpp"

namespace ice::peers {

namespace {

// Watches the poses of a run as polygons.
class Watch {
public:
    explicit Watch(const Scene& scene) {
        for (const Shape& shape : scene.shapes) outlines_.push_back(outline_of(shape.mesh));
    }

    void look(const Scene& scene, Outcome& out) {
        const Bodies& b = scene.bodies;
        std::vector<Polygon> placed;
        for (std::size_t i = 0; i < b.size(); ++i)
            placed.push_back(place(outlines_[static_cast<std::size_t>(b.shape[i])], b.rotation[i],
                                   b.position[i]));
        for (std::size_t i = 1; i < b.size(); ++i) {
            out.deepest_hull = std::max(out.deepest_hull, overlap_depth(placed[kShip], placed[i]));
            out.fastest = std::max(out.fastest, b.velocity[i].norm());
            if (contains(placed[kShip], Vec2(b.position[i].x(), b.position[i].z())))
                inside_.insert(i);
            for (std::size_t j = i + 1; j < b.size(); ++j)
                if (near(scene, i, j))
                    out.deepest_ice =
                        std::max(out.deepest_ice, overlap_depth(placed[i], placed[j]));
        }
        out.inside = static_cast<int>(inside_.size());
    }

private:
    static bool near(const Scene& scene, std::size_t i, std::size_t j) {
        const Bodies& b = scene.bodies;
        const auto radius = [&](std::size_t k) {
            return scene.shapes[static_cast<std::size_t>(b.shape[k])].bounding_radius;
        };
        return (b.position[i] - b.position[j]).norm() < radius(i) + radius(j);
    }

    std::vector<Polygon> outlines_;
    std::set<std::size_t> inside_;
};

}  // namespace

Outcome measure(Engine& engine) {
    Outcome out;
    const Case& p = engine.world().parameters;
    const auto steps = std::llround(p.duration / p.time_step);
    Watch watch(engine.world().scene);
    std::vector<double> force_x, force_z;
    double seconds = 0.0;
    for (std::int64_t k = 0; k < steps; ++k) {
        const Timer timer;
        const Vec3 force = engine.step() / p.time_step;
        seconds += timer.seconds();
        watch.look(engine.world().scene, out);
        out.peak = std::max(out.peak, force.norm());
        // half a step of room: the sum of steps need not hit average_from exactly
        if (engine.world().time < p.average_from - 0.5 * p.time_step) continue;
        force_x.push_back(force.x());
        force_z.push_back(force.z());
    }
    out.force_x = mean_interval(force_x);
    out.force_z = mean_interval(force_z);
    const Scene& scene = engine.world().scene;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        if (!scene.bodies.held[i]) ++out.moved;
        if (is_behind(scene, i)) ++out.behind;
    }
    out.imbalance = engine.imbalance();
    out.step_seconds = seconds / static_cast<double>(steps);
    return out;
}

}  // namespace ice::peers
