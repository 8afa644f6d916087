// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/slice/convex_parts.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

#include <numeric>

namespace ice {

std::vector<std::vector<std::int32_t>> convex_parts(const Loop& outline) {
    // Exact predicates: which diagonals there are must not depend on rounding. Points are indices,
    // so that the parts name their corners.
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
    using Traits = CGAL::Partition_traits_2<Kernel, Map>;
    std::vector<Kernel::Point_2> points;
    for (const Vec2& p : outline) points.emplace_back(p.x(), p.y());
    if (points.size() < 3 || !CGAL::is_simple_2(points.begin(), points.end(), Kernel()) ||
        CGAL::orientation_2(points.begin(), points.end(), Kernel()) != CGAL::COUNTERCLOCKWISE)
        return {};
    std::vector<std::size_t> corners(points.size());
    std::iota(corners.begin(), corners.end(), std::size_t{0});
    std::vector<Traits::Polygon_2> parts;
    CGAL::optimal_convex_partition_2(corners.begin(), corners.end(), std::back_inserter(parts),
                                     Traits(CGAL::make_property_map(points)));
    std::vector<std::vector<std::int32_t>> out;
    for (const Traits::Polygon_2& part : parts) {
        out.emplace_back();
        for (auto at = part.vertices_begin(); at != part.vertices_end(); ++at)
            out.back().push_back(static_cast<std::int32_t>(*at));
    }
    return out;
}

}  // namespace ice
