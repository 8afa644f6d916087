// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/prism_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "preprocess/field/make_prism.hpp"
#include "preprocess/slice/convex_parts.hpp"

namespace ice {

namespace {

// A plane is that of a side whose normal is this near (cosine [-]; 1e-4 rad): planes come from
// triangles of the same corners. A larger angle takes a cut beside a side for this side.
constexpr double kSameSide = 1.0 - 5e-9;

// A part's area below which it is a line [m2]: corners on a straight line. A larger value
// drops narrow parts.
constexpr double kNoArea = 1e-9;

using Corners = std::vector<std::int32_t>;  // of the outline

const Vec2& corner_of(const Loop& outline, std::int32_t k) {
    const auto n = static_cast<std::int32_t>(outline.size());
    return outline[static_cast<std::size_t>((k + n) % n)];
}

Loop loop_of(const Loop& outline, const Corners& corners) {
    Loop out;
    for (const std::int32_t k : corners) out.push_back(corner_of(outline, k));
    return out;
}

// Out of the area to the left of the line [-].
Vec3 outward(const Vec2& from, const Vec2& to) {
    const Vec2 along = (to - from).normalized();
    return {along.y(), -along.x(), 0.0};
}

bool turns_left(const Loop& outline, std::int32_t k) {
    const Vec2 before = corner_of(outline, k) - corner_of(outline, k - 1),
               after = corner_of(outline, k + 1) - corner_of(outline, k);
    return before.x() * after.y() - before.y() * after.x() > 0.0;
}

// A part, and what of it lies on the surface of the whole prism.
class CutPart {
public:
    CutPart(const Loop& outline, const Corners& corners, double thickness)
        : outline_(outline), corners_(corners) {
        whole_ = make_convex_piece(make_prism(loop_of(outline, corners), thickness, 0.0));
        for (std::size_t k = 0; k < whole_.plane_count(); ++k)
            is_cut_.push_back(is_cut(whole_.normals[k]));
    }
    bool empty() const { return whole_.empty(); }

    SolidPart part() const {
        SolidPart out;
        keep_planes(out);
        keep_edges(out.solid);
        out.solid.corners = whole_.corners;
        out.closed = whole_;
        Eigen::AlignedBox3d box;
        for (std::size_t k = 0; k < whole_.corners.size(); ++k) box.extend(whole_.corners[k]);
        out.middle = box.center();
        for (std::size_t k = 0; k < whole_.corners.size(); ++k)
            out.radius = std::max(out.radius, (whole_.corners[k] - out.middle).norm());
        return out;
    }

private:
    bool is_cut(const Vec3& normal) const {
        bool found = false;
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            const std::int32_t from = corners_[k], to = corners_[(k + 1) % corners_.size()];
            const Vec3 n = outward(corner_of(outline_, from), corner_of(outline_, to));
            if (n.dot(normal) < kSameSide) continue;
            // a side of the outline ends at its next corner, a cut at another one
            if ((from + 1) % static_cast<std::int32_t>(outline_.size()) == to) return false;
            found = true;
        }
        return found;
    }

    void keep_planes(SolidPart& out) const {
        std::vector<Vec3> normals;
        for (std::size_t k = 0; k < whole_.plane_count(); ++k) {
            if (is_cut_[k]) {
                out.cuts.push_back({whole_.normals[k], whole_.offsets[k]});
                continue;
            }
            normals.push_back(whole_.normals[k]);
            out.solid.offsets.push_back(whole_.offsets[k]);
            out.solid.loops.push_back(whole_.loops[k]);
            out.solid.side_planes.push_back(whole_.side_planes[k]);
        }
        out.solid.normals = VectorBlocks(normals);
        // kernels read offsets in whole blocks, too
        while (out.solid.offsets.size() % VectorBlock::kLanes != 0)
            out.solid.offsets.push_back(out.solid.offsets.back());
    }

    // The corner of the outline below or above a corner of the part.
    std::int32_t outline_corner(const Vec3& p) const {
        return *std::min_element(corners_.begin(), corners_.end(),
                                 [&](std::int32_t l, std::int32_t r) {
                                     return (corner_of(outline_, l) - p.head<2>()).squaredNorm() <
                                            (corner_of(outline_, r) - p.head<2>()).squaredNorm();
                                 });
    }

    void keep_edges(ConvexPiece& out) const {
        std::vector<Vec3> middle, along, left, right;
        for (std::size_t k = 0; k < whole_.edges.size(); ++k) {
            const SolidEdge& e = whole_.edges[k];
            std::pair normals{whole_.edge_left[k], whole_.edge_right[k]};
            const bool ends_cut = is_cut_[static_cast<std::size_t>(e.left)] ||
                                  is_cut_[static_cast<std::size_t>(e.right)];
            if (ends_cut) {
                const Vec3 begin = whole_.corners[static_cast<std::size_t>(e.begin)];
                const std::int32_t at = outline_corner(begin);
                const bool upright = std::abs(whole_.edge_along[k].z()) > 0.5;
                // edges of the cut within a face, or in a hollow corner, are no edges of the whole
                if (!upright || !turns_left(outline_, at)) continue;
                normals = {outward(corner_of(outline_, at - 1), corner_of(outline_, at)),
                           outward(corner_of(outline_, at), corner_of(outline_, at + 1))};
                if (whole_.edge_along[k].z() < 0.0) std::swap(normals.first, normals.second);
            }
            out.edges.push_back(e);
            middle.push_back(whole_.edge_middle[k]);
            along.push_back(whole_.edge_along[k]);
            left.push_back(normals.first);
            right.push_back(normals.second);
        }
        out.edge_middle = VectorBlocks(middle);
        out.edge_along = VectorBlocks(along);
        out.edge_left = VectorBlocks(left);
        out.edge_right = VectorBlocks(right);
    }

    const Loop& outline_;
    const Corners& corners_;
    ConvexPiece whole_;         // cuts included
    std::vector<bool> is_cut_;  // by its plane
};

}  // namespace

std::vector<SolidPart> prism_parts(const Loop& outline, double thickness) {
    std::vector<SolidPart> out;
    for (const Corners& corners : convex_parts(outline)) {
        if (area_of(loop_of(outline, corners)) <= kNoArea) continue;
        const CutPart part(outline, corners, thickness);
        if (part.empty()) return {};
        out.push_back(part.part());
    }
    return out;
}

}  // namespace ice
