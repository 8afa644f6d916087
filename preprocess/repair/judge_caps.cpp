// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/judge_caps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "common/geometry/winding_number.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/repair/cap_limits.hpp"

namespace ice {

namespace {

// Edges round a face or two, or round one vertex, that are missing [-]: such an opening has a known
// shape. A larger value takes open ends of coarse meshes for such openings, a smaller one refuses
// meshes that lack a face at an end.
constexpr std::size_t kFewEdges = 8;

// Volume in doubt by one cap over the whole [-]: below it the kind does not matter and is not found
// out, which saves time only.
constexpr double kTrifle = 0.0005;

// tan a of the turn at a rim is computed with a cosine of at least this [-], that of 85 degrees: an
// upright wall would put an infinite volume in doubt. A larger value puts less volume in doubt at
// steep rims, a smaller one more.
constexpr double kSteepest = 0.0872;

// Lengths and angles that count as none: far above the rounding of coordinates with six digits.

// Distance of an opening from an end over the length [-] up to which it is at the end. A larger
// value refuses more caps, a smaller one passes missing stems by rounding.
constexpr double kAtEnd = 1e-3;
// Rise of a rim's edge over the diagonal [-] from which it is a step, which no deck has. A larger
// value takes jagged ends of a surface for decks, a smaller one refuses decks for rounding.
constexpr double kStep = 1e-3;
// From a cap to the point of evaluation, over the diagonal [-]. A larger value may lie in another
// part beside the cap, a smaller one so near to the cap that rounding decides.
constexpr double kJustOutside = 1e-4;
// Cosine of one degree [-]: faces of one plane. A larger angle takes curved surfaces for flat ones,
// a smaller one faces of one plane for several.
const double kOneDegree = std::cos(std::numbers::pi / 180.0);

struct Plane {
    Vec3 normal;
    double offset;
};

// Measures one cap after the other against the whole surface and volume, which are summed once.
class Judge {
public:
    Judge(const TriangleMesh& mesh, const std::vector<Cap>& caps)
        : mesh_(mesh), parts_(find_parts(mesh)) {
        std::vector<std::uint8_t> capped(mesh.triangles.size(), 0);
        for (const Cap& cap : caps)
            std::fill_n(capped.begin() + cap.first, cap.count, std::uint8_t{1});
        for (std::size_t t = 0; t < capped.size(); ++t)
            if (!capped[t]) surface_ += mesh.area_vector(t).norm();
        for (const double part : part_volumes(mesh, parts_)) volume_ += std::abs(part);
        Eigen::AlignedBox3d box;
        for (const Vec3& v : mesh.vertices) box.extend(v);
        size_ = box.diagonal().norm();
        box_ = box;
    }

    // A cap of guessed shape where the solid ends along its length. A whole stem may be missing
    // there; its length is unknown, however small its volume.
    bool cuts_an_end(const Cap& cap, const CapVerdict& verdict) const {
        if (verdict.kind != CapKind::small || verdict.area <= CapLimits::kEnd * surface_ ||
            cap.rim.size() <= kFewEdges)
            return false;
        int along = 0;
        box_.sizes().maxCoeff(&along);
        const double near = kAtEnd * box_.sizes()[along];
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t)
            for (int k = 0; k < 3; ++k) {
                const double x = mesh_.corner(static_cast<std::size_t>(t), k)[along];
                if (x < box_.min()[along] + near || x > box_.max()[along] - near) return true;
            }
        return false;
    }

    double surface() const { return surface_; }
    double volume() const { return volume_; }

    CapVerdict measure(const Cap& cap) const {
        CapVerdict out;
        const std::vector<Plane> planes = continued_planes(cap);
        // A triangle of the cap in the plane of a neighbouring face continues it: only the others
        // are guesses.
        double guessed = 0.0;  // area that continues no neighbour
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t) {
            const auto tt = static_cast<std::size_t>(t);
            const double area = mesh_.area_vector(tt).norm();
            out.area += area;
            out.at +=
                area * (mesh_.corner(tt, 0) + mesh_.corner(tt, 1) + mesh_.corner(tt, 2)) / 3.0;
            if (!continues(tt, planes)) guessed += area;
        }
        if (out.area > 0.0) out.at /= out.area;
        double turn = 0.0, length = 0.0;
        for (const RimEdge& edge : cap.rim) {
            if (continues(static_cast<std::size_t>(edge.patch), planes)) continue;
            turn += edge.length * slope(edge);
            length += edge.length;
        }
        const double mean = length > 0.0 ? turn / length : 1.0 / kSteepest;
        // The volume that a surface turning by this mean slope at the rim might have had beyond the
        // cap (judge_caps.hpp).
        if (cap.perimeter > 0.0) out.doubt = guessed * out.area / cap.perimeter * mean;
        if (guessed <= CapLimits::kNoGuess * out.area) out.kind = CapKind::continued;
        return out;
    }

