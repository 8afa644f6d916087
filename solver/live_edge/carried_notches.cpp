// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/carried_notches.hpp"

#include <algorithm>

namespace ice {

namespace {

// Cosine of the angle between the normals of two spheres of one face [-], 8 degrees: an edge and a
// face beside it differ by 20 and more. With a smaller one, whole spheres of the upper face keep
// ice in a notch below them; with a larger one, a face that is cut a little askew is crushed a
// patch radius beyond the notch.
constexpr double kNotchFace = 0.99;

// Rounding of places in the ice [m]. With 0, which of two lines through one place counts, and
// whether a face at the bottom of a notch is whole, depend on the last bit.
constexpr double kNotchRounding = 1e-9;

}  // namespace

void CarriedNotches::take(const Scene& scene, std::int32_t tile) {
    const Bodies& b = scene.bodies;
    const auto i = static_cast<std::size_t>(tile);
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    for (std::size_t k = 0; k < shape.center.size(); ++k)
        lines_.push_back(
            {b.position[i] + b.rotation[i] * shape.center[k],
             b.rotation[i] * scene.crushed.displacement_of(tile, static_cast<std::int32_t>(k)),
             b.rotation[i] * shape.normal[k]});
    reach_ = std::max(reach_, shape.patch_radius);
    has_notch_ = has_notch_ || !scene.crushed.is_whole(tile);
}

Vec3 CarriedNotches::move_of(std::span<const Line> lines, const Vec3& at,
                             const Vec3& normal) const {
    double nearest = reach_, gone = 1.0;
    Vec3 move = Vec3::Zero();
    for (const Line& line : lines) {
        // The place on the line nearest to the new sphere; the rest of the line is its notch. A
        // sphere that stays where one was has that one's depth, though other lines pass there.
        const double length2 = line.move.squaredNorm();
        if (length2 == 0.0 && line.normal.dot(normal) < kNotchFace) continue;
        const double along =
            length2 > 0.0 ? std::clamp((at - line.from).dot(line.move) / length2, 0.0, 1.0) : 0.0;
        const double distance = (line.from + along * line.move - at).norm();
        if (distance > nearest - kNotchRounding &&
            (distance > std::min(nearest + kNotchRounding, reach_) || along >= gone))
            continue;
        nearest = distance;
        gone = along;
        move = (1.0 - along) * line.move;
    }
    return move;
}

std::vector<CarriedNotches::Line> CarriedNotches::lines_near(const Eigen::AlignedBox3d& box) const {
    std::vector<Line> near;
    for (const Line& line : lines_) {
        Eigen::AlignedBox3d path(line.from);
        path.extend(Vec3(line.from + line.move));
        if (path.intersects(box)) near.push_back(line);
    }
    return near;
}

void CarriedNotches::give(Scene& scene, std::int32_t body) const {
    if (!has_notch_) return;
    const Bodies& b = scene.bodies;
    const auto i = static_cast<std::size_t>(body);
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    const auto place = [&](std::size_t k) {
        return Vec3(b.position[i] + b.rotation[i] * shape.center[k]);
    };
    Eigen::AlignedBox3d box;
    for (std::size_t k = 0; k < shape.center.size(); ++k) box.extend(place(k));
    const Vec3 reach = Vec3::Constant(reach_);
    const std::vector<Line> lines = lines_near({Vec3(box.min() - reach), Vec3(box.max() + reach)});
    for (std::size_t k = 0; k < shape.center.size(); ++k) {
        const Vec3 move = move_of(lines, place(k), b.rotation[i] * shape.normal[k]);
        if (move.norm() > kNotchRounding)
            scene.crushed.carry_notch(body, static_cast<std::int32_t>(k), shape.center.size(),
                                      b.rotation[i].transpose() * move);
    }
}

}  // namespace ice
