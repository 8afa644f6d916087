// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/face_corners.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "common/geometry/plane_crossing.hpp"
#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// What a corner is, in its id: 2 bits for the kind of axis, 6 for the face, 2 for this, and 22 for
// the numbers of the features. Each side plane of a face has a bit. Euler's formula allows a piece
// twice as many edges as corners.
static_assert(ConvexPiece::kMost <= 64);

class FaceCorners {
public:
    FaceCorners(const ConvexPiece& reference, std::size_t face, const ConvexPiece& incident,
                const RelativePose& pose, double slack, double most, std::uint32_t kind,
                FaceCornersWork& work, std::vector<PolygonCorner>& out)
        : reference_(reference),
          incident_(incident),
          pose_(pose),
          sides_(reference.side_planes[face]),
          loop_(reference.loops[face]),
          n_(reference.normals[face]),
          offset_(reference.offsets[face]),
          slack_(slack),
          most_(most),
          id_(kind << 30 | static_cast<std::uint32_t>(face) << 24),
          work_(work),
          out_(out) {
        const Vec3 along = ordered_transposed(pose.rotation, n_);
        work.facing.clear();
        for (std::size_t k = 0; k < incident.plane_count(); ++k)
            work.facing.push_back(ordered_dot(incident.normals[k], along));
        work.places.clear();
        work.heights.clear();
        work.beyond.clear();
        work.outside.clear();
        work.turned.assign(incident.corners.size(), 0);
        for (std::size_t k = 0; k < incident.corners.size(); ++k) {
            const Vec3 at = ordered_product(pose.rotation, incident.corners[k]) + pose.translation;
            work.places.push_back(at);
            work.heights.push_back(ordered_dot(n_, at) - offset_);
            std::uint64_t outside = 0;
            for (std::size_t s = 0; s < sides_.size(); ++s) {
                work.beyond.push_back(beyond(sides_[s], at));
                outside |= static_cast<std::uint64_t>(work.beyond.back() > 0.0) << s;
            }
            work.outside.push_back(outside);
        }
    }

    void append() {
        for (std::size_t e = 0; e < incident_.edges.size(); ++e) {
            const SolidEdge& edge = incident_.edges[e];
            // the surface behind, which is turned away from the face, does not meet it
            if (facing(edge.left) >= 0.0 && facing(edge.right) >= 0.0) continue;
            work_.turned[static_cast<std::size_t>(edge.begin)] = 1;
            work_.turned[static_cast<std::size_t>(edge.end)] = 1;
            add_crossings(e);
        }
        for (std::size_t k = 0; k < work_.places.size(); ++k)
            if (work_.turned[k] && work_.heights[k] <= most_ && work_.outside[k] == 0)
                add(work_.places[k], work_.heights[k], Met::incident_corner, k, 0);
        for (const std::int32_t corner : loop_) add_entry(static_cast<std::size_t>(corner));
    }

private:
    double facing(std::int32_t plane) const {
        return work_.facing[static_cast<std::size_t>(plane)];
    }
    double beyond(const SidePlane& side, const Vec3& at) const {
        return ordered_dot(side.outward, at) - (side.offset + slack_);
    }
    double beyond(std::size_t corner, std::size_t side) const {
        return work_.beyond[corner * sides_.size() + side];
    }

    // Where an edge of the incident piece enters or leaves the space over the face.
    void add_crossings(std::size_t e) {
        const auto p = static_cast<std::size_t>(incident_.edges[e].begin),
                   q = static_cast<std::size_t>(incident_.edges[e].end);
        const std::uint64_t of_p = work_.outside[p], of_q = work_.outside[q];
        // outside of one side plane as a whole, or too high
        if ((of_p & of_q) != 0 || std::min(work_.heights[p], work_.heights[q]) > most_) return;
        for (std::uint64_t crossed = of_p ^ of_q; crossed != 0; crossed &= crossed - 1) {
            const auto s = static_cast<std::size_t>(std::countr_zero(crossed));
            const double hp = beyond(p, s), hq = beyond(q, s);
            const Vec3 at = plane_crossing(work_.places[p], hp, work_.places[q], hq);
            const double height = ordered_dot(n_, at) - offset_;
            if (height <= most_ && is_within_others(at, s))
                add(at, height, Met::edge_over_side, e, s);
        }
    }
    bool is_within_others(const Vec3& at, std::size_t side) const {
        for (std::size_t s = 0; s < sides_.size(); ++s)
            if (s != side && beyond(sides_[s], at) > 0.0) return false;
        return true;
    }

    // Where the line along the normal through a corner of the face enters the incident piece.
    void add_entry(std::size_t corner) {
        const Vec3 at = reference_.corners[corner];
        const Vec3 from = ordered_transposed(pose_.rotation, Vec3(at - pose_.translation));
        double enters = -std::numeric_limits<double>::infinity(), leaves = -enters;
        for (std::size_t k = 0; k < incident_.plane_count(); ++k) {
            const double facing = work_.facing[k],
                         above = incident_.offsets[k] - ordered_dot(incident_.normals[k], from);
            if (facing == 0.0 && above < 0.0) return;
            if (facing == 0.0) continue;
            const double at_plane = above / facing;
            if (facing < 0.0)
                enters = std::max(enters, at_plane);
            else
                leaves = std::min(leaves, at_plane);
            if (enters > std::min(leaves, most_)) return;  // beside the piece, or too far away
        }
        add(at + enters * n_, enters, Met::reference_corner, corner, 0);
    }

    void add(const Vec3& at, double height, Met met, std::size_t first, std::size_t second) {
        // half of the gap back from the incident surface: midway between the surfaces
        out_.push_back({at - 0.5 * height * n_, height,
                        id_ | static_cast<std::uint32_t>(met) << 22 |
                            static_cast<std::uint32_t>(first << 8 | second)});
    }

    const ConvexPiece& reference_;
    const ConvexPiece& incident_;
    const RelativePose& pose_;
    const std::vector<SidePlane>& sides_;
    const std::vector<std::int32_t>& loop_;  // the face's corners
    Vec3 n_;
    double offset_, slack_, most_;
    std::uint32_t id_;
    FaceCornersWork& work_;
    std::vector<PolygonCorner>& out_;
};

}  // namespace

void append_face_corners(const ConvexPiece& reference, std::size_t face,
                         const ConvexPiece& incident, const RelativePose& pose, double slack,
                         double most, std::uint32_t kind, FaceCornersWork& work,
                         std::vector<PolygonCorner>& out) {
    FaceCorners(reference, face, incident, pose, slack, most, kind, work, out).append();
}

}  // namespace ice
