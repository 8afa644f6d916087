// SPDX-License-Identifier: GPL-3.0-or-later
// Pattern "polygons": outlines of a file, cleaned, and refused where they overlap.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"
#include "preprocess/field/polygon_checks.hpp"
#include "preprocess/field/read_polygons.hpp"

namespace ice {

namespace {

// Depth of an overlap over the smaller floe's size [-] that is accepted: digitised neighbours share
// edges only nearly. The solver takes a deeper one as an initial overlap of two bodies.
constexpr double kOverlap = 1e-3;

// Scaled and moved, without repeated or straight corners, anticlockwise.
Outline cleaned(const FieldSpec& s, const NamedOutline& polygon) {
    Outline out;
    for (const Vec2& p : polygon.corners) {
        const Vec2 corner = s.scale * p + Vec2(s.origin[0], s.origin[1]);
        if (out.empty() || corner != out.back()) out.push_back(corner);
    }
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    const std::string where = s.file.string() + ": " + polygon.name;
    if (out.size() >= 3) out = without_straight_corners(out);
    if (out.size() < 3)
        throw bad_input(where, "has fewer than three corners", "complete or remove it");
    // Before the area's sign is used: it has no meaning for an outline that crosses itself.
    if (!is_simple(out)) throw bad_input(where, "crosses itself", "put its corners in order");
    if (area_of(out) < 0.0) std::reverse(out.begin(), out.end());
    return out;
}

// Pairs whose boxes meet, found along x.
void refuse_overlap(const FieldSpec& s, const std::vector<NamedOutline>& names,
                    const std::vector<Outline>& floes) {
    std::vector<Rectangle> boxes(floes.size());
    for (std::size_t k = 0; k < floes.size(); ++k)
        for (const Vec2& p : floes[k]) boxes[k].extend(p);
    std::vector<std::size_t> order(floes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) {
        return boxes[l].min().x() < boxes[r].min().x();
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const std::size_t a = order[i], b = order[j];
            // Sorted by the left side: all later boxes begin farther to the right.
            if (boxes[b].min().x() > boxes[a].max().x()) break;
            const double depth = overlap_depth(floes[a], floes[b]);
            if (depth > kOverlap * std::min(size_of(floes[a]), size_of(floes[b])))
                throw bad_input(
                    s.file.string() + ": " + names[std::min(a, b)].name,
                    fmt::format("overlaps {} by {:.3g} m", names[std::max(a, b)].name, depth),
                    "floes must lie beside each other: redraw one of them");
        }
}

}  // namespace

FieldPlan plan_polygons(const FieldSpec& s, std::vector<std::string>& warnings) {
    std::size_t holes = 0;
    const std::vector<NamedOutline> polygons = read_polygons(s.file, holes);
    if (holes > 0)
        warnings.push_back(fmt::format("{}: {} holes in polygons are filled: floes are solid",
                                       s.file.string(), holes));
    FieldPlan plan;
    // The field's area is the box of its floes: polygons state no other.
    for (const NamedOutline& polygon : polygons) {
        plan.loose.push_back(cleaned(s, polygon));
        for (const Vec2& p : plan.loose.back()) plan.area.extend(p);
    }
    refuse_overlap(s, polygons, plan.loose);
    return plan;
}

}  // namespace ice
