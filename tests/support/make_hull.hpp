// SPDX-License-Identifier: GPL-3.0-or-later
/// A ship hull made in code, at any number of triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::test {

/// Main dimensions of a made hull [m]. The default is a 100 m ship of about 27 000 m3.
struct HullSize {
    double length = 100.0, breadth = 20.0, depth = 18.0;
};

namespace hull_detail {

using Row = std::vector<std::int32_t>;  // vertices along a curve

// The port half while it grows; vertices with y = 0 will be shared with the starboard half.
class PortHalf {
public:
    PortHalf(const HullSize& size, double edge) : size_(size), edge_(edge) {}

    TriangleMesh build() {
        const int stations = std::max(4, static_cast<int>(std::lround(size_.length / edge_)));
        std::vector<Row> shell, deck;
        for (int i = 0; i <= stations; ++i) {
            const double u = static_cast<double>(i) / stations;
            shell.push_back(shell_row(u));
            deck.push_back(deck_row(u, shell.back().back()));
        }
        for (std::size_t i = 0; i + 1 < shell.size(); ++i) {
            zip(shell[i], shell[i + 1], true);
            zip(deck[i], deck[i + 1], false);
        }
        Row outline = shell.front();
        outline.insert(outline.end(), deck.front().rbegin() + 1, deck.front().rend());
        close_transom(outline);
        mirror();
        mesh_.region.assign(mesh_.triangles.size(), 0);
        return std::move(mesh_);
    }

private:
    // Point of the port side at u from transom (0) to stem (1), s from keel (0) to deck (1):
    // a superellipse between them, its exponent larger amidships than at the ends.
    Vec3 shell_point(double u, double s) const {
        constexpr double kFore = 0.65, kAft = 0.25;  // ends of the parallel middle body
        const double fore = std::max(0.0, (u - kFore) / (1.0 - kFore));
        const double aft = std::max(0.0, (kAft - u) / kAft);
        const double half = 0.5 * size_.breadth * (1.0 - std::pow(fore, 2.5) - 0.15 * aft * aft);
        const double keel = 0.35 * size_.depth * aft * aft;
        const double power = 2.0 / (4.4 - 2.0 * fore - 1.6 * aft);
        // the blend spreads the points over the nearly flat bottom and side
        const double angle = 0.5 * std::numbers::pi * s * s * s * (10.0 + s * (6.0 * s - 15.0));
        const double y = s == 1.0 ? half : half * std::pow(std::sin(angle), power);
        const double up = s == 1.0 ? 0.0 : std::pow(std::cos(angle), power);
        const double z = size_.depth - (size_.depth - keel) * up;
        const double rake = 0.12 * size_.length * std::pow(1.0 - z / size_.depth, 1.5);
        return {-0.5 * size_.length + u * (size_.length - rake), y, z};
    }

    std::int32_t add(const Vec3& p) {
        mesh_.vertices.push_back(p);
        return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
    }

    const Vec3& at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

