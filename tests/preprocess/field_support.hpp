// SPDX-License-Identifier: GPL-3.0-or-later
/// Specifications from text, and slow ways to look at a field.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "preprocess/field/make_field.hpp"
#include "tests/support/temporary_file.hpp"

namespace ice::test {

inline FieldSpec field_spec(const std::string& text) {
    const TemporaryFile file(".toml", text);
    return read_field_spec(file.path(), {});
}

inline FieldPlan field_plan(const std::string& text) {
    std::vector<std::string> warnings;
    return plan_field(field_spec(text), warnings);
}

inline double total_area(const std::vector<Outline>& floes) {
    double sum = 0.0;
    for (const Outline& floe : floes) sum += area_of(floe);
    return sum;
}

/// Overlap of two convex outlines by separating axes [m]; negative: the gap along the best one.
inline double convex_overlap(const Outline& a, const Outline& b) {
    double least = std::numeric_limits<double>::infinity();
    for (const Outline* one : {&a, &b})
        for (std::size_t k = 0; k < one->size(); ++k) {
            const Vec2 p = (*one)[k], edge = (*one)[(k + 1) % one->size()] - p;
            const Vec2 out = Vec2(edge.y(), -edge.x()).normalized();
            double inside = -std::numeric_limits<double>::infinity();
            for (const Vec2& q : one == &a ? b : a) inside = std::max(inside, out.dot(p - q));
            least = std::min(least, inside);
        }
    return least;
}

/// Calls body(i, j) for all pairs whose boxes meet: i < j in the order of least x.
template <class Body>
void for_near_pairs(std::vector<Outline> floes, const Body& body) {
    const auto low = [](const Outline& floe) {
        double x = floe[0].x();
        for (const Vec2& p : floe) x = std::min(x, p.x());
        return x;
    };
    std::sort(floes.begin(), floes.end(),
              [&](const Outline& l, const Outline& r) { return low(l) < low(r); });
    std::vector<Rectangle> boxes(floes.size());
    for (std::size_t k = 0; k < floes.size(); ++k)
        for (const Vec2& p : floes[k]) boxes[k].extend(p);
    for (std::size_t i = 0; i < floes.size(); ++i)
        for (std::size_t j = i + 1; j < floes.size(); ++j) {
            if (boxes[j].min().x() > boxes[i].max().x()) break;
            if (boxes[i].intersects(boxes[j])) body(floes[i], floes[j]);
        }
}

}  // namespace ice::test
