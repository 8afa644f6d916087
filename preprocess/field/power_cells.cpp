// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/power_cells.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"

namespace ice {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Regular = CGAL::Regular_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase,
                                                 CGAL::Regular_triangulation_face_base_2<Kernel>>>;

// Distance from a side [mean site distances] within which sites have images. Fewer images make the
// first try fail more often, more cost time; the cells are the same.
constexpr double kMargin = 6.0;
// Distance beyond the rectangle over its size [-] that is rounding. A smaller value makes the cells
// once more with all images for rounding alone; a larger one takes cells for whole that lack an
// image.
constexpr double kOutside = 1e-6;

// The sites, and images of those within `margin` of a side.
Regular triangulate_sites(const std::vector<Vec2>& sites, const std::vector<double>& weights,
                          const Rectangle& r, double margin) {
    std::vector<std::pair<Regular::Weighted_point, std::int32_t>> points;
    const auto add = [&](double x, double y, double weight, std::int32_t info) {
        points.emplace_back(Regular::Weighted_point(Kernel::Point_2(x, y), weight), info);
    };
    for (std::size_t k = 0; k < sites.size(); ++k) {
        const double x = sites[k].x(), y = sites[k].y(), w = weights[k];
        add(x, y, w, static_cast<std::int32_t>(k));
        // Halfway to a site's image across a side lies that side: with images the cells end
        // there.
        if (x - r.min().x() < margin) add(2.0 * r.min().x() - x, y, w, -1);
        if (r.max().x() - x < margin) add(2.0 * r.max().x() - x, y, w, -1);
        if (y - r.min().y() < margin) add(x, 2.0 * r.min().y() - y, w, -1);
        if (r.max().y() - y < margin) add(x, 2.0 * r.max().y() - y, w, -1);
    }
    return Regular(points.begin(), points.end());
}

// False when a cell extends beyond the rectangle: images were missing.
bool collect_cells(const Regular& regular, const Rectangle& r, std::vector<PowerCell>& cells) {
    const double slack = kOutside * r.sizes().maxCoeff();
    for (const auto& v : regular.finite_vertex_handles()) {
        if (v->info() < 0) continue;
        PowerCell& cell = cells[static_cast<std::size_t>(v->info())];
        auto face = regular.incident_faces(v);
        const auto first = face;
        do {
            if (regular.is_infinite(face)) return false;
            const auto centre = regular.dual(face);
            const Vec2 corner(centre.x(), centre.y());
            if (r.squaredExteriorDistance(corner) > slack * slack) return false;
            cell.corners.push_back(corner.cwiseMax(r.min()).cwiseMin(r.max()));
            // the edge to the next face's centre, anticlockwise, crosses the side to this vertex
            cell.neighbours.push_back(face->vertex(Regular::cw(face->index(v)))->info());
        } while (++face != first);
    }
    return true;
}

}  // namespace

std::vector<PowerCell> power_cells(const std::vector<Vec2>& sites,
                                   const std::vector<double>& weights, const Rectangle& rectangle) {
    ICE_ASSERT(!sites.empty() && weights.size() == sites.size());
    const double mean = std::sqrt(rectangle.volume() / static_cast<double>(sites.size()));
    const auto [least, most] = std::minmax_element(weights.begin(), weights.end());
    // Weights move an edge away from the middle: sites that far away may still have one at the
    // side.
    double margin = kMargin * mean + 2.0 * std::sqrt(*most - *least);
    const double all = 2.0 * rectangle.sizes().maxCoeff();
    // where the images were too few, once more with all of them
    for (;; margin = all) {
        std::vector<PowerCell> cells(sites.size());
        const Regular regular = triangulate_sites(sites, weights, rectangle, margin);
        if (collect_cells(regular, rectangle, cells) || margin >= all) return cells;
    }
}

}  // namespace ice