    // Whether all of the cap lies inside other parts: just outside it the winding number is theirs.
    bool is_hidden(const Cap& cap) {
        if (!winding_) winding_.emplace(mesh_);
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t) {
            const auto tt = static_cast<std::size_t>(t);
            const Vec3 middle =
                (mesh_.corner(tt, 0) + mesh_.corner(tt, 1) + mesh_.corner(tt, 2)) / 3.0;
            // the middle and three places near the corners: a triangle may be covered in part only
            for (const Vec3& p : {middle, Vec3(0.2 * middle + 0.8 * mesh_.corner(tt, 0)),
                                  Vec3(0.2 * middle + 0.8 * mesh_.corner(tt, 1)),
                                  Vec3(0.2 * middle + 0.8 * mesh_.corner(tt, 2))})
                if (!winding_->contains(p + kJustOutside * size_ * normal(t))) return false;
        }
        return true;
    }

    bool is_deck(const Cap& cap) const {
        double area = 0.0, walls = 0.0, length = 0.0;
        Vec3 sum = Vec3::Zero();
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t) {
            sum += mesh_.area_vector(static_cast<std::size_t>(t));
            area += mesh_.area_vector(static_cast<std::size_t>(t)).norm();
        }
        for (const RimEdge& edge : cap.rim) {
            walls += edge.length * normal(edge.neighbour).z();
            length += edge.length;
        }
        // A deck faces upwards, its rim lies on walls, runs without steps, and nothing of its part
        // is above it.
        return sum.z() >= CapLimits::kLevel * area && walls <= CapLimits::kLeansIn * length &&
               walls >= -CapLimits::kLeansOut * length && !has_steps(cap) && spans_and_tops(cap);
    }

private:
    Vec3 normal(std::int32_t t) const {
        return mesh_.area_vector(static_cast<std::size_t>(t)).normalized();
    }

    // tan(a) of the angle the surface turns by across the rim; at most that of 85 degrees.
    double slope(const RimEdge& edge) const {
        const double c = normal(edge.patch).dot(normal(edge.neighbour));
        return std::sqrt(std::max(1.0 - c * c, 0.0)) / std::max(c, kSteepest);
    }

    std::vector<Plane> continued_planes(const Cap& cap) const {
        std::vector<Plane> planes;
        for (const RimEdge& edge : cap.rim) {
            const Vec3 n = normal(edge.neighbour);
            if (normal(edge.patch).dot(n) < kOneDegree) continue;
            const double offset = n.dot(mesh_.corner(static_cast<std::size_t>(edge.patch), 0));
            const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& p) {
                return p.normal.dot(n) > kOneDegree &&
                       std::abs(p.offset - offset) < CapLimits::kOnePlane * size_;
            });
            if (!known) planes.push_back({n, offset});
            if (planes.size() == CapLimits::kMostPlanes) break;
        }
        return planes;
    }

    bool continues(std::size_t t, const std::vector<Plane>& planes) const {
        const Vec3 area = mesh_.area_vector(t);
        return std::any_of(planes.begin(), planes.end(), [&](const Plane& p) {
            return area.dot(p.normal) >= kOneDegree * area.norm() &&
                   std::abs(p.normal.dot(mesh_.corner(t, 0)) - p.offset) <
                       CapLimits::kOnePlane * size_;
        });
    }

    // A sheer line is smooth; the edge of a surface that ends within a row of faces is not.
    bool has_steps(const Cap& cap) const {
        return std::any_of(cap.rim.begin(), cap.rim.end(), [&](const RimEdge& edge) {
            return std::abs(edge.along.z()) > kStep * size_ &&
                   std::abs(edge.along.z()) > edge.along.head<2>().norm();
        });
    }

    // Reaches over most of its part, and the part has nothing above it.
    bool spans_and_tops(const Cap& cap) const {
        Eigen::AlignedBox3d rim, part;
        const auto first = static_cast<std::size_t>(cap.first);
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t)
            for (int k = 0; k < 3; ++k) rim.extend(mesh_.corner(static_cast<std::size_t>(t), k));
        std::vector<Vec3> higher;  // corners that might be above the cap
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (parts_.of_triangle[t] != parts_.of_triangle[first]) continue;
            for (int k = 0; k < 3; ++k) {
                part.extend(mesh_.corner(t, k));
                if (mesh_.corner(t, k).z() > rim.min().z() + CapLimits::kMayStandAbove * size_)
                    higher.push_back(mesh_.corner(t, k));
            }
        }
        for (int d = 0; d < 2; ++d)
            if (rim.sizes()[d] < CapLimits::kSpans * part.sizes()[d]) return false;
        return std::none_of(higher.begin(), higher.end(), [&](const Vec3& p) {
            return p.z() > height(cap, p) + CapLimits::kStandsAbove * size_;
        });
    }

    // Of the cap above or below p; where it does not reach, infinity.
    double height(const Cap& cap, const Vec3& p) const {
        for (std::int32_t t = cap.first; t < cap.first + cap.count; ++t) {
            const auto tt = static_cast<std::size_t>(t);
            const Vec3 a = mesh_.corner(tt, 0), b = mesh_.corner(tt, 1), c = mesh_.corner(tt, 2);
            const auto side = [&](const Vec3& q, const Vec3& r) {
                return (r.x() - q.x()) * (p.y() - q.y()) - (r.y() - q.y()) * (p.x() - q.x());
            };
            // barycentric coordinates in the plane z = 0; a triangle seen from its edge or from
            // below has none
            const double wa = side(b, c), wb = side(c, a), wc = side(a, b), sum = wa + wb + wc;
            if (std::min({wa, wb, wc}) < 0.0 || sum <= 0.0) continue;
            return (wa * a.z() + wb * b.z() + wc * c.z()) / sum;
        }
        return std::numeric_limits<double>::infinity();
    }

    const TriangleMesh& mesh_;
    std::optional<WindingNumber> winding_;  // of all parts, made when needed
    Parts parts_;
    Eigen::AlignedBox3d box_;
    double surface_ = 0.0, volume_ = 0.0, size_ = 0.0;
};

}  // namespace

