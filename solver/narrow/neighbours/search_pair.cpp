// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/neighbours/search_pair.hpp"

#include <cmath>

namespace ice {

namespace {

// Up to this number of spheres [-] a comparison with all costs less than picking the nearer ones.
// The pairs do not depend on it, only the time.
constexpr std::size_t kAllAtOnce = 64;

// The box around a box that was moved by p' = rotation p + translation.
FloatBox move_box(const FloatBox& box, const Mat3& rotation, const Vec3& translation) {
    Vec3 middle, half;
    for (int d = 0; d < 3; ++d) {
        // The half sizes of a turned box: absolute values of the rotation times the old ones.
        middle[d] = 0.5 * (box.high[d] + box.low[d]);
        half[d] = 0.5 * (box.high[d] - box.low[d]);
    }
    middle = Vec3(rotation * middle + translation);
    half = Vec3(rotation.cwiseAbs() * half);
    FloatBox out;
    for (int d = 0; d < 3; ++d) {
        out.low[d] = static_cast<float>(middle[d] - half[d]);
        out.high[d] = static_cast<float>(middle[d] + half[d]);
    }
    return out;
}

// Largest distance of a sphere's partner among `others`, less the sphere's own
// hypot(normal_extent, tangent_extent) [m].
float growth_of(const SphereBlocks& others, const SearchRange& range) {
    return std::hypot(others.largest_normal_extent + range.normal_extent,
                      others.largest_tangent_extent + range.tangent_extent);
}

// Shifts a body's spheres, picked at their places before any crushing, to their present places.
void move_crushed(const CrushedIce& crushed, std::int32_t body, const Shape& shape,
                  const Mat3& rotation, const Vec3& translation, NearSpheres& picked) {
    if (crushed.is_whole(body)) return;
    for (std::size_t k = 0; k < picked.count; ++k) {
        const Vec3 move = crushed.displacement_of(body, picked.id[k]);
        if (move.isZero(0.0)) continue;
        const Vec3 at = rotation * (shape.center[picked.id[k]] + move) + translation;
        picked.x[k] = static_cast<float>(at.x());
        picked.y[k] = static_cast<float>(at.y());
        picked.z[k] = static_cast<float>(at.z());
    }
}

}  // namespace

FloatPose to_floats(const Mat3& rotation, const Vec3& translation) {
    FloatPose out;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out.rotation[r][c] = static_cast<float>(rotation(r, c));
        out.translation[r] = static_cast<float>(translation[r]);
    }
    return out;
}

void PairSearch::pick(const PairView& view, double normal_extent, double tangent_extent,
                      SphereBlocks Shape::*blocks) {
    const bool few_a = a_has_fewer(view);
    const SphereBlocks& few = (few_a ? view.shape_a : view.shape_b).*blocks;
    const SphereBlocks& many = (few_a ? view.shape_b : view.shape_a).*blocks;
    // to and from the axes of the few
    const Mat3 rotation = few_a ? view.rotation_ab : Mat3(view.rotation_ab.transpose());
    const Vec3 translation =
        few_a ? view.translation_ab : Vec3(-(view.rotation_ab.transpose() * view.translation_ab));
    const Mat3 back = rotation.transpose();

    // Floats round with the extent of the numbers, and groups hold the places before any crushing:
    // both widen the range in which spheres are picked, so none is missed.
    const double extent = 2.0 * (few.size + 2.0 * many.size) + translation.norm();
    const double rounding = static_cast<double>(SphereBlocks::kFloatShare) * extent;
    const double slack = rounding + view.scene.crushed.deepest_of(view.pair.a) +
                         view.scene.crushed.deepest_of(view.pair.b);
    range_ = {static_cast<float>(normal_extent + slack),
              static_cast<float>(tangent_extent + slack)};

    const float grow_few = growth_of(many, range_);
    grow_ = growth_of(few, range_);
    few_.count = 0;
    // Each body is narrowed by the other's box: many against the box of all few, then the few
    // against the box of the many that are left.
    find_groups(many, move_box(few.box, back, -(back * translation)), many.largest_own + grow_,
                groups_);
    if (groups_.empty()) return;
    pick_spheres(many, groups_, to_floats(rotation, translation), few.box, grow_, many_);
    if (many_.count == 0) return;
    find_groups(few, many_.box, few.largest_own + grow_few, groups_);
    pick_spheres(few, groups_, to_floats(Mat3::Identity(), Vec3::Zero()), many_.box, grow_few,
                 few_);
    // Those picked are compared at their present places. One deeply crushed sphere would else list
    // every sphere of its body with all within that depth. The boxes of few_ and many_ are those of
    // the places before; none of them is read from here on.
    move_crushed(view.scene.crushed, few_a ? view.pair.b : view.pair.a,
                 few_a ? view.shape_b : view.shape_a, rotation, translation, many_);
    move_crushed(view.scene.crushed, few_a ? view.pair.a : view.pair.b,
                 few_a ? view.shape_a : view.shape_b, Mat3::Identity(), Vec3::Zero(), few_);
    range_ = {static_cast<float>(normal_extent + rounding),
              static_cast<float>(tangent_extent + rounding)};
    grow_ = growth_of(few, range_);
}

const NearSpheres& PairSearch::partners_of(std::size_t first, std::size_t last) {
    // the box around these rows: only the many near it are compared with them
    if (many_.count <= kAllAtOnce) return many_;
    const auto extent = [&](const std::vector<float>& values, int d, FloatBox& box) {
        const auto [low, high] = std::minmax_element(values.begin() + static_cast<long>(first),
                                                     values.begin() + static_cast<long>(last));
        box.low[d] = *low;
        box.high[d] = *high;
    };
    FloatBox box;
    extent(few_.x, 0, box);
    extent(few_.y, 1, box);
    extent(few_.z, 2, box);
    pick_spheres(many_, box, grow_, partners_);
    return partners_;
}

}  // namespace ice
