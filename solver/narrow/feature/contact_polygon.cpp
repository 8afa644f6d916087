// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/contact_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry/plane_crossing.hpp"
#include "common/math/ordered_products.hpp"
#include "solver/narrow/feature/face_corners.hpp"

namespace ice {

namespace {

// ClippedCorner::edge is k for the incident face's k-th edge, kSidePlanes + k along the reference's
// k-th side plane. Room for a face's side planes in a corner's id [-]: at least as many as a piece
// has planes. A smaller number would give two corners one id.
constexpr std::uint32_t kSidePlanes = 64;
static_assert(ConvexPiece::kMost <= kSidePlanes);

// The faces that meet: of the reference piece plane `face`, the incident piece in its axes.
struct Meeting {
    const ConvexPiece& reference;
    const ConvexPiece& incident;
    RelativePose pose;  // of the incident piece
    std::size_t face;
    IncidentFaces which;
};

// Of the incident piece's planes the one that is turned most against the reference's face.
std::size_t incident_plane(const Meeting& m, const Vec3& n) {
    const Vec3 towards = ordered_transposed(m.pose.rotation, n);
    std::size_t best = 0;
    double least = 2.0;
    for (std::size_t k = 0; k < m.incident.plane_count(); ++k) {
        const double facing = ordered_dot(m.incident.normals[k], towards);
        if (facing >= least) continue;
        least = facing;
        best = k;
    }
    return best;
}

// Keeps the part of work.polygon within the side plane, which is `slack` [m] farther out.
void clip(const SidePlane& side, double slack, std::uint32_t number, ClippingWork& work) {
    auto& polygon = work.polygon;
    auto& rest = work.rest;
    auto& height = work.height;
    height.clear();
    for (const ClippedCorner& corner : polygon)
        height.push_back(ordered_dot(side.outward, corner.at) - (side.offset + slack));
    if (std::all_of(height.begin(), height.end(), [](double h) { return h <= 0.0; })) return;
    rest.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::size_t next = (k + 1) % polygon.size();
        const bool inside = height[k] <= 0.0;
        // Sutherland and Hodgman: corners inside stay, and an edge across the side plane gives a
        // new one. From there the outline follows the plane where it leaves, and the same
        // edge where it comes in.
        if (inside) rest.push_back(polygon[k]);
        if (inside == (height[next] <= 0.0)) continue;
        rest.push_back({plane_crossing(polygon[k].at, height[k], polygon[next].at, height[next]),
                        inside ? number : polygon[k].edge});
    }
    polygon.swap(rest);
}

double slack_of_gap(double gap) { return PolygonTolerances::kBesidePlane + std::max(gap, 0.0); }

// The corners of the incident face clipped by the reference's side planes; their places are found
// from the features that meet there, not from those found while clipping: so mirror images, clipped
// in another order, have the same bits.
class ClippedFace {
public:
    // @param slack  the side planes are this much farther out [m]
    // @param work   referred to, not copied
    ClippedFace(const Meeting& m, double slack, ClippingWork& work)
        : m_(m),
          slack_(slack),
          n_(m.reference.normals[m.face]),
          face_(work.face),
          polygon_(work.polygon) {
        plane_ = incident_plane(m, n_);
        face_.clear();
        for (const std::int32_t corner : m.incident.loops[plane_]) {
            const Vec3 at = m.incident.corners[static_cast<std::size_t>(corner)];
            face_.push_back(ordered_product(m.pose.rotation, at) + m.pose.translation);
        }
        // The whole incident face is clipped by one side plane after the other. Nothing is left of
        // it where the faces lie side by side.
        polygon_.clear();
        for (const Vec3& at : face_)
            polygon_.push_back({at, static_cast<std::uint32_t>(polygon_.size())});
        const std::vector<SidePlane>& sides = m.reference.side_planes[m.face];
        for (std::size_t k = 0; k < sides.size() && !polygon_.empty(); ++k)
            clip(sides[k], slack, kSidePlanes + static_cast<std::uint32_t>(k), work);
    }

    // Calls visit(place, id) for each corner, places in the reference's axes.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t k = 0; k < polygon_.size(); ++k) {
            // The two edges that meet in a corner name it: the same corner has the same id in
            // the next step.
            const std::uint32_t before = polygon_[(k + polygon_.size() - 1) % polygon_.size()].edge,
                                after = polygon_[k].edge;
            visit(place(before, after, polygon_[k].at), before << 7 | after);
        }
    }