    // Points at equal distances along the section at u.
    Row shell_row(double u) {
        constexpr std::size_t kFine = 400;
        std::vector<double> along{0.0};
        Vec3 last = shell_point(u, 0.0);
        for (std::size_t k = 1; k <= kFine; ++k) {
            const Vec3 p = shell_point(u, static_cast<double>(k) / kFine);
            along.push_back(along.back() + (p - last).norm());
            last = p;
        }
        const int count = std::max(2, static_cast<int>(std::lround(along.back() / edge_)));
        Row row;
        for (int k = 0; k <= count; ++k) {
            const double want = along.back() * k / count;
            const auto next = std::min<std::size_t>(
                kFine, static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), want) -
                                                along.begin()));
            const double part = (want - along[next - 1]) / (along[next] - along[next - 1]);
            const double s = (static_cast<double>(next - 1) + part) / kFine;
            row.push_back(add(shell_point(u, k == count ? 1.0 : s)));
        }
        return row;
    }

    // From the centre line to the deck edge, which is the shell's.
    Row deck_row(double u, std::int32_t deck_edge) {
        const Vec3 end = at(deck_edge);
        Row row;
        if (u < 1.0) {
            const int count = std::max(1, static_cast<int>(std::lround(end.y() / edge_)));
            for (int k = 0; k < count; ++k)
                row.push_back(add({end.x(), end.y() * k / count, end.z()}));
        }
        row.push_back(deck_edge);
        return row;
    }

    // Triangles between two curves, the shorter diagonal first. A triangle in the plane y = 0
    // would lie on its own mirror image.
    void zip(const Row& a, const Row& b, bool flip) {
        std::size_t i = 0, j = 0;
        const auto flat = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
            return at(p).y() == 0.0 && at(q).y() == 0.0 && at(r).y() == 0.0;
        };
        while (i + 1 < a.size() || j + 1 < b.size()) {
            bool step_a = j + 1 == b.size();
            if (!step_a && i + 1 < a.size()) {
                step_a = (at(a[i + 1]) - at(b[j])).norm() <= (at(b[j + 1]) - at(a[i])).norm();
                if (flat(a[i], b[j], step_a ? a[i + 1] : b[j + 1])) step_a = !step_a;
            }
            const std::int32_t next = step_a ? a[i + 1] : b[j + 1];
            std::array<std::int32_t, 3> t{a[i], b[j], next};
            if (flip) std::swap(t[0], t[1]);
            mesh_.triangles.push_back(t);
            ++(step_a ? i : j);
        }
    }

    // Rings that shrink to the middle of the transom, each with as many points as it is long.
    void close_transom(const Row& outline) {
        const Vec3 middle(-0.5 * size_.length, 0.0, 0.5 * (at(outline[0]).z() + size_.depth));
        const double reach = std::min(at(outline.back()).z() - middle.z(), 0.4 * size_.breadth);
        const int rings = std::max(2, static_cast<int>(std::lround(reach / edge_)));
        Row last = outline;
        for (int r = rings - 1; r > 0; --r) {
            const double scale = static_cast<double>(r) / rings;
            const auto count =
                std::max<std::size_t>(2, (outline.size() - 1) * static_cast<std::size_t>(r) /
                                             static_cast<std::size_t>(rings));
            Row ring;
            for (std::size_t k = 0; k <= count; ++k) {
                const double s =
                    static_cast<double>(k * (outline.size() - 1)) / static_cast<double>(count);
                const auto from = std::min(static_cast<std::size_t>(s), outline.size() - 2);
                const double part = s - static_cast<double>(from);
                const Vec3 p = (1.0 - part) * at(outline[from]) + part * at(outline[from + 1]);
                Vec3 q = middle + scale * (p - middle);
                q.x() = middle.x();
                if (k == 0 || k == count) q.y() = 0.0;
                ring.push_back(add(q));
            }
            zip(last, ring, false);
            last = ring;
        }
        zip(last, {add(middle)}, false);
    }

    void mirror() {
        std::vector<std::int32_t> image;
        const std::size_t count = mesh_.vertices.size();
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 p = mesh_.vertices[v];
            image.push_back(p.y() == 0.0 ? static_cast<std::int32_t>(v)
                                         : add({p.x(), -p.y(), p.z()}));
        }
        const std::size_t half = mesh_.triangles.size();
        for (std::size_t t = 0; t < half; ++t) {
            const auto& c = mesh_.triangles[t];
            mesh_.triangles.push_back({image[static_cast<std::size_t>(c[0])],
                                       image[static_cast<std::size_t>(c[2])],
                                       image[static_cast<std::size_t>(c[1])]});
        }
    }

    HullSize size_;
    double edge_;
    TriangleMesh mesh_;
};

}  // namespace hull_detail

/// A closed ship hull, outward oriented, symmetric about y = 0 bit for bit.
///
/// Bow towards +x with a raked stem, keel at z = 0, flat deck at z = depth, flat transom at
/// x = -length / 2, rising after body, superellipse sections, block coefficient 0.75. x runs from
/// -length / 2 to length / 2. Triangles are of nearly equal edges.
///
/// @param triangles  about as many as asked for: within a tenth for 1e3 and more
inline TriangleMesh make_hull(const HullSize& size, std::size_t triangles) {
    // the number of triangles goes with the inverse square of the edge
    double edge = size.length / 40.0;
    for (int k = 0; k < 2; ++k) {
        const TriangleMesh trial = hull_detail::PortHalf(size, edge).build();
        edge *=
            std::sqrt(static_cast<double>(trial.triangles.size()) / static_cast<double>(triangles));
    }
    return hull_detail::PortHalf(size, edge).build();
}

}  // namespace ice::test
