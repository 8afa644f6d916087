// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/make_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "common/formats/hexagonal_layer.hpp"
#include "preprocess/field/fill_prism.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

namespace {

// Spheres of all shapes together at most [-]: 100 bytes each in the file, 20 GB. A larger value
// begins fills that run out of memory after hours, a smaller one refuses fields that have room.
constexpr double kMostSpheres = 2e8;

// Outlines about their centroids, each shape once, and which of them every floe has.
struct Shapes {
    std::vector<Outline> outlines;
    std::vector<Vec2> centres;          // of the floes
    std::vector<std::int32_t> of_floe;  // row of outlines
};

class ShapeTable {
public:
    void add(const Outline& outline) {
        const Vec2 centre = centroid_of(outline);
        Outline centred;
        std::vector<std::int64_t> key;
        for (const Vec2& corner : outline) {
            centred.push_back(corner - centre);
            // to a micrometre: shapes that differ by rounding are one
            for (int d = 0; d < 2; ++d)
                key.push_back(std::llround(centred.back()[d] / kEqualCorners));
        }
        const auto [found, fresh] =
            rows_.try_emplace(key, static_cast<std::int32_t>(shapes_.outlines.size()));
        if (fresh) shapes_.outlines.push_back(centred);
        shapes_.centres.push_back(centre);
        shapes_.of_floe.push_back(found->second);
    }
    Shapes take() { return std::move(shapes_); }

private:
    Shapes shapes_;
    std::map<std::vector<std::int64_t>, std::int32_t> rows_;
};

// Surface spheres: a hexagonal layer.
void refuse_too_many(const FieldSpec& spec, const std::vector<Outline>& outlines) {
    double surface = 0.0;
    for (const Outline& outline : outlines)
        // both faces, and a side around them of some four sizes
        surface += 2.0 * area_of(outline) + 4.0 * size_of(outline) * spec.thickness;
    // Refused before the fill, which would run for hours and then out of memory.
    const double count = kHexagonal * surface / (spec.spacing * spec.spacing);
    if (count > kMostSpheres)
        throw bad_input(
            "spheres.spacing",
            fmt::format("{} shapes would take about {:.1g} spheres", outlines.size(), count),
            "use a larger spacing, or fewer floes");
}

std::vector<SphereSet> fill_shapes(const FieldSpec& spec, const std::vector<Outline>& outlines,
                                   FieldReport& report) {
    refuse_too_many(spec, outlines);
    const PrismSpec prism{spec.thickness, spec.chamfer, spec.radius, spec.spacing,
                          spec.surface_only};
    std::vector<SphereSet> shapes(outlines.size());
    std::vector<std::optional<Error>> errors(outlines.size());
    std::vector<std::int64_t> corners(outlines.size(), 0);
    // no exception may leave a thread: the first floe's is thrown afterwards
    parallel_tasks(outlines.size(), true, [&](std::size_t k) {
        try {
            shapes[k] = fill_prism(outlines[k], prism, &corners[k]);
        } catch (const Error& error) {
            errors[k] = error;
        }
    });
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        if (!errors[k]) continue;
        // the message of fill_spheres begins with its own option, "--radius: ", which is cut off
        const std::string what = errors[k]->what();
        throw bad_input("spheres.radius",
                        fmt::format("a floe of size {:.4g} m cannot be filled: {}",
                                    size_of(outlines[k]), what.substr(what.find(": ") + 2)),
                        "use smaller spheres or larger floes");
    }
    report.corners = std::accumulate(corners.begin(), corners.end(), std::int64_t{0});
    return shapes;
}

void measure_field(const FieldPlan& plan, const Field& field, FieldReport& report) {
    report.floes = plan.loose.size();
    report.fixed = plan.fixed.size();
    report.shapes = field.shapes.size();
    for (const FieldFloe& floe : field.floes) {
        const SphereSet& shape = field.shapes[static_cast<std::size_t>(floe.shape)];
        report.spheres += shape.size();
        report.surface_spheres += shape.surface_count;
    }
    report.smallest = std::numeric_limits<double>::infinity();
    double ice = 0.0, sizes = 0.0;
    for (const Outline& floe : plan.loose) {
        const double size = size_of(floe);
        ice += area_of(floe);
        sizes += size;
        report.smallest = std::min(report.smallest, size);
        report.largest = std::max(report.largest, size);
    }
    // Of the loose floes in the field's area; volume() of a rectangle is its area.
    report.concentration = ice / plan.area.volume();
    report.mean_size = sizes / static_cast<double>(plan.loose.size());
}

}  // namespace

FieldPlan plan_field(const FieldSpec& spec, std::vector<std::string>& warnings) {
    FieldPlan plan;
    switch (spec.pattern) {
        case FieldPattern::grid:
        case FieldPattern::brick:
            plan = plan_grid(spec);
            break;
        case FieldPattern::cusps:
            plan = plan_cusps(spec);
            break;
        case FieldPattern::voronoi:
        case FieldPattern::power_law:
            plan = plan_cells(spec);
            break;
        case FieldPattern::polygons:
            plan = plan_polygons(spec, warnings);
            break;
    }
    // Unbroken ice comes last: it lies around whatever area the loose floes take.
    add_edges(spec, plan);
    return plan;
}

Field make_field(const FieldSpec& spec, const FieldPlan& plan, FieldReport& report) {
    const Timer timer;
    ShapeTable table;
    // floes of one shape share their spheres; loose ones come first, and so have the lower numbers
    for (const Outline& floe : plan.loose) table.add(floe);
    for (const Outline& floe : plan.fixed) table.add(floe);
    const Shapes distinct = table.take();

    Field field;
    field.radius = spec.radius;
    field.spacing = spec.spacing;
    field.mode = spec.surface_only ? "surface" : "fill";
    field.area = {plan.area.min().x(), plan.area.min().y(), plan.area.max().x(),
                  plan.area.max().y()};
    field.specification = spec.text;
    field.seed = spec.seed;
    field.shapes = fill_shapes(spec, distinct.outlines, report);
    for (std::size_t k = 0; k < distinct.of_floe.size(); ++k) {
        FieldFloe floe;
        floe.shape = distinct.of_floe[k];
        floe.position = {distinct.centres[k].x(), distinct.centres[k].y()};
        floe.fixed = k >= plan.loose.size();
        field.floes.push_back(floe);
    }
    measure_field(plan, field, report);
    field.concentration = report.concentration;
    report.fill_seconds = timer.seconds();
    return field;
}

}  // namespace ice