private:
    Vec3 place(std::uint32_t before, std::uint32_t after, const Vec3& clipped) const {
        if (before < kSidePlanes && after < kSidePlanes) return clipped;  // the incident face's own
        if (before >= kSidePlanes && after >= kSidePlanes)
            return over_corner(before - kSidePlanes, after - kSidePlanes, clipped);
        // one edge of either face: where the incident edge passes the side plane
        const std::size_t edge = std::min(before, after);
        const SidePlane& side =
            m_.reference.side_planes[m_.face][std::max(before, after) - kSidePlanes];
        const Vec3 &p = face_[edge], &q = face_[(edge + 1) % face_.size()];
        const double offset = side.offset + slack_;
        return plane_crossing(p, ordered_dot(side.outward, p) - offset, q,
                              ordered_dot(side.outward, q) - offset);
    }
    // On the incident face, where two side planes meet: over the reference's corner between them.
    Vec3 over_corner(std::size_t before, std::size_t after, const Vec3& clipped) const {
        const std::vector<std::int32_t>& loop = m_.reference.loops[m_.face];
        // they meet beyond other side planes
        if (before != (after + 1) % loop.size()) return clipped;
        const Vec3 corner = m_.reference.corners[static_cast<std::size_t>(loop[before])];
        // along the reference's normal to the incident plane
        const Vec3 incident = ordered_product(m_.pose.rotation, m_.incident.normals[plane_]);
        const double offset =
            m_.incident.offsets[plane_] + ordered_dot(incident, m_.pose.translation);
        const double height = (offset - ordered_dot(incident, corner)) / ordered_dot(incident, n_);
        return corner + height * n_;
    }

    const Meeting& m_;
    double slack_;
    Vec3 n_;
    std::size_t plane_;
    std::vector<Vec3>& face_;
    std::vector<ClippedCorner>& polygon_;
};

// Corners between the reference's face and the incident faces, in the reference's axes.
void meet_faces(const Meeting& m, double gap, double most, std::uint32_t kind, ClippingWork& work,
                ContactPolygon& out) {
    if (m.which == IncidentFaces::all)
        return append_face_corners(m.reference, m.face, m.incident, m.pose, slack_of_gap(gap), most,
                                   kind, work.corners, out.corners);
    const Vec3 n = m.reference.normals[m.face];
    const std::uint32_t face_id = kind << 30 | static_cast<std::uint32_t>(m.face) << 14;
    ClippedFace(m, slack_of_gap(gap), work).for_each([&](const Vec3& at, std::uint32_t id) {
        // half of the gap back from the incident corner: midway between the surfaces
        const double height = ordered_dot(n, at) - m.reference.offsets[m.face];
        if (height <= most) out.corners.push_back({at - 0.5 * height * n, height, face_id | id});
    });
}

// Two edges of the axes where their lines are nearest, a's axes.
struct EdgeCrossing {
    EdgeCrossing(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                 const SeparatingAxes& axes)
        : ka(static_cast<std::size_t>(axes.edge_a)),
          kb(static_cast<std::size_t>(axes.edge_b)),
          gap(axes.edges) {
        pa = a.edge_middle[ka];
        ea = a.edge_along[ka];
        pb = ordered_product(pose.rotation, b.edge_middle[kb]) + pose.translation;
        eb = ordered_product(pose.rotation, b.edge_along[kb]);
        // The closest points p_a + s e_a and p_b + t e_b of two lines, with c = e_a x e_b: s =
        // (e_b x c) . (p_b - p_a) / |c|^2 and t = (e_a x c) . (p_b - p_a) / |c|^2.
        const Vec3 apart = pb - pa, across = ea.cross(eb);
        const double square = ordered_dot(across, across);
        along_a = ordered_dot(eb.cross(across), apart) / square;
        along_b = ordered_dot(ea.cross(across), apart) / square;
        const auto half = [](const ConvexPiece& piece, std::size_t k) {
            const SolidEdge& e = piece.edges[k];
            return (piece.corners[static_cast<std::size_t>(e.end)] - piece.edge_middle[k]).norm();
        };
        half_a = half(a, ka);
        half_b = half(b, kb);
    }
    PolygonCorner corner() const {
        return {0.5 * (pa + along_a * ea + pb + along_b * eb), gap,
                3u << 30 | static_cast<std::uint32_t>(ka << 12 | kb)};
    }

    std::size_t ka, kb;       // the edges
    double gap;               // [m]
    Vec3 pa, ea, pb, eb;      // their middles [m] and unit directions
    double along_a, along_b;  // from the middle to the crossing [m]
    double half_a, half_b;    // from the middle to the end [m]
};

// Midway between two edges where their lines are nearest; nowhere where that is beyond an end.
void meet_edges(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                const SeparatingAxes& axes, ContactPolygon& out) {
    const EdgeCrossing at(a, b, pose, axes);
    const double slack = slack_of_gap(at.gap);
    if (std::abs(at.along_a) > at.half_a + slack || std::abs(at.along_b) > at.half_b + slack)
        return;
    out.corners.push_back(at.corner());
}

enum class AxisKind { face_a, face_b, edges };

// In the order a's face, b's face, edges: a later kind needs a wider gap by kPrefer.
AxisKind widest_face(const SeparatingAxes& axes) {
    return axes.face_b > axes.face_a + PolygonTolerances::kPrefer ? AxisKind::face_b
                                                                  : AxisKind::face_a;
}