std::vector<CapVerdict> judge_caps(const TriangleMesh& mesh, const std::vector<Cap>& caps,
                                   bool suspect) {
    Judge judge(mesh, caps);
    std::vector<CapVerdict> out;
    double doubt = 0.0, loose = 0.0, continued = 0.0;
    for (const Cap& cap : caps) {
        out.push_back(judge.measure(cap));
        CapVerdict& cap_is = out.back();
        // Tests by winding numbers cost time: a cap too small to change the result is accepted
        // without them.
        const bool matters = cap_is.doubt > kTrifle * judge.volume() ||
                             cap_is.area > CapLimits::kLoose * judge.surface();
        if (suspect && cap_is.area > CapLimits::kSuspect * judge.surface())
            cap_is.kind = CapKind::guess;
        else if (matters && judge.is_hidden(cap))
            cap_is.kind = CapKind::hidden;
        else if (matters && judge.is_deck(cap))
            cap_is.kind = CapKind::deck;
        else if (judge.cuts_an_end(cap, cap_is) && !judge.is_hidden(cap) && !judge.is_deck(cap))
            cap_is.kind = CapKind::guess;
        if (cap_is.kind == CapKind::deck || cap_is.kind == CapKind::hidden) continue;
        doubt += cap_is.doubt;
        (cap_is.kind == CapKind::continued ? continued : loose) += cap_is.area;
    }
    // Each cap by itself and all together: many small caps may hide a large loss.
    const bool each = std::all_of(out.begin(), out.end(), [&](const CapVerdict& cap) {
        return cap.kind == CapKind::deck || cap.kind == CapKind::hidden ||
               cap.doubt <= CapLimits::kDoubt * judge.volume();
    });
    const bool stand = each && doubt <= kMostDoubt * judge.volume() &&
                       loose <= CapLimits::kLoose * judge.surface() &&
                       continued <= CapLimits::kContinued * judge.surface();
    if (stand) return out;
    // name the cap that uses the largest share of its allowance
    const auto weight = [&](const CapVerdict& cap) {
        const double of_area =
            cap.kind == CapKind::continued ? CapLimits::kContinued : CapLimits::kLoose;
        return std::max(cap.doubt / (CapLimits::kDoubt * judge.volume()),
                        cap.area / (of_area * judge.surface()));
    };
    CapVerdict* heaviest = nullptr;
    for (CapVerdict& cap : out)
        if (cap.kind != CapKind::deck && cap.kind != CapKind::hidden &&
            (heaviest == nullptr || weight(cap) > weight(*heaviest)))
            heaviest = &cap;
    if (heaviest != nullptr) heaviest->kind = CapKind::guess;
    return out;
}

}  // namespace ice