AxisKind widest_kind(const SeparatingAxes& axes) {
    const AxisKind face = widest_face(axes);
    const double gap = face == AxisKind::face_b ? axes.face_b : axes.face_a;
    return axes.edges > gap + PolygonTolerances::kPrefer ? AxisKind::edges : face;
}

AxisKind exactly_widest_kind(const SeparatingAxes& axes) {
    if (axes.widest() == axes.face_a) return AxisKind::face_a;
    return axes.widest() == axes.face_b ? AxisKind::face_b : AxisKind::edges;
}

Vec3 normal_along(AxisKind kind, const ConvexPiece& a, const ConvexPiece& b,
                  const RelativePose& pose, const SeparatingAxes& axes) {
    if (kind == AxisKind::edges) return edge_axis(a, b, pose, axes.edge_a, axes.edge_b);
    if (kind == AxisKind::face_a) return a.normals[static_cast<std::size_t>(axes.plane_a)];
    return -ordered_product(pose.rotation, b.normals[static_cast<std::size_t>(axes.plane_b)]);
}

// Two pieces and what make_contact_polygon knows of them.
struct Pieces {
    const ConvexPiece &a, &b;
    const RelativePose& pose;
    const SeparatingAxes& axes;
    IncidentFaces which;
    double most;  // [m]
};

// The polygon along one kind of axis.
void meet_along(AxisKind kind, const Pieces& p, ClippingWork& work, ContactPolygon& out) {
    out.corners.clear();
    out.normal = normal_along(kind, p.a, p.b, p.pose, p.axes);
    if (kind == AxisKind::edges) {
        if (p.axes.edges <= p.most) meet_edges(p.a, p.b, p.pose, p.axes, out);
        return;
    }
    if (kind == AxisKind::face_a) {
        const auto plane = static_cast<std::size_t>(p.axes.plane_a);
        meet_faces({p.a, p.b, p.pose, plane, p.which}, p.axes.face_a, p.most, 0u, work, out);
        return;
    }
    // b's face is the reference: the same in b's axes, and back again
    const RelativePose back{p.pose.rotation.transpose(),
                            -ordered_transposed(p.pose.rotation, p.pose.translation)};
    const auto plane = static_cast<std::size_t>(p.axes.plane_b);
    meet_faces({p.b, p.a, back, plane, p.which}, p.axes.face_b, p.most, 1u, work, out);
    for (PolygonCorner& corner : out.corners)
        corner.point = ordered_product(p.pose.rotation, corner.point) + p.pose.translation;
}

// The polygon over the wider face where its normal is nearly the axis of the two edges and one of
// its corners is as near as their crossing; false where there is no such corner.
bool meet_in_face_of_edges(const Pieces& p, ClippingWork& work, ContactPolygon& out) {
    const AxisKind face = widest_face(p.axes);
    const double facing = ordered_dot(normal_along(face, p.a, p.b, p.pose, p.axes),
                                      normal_along(AxisKind::edges, p.a, p.b, p.pose, p.axes));
    if (facing < std::cos(PolygonTolerances::kSameAxis)) return false;
    meet_along(face, p, work, out);
    double deepest = std::numeric_limits<double>::infinity();
    for (const PolygonCorner& corner : out.corners) deepest = std::min(deepest, corner.gap);
    return deepest <= p.axes.edges + PolygonTolerances::kPrefer;
}

}  // namespace

PolygonCorner edge_corner(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                          const SeparatingAxes& axes) {
    EdgeCrossing at(a, b, pose, axes);
    at.along_a = std::clamp(at.along_a, -at.half_a, at.half_a);
    at.along_b = std::clamp(at.along_b, -at.half_b, at.half_b);
    return at.corner();
}

bool is_edge_axis(const SeparatingAxes& axes) { return widest_kind(axes) == AxisKind::edges; }

Vec3 axis_normal(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                 const SeparatingAxes& axes) {
    return normal_along(widest_kind(axes), a, b, pose, axes);
}

void make_contact_polygon(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                          const SeparatingAxes& axes, IncidentFaces which, double most,
                          ClippingWork& work, ContactPolygon& out) {
    const AxisKind preferred = widest_kind(axes), widest = exactly_widest_kind(axes);
    const Pieces pieces{a, b, pose, axes, which, most};
    const bool met = which == IncidentFaces::all && preferred == AxisKind::edges &&
                     meet_in_face_of_edges(pieces, work, out);
    if (!met) meet_along(preferred, pieces, work, out);
    // An axis that is preferred by kPrefer may be that of a face beside the contact.
    if (out.corners.empty() && widest != preferred) meet_along(widest, pieces, work, out);
    // A corner may lie beside the incident face by up to the gap. A nearly upright face is far
    // below the reference there, but no point of the piece is deeper than the axis says.
    for (PolygonCorner& corner : out.corners) corner.gap = std::max(corner.gap, axes.widest());
}

}  // namespace ice
