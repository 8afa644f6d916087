// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/make_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "preprocess/field/plan_floes.hpp"
#include "preprocess/field/prism.hpp"
#include "preprocess/fill/fill_spheres.hpp"

namespace ice {

namespace {

constexpr double kEqual = 1e-6;  // [m]

// Outlines about their centroids, each form once, and which of them every floe has.
struct Forms {
    std::vector<Outline> outlines;
    std::vector<Vec2> centres;          // of the floes
    std::vector<std::int32_t> of_floe;  // row of outlines
};

class FormTable {
public:
    void add(const Outline& outline) {
        const Vec2 centre = centroid_of(outline);
        Outline form;
        std::vector<std::int64_t> key;
        for (const Vec2& corner : outline) {
            form.push_back(corner - centre);
            for (int d = 0; d < 2; ++d) key.push_back(std::llround(form.back()[d] / kEqual));
        }
        const auto [found, fresh] =
            rows_.try_emplace(key, static_cast<std::int32_t>(forms_.outlines.size()));
        if (fresh) forms_.outlines.push_back(form);
        forms_.centres.push_back(centre);
        forms_.of_floe.push_back(found->second);
    }
    Forms take() { return std::move(forms_); }

private:
    Forms forms_;
    std::map<std::vector<std::int64_t>, std::int32_t> rows_;
};

std::vector<SphereSet> fill_forms(const FieldSpec& spec, const std::vector<Outline>& outlines) {
    FillOptions options;
    options.radius = spec.radius;
    options.spacing = spec.spacing;
    options.surface_only = spec.surface_only;
    options.certificate = false;
    std::vector<SphereSet> shapes(outlines.size());
    std::vector<std::optional<Error>> errors(outlines.size());
    parallel_tasks(outlines.size(), true, [&](std::size_t k) {
        try {
            SpheresReport unused;
            const TriangleMesh prism = make_prism(outlines[k], spec.thickness, spec.chamfer);
            shapes[k] = fill_spheres(prism, options, unused);
        } catch (const Error& error) {
            errors[k] = error;
        }
    });
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        if (!errors[k]) continue;
        const double size = size_of(outlines[k]);
        throw bad_input(
            "spheres.radius",
            fmt::format("a floe of size {:.4g} m cannot be filled: {}", size, errors[k]->what()),
            "use smaller spheres, or larger floes");
    }
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
    add_edges(spec, plan);
    return plan;
}

Field make_field(const FieldSpec& spec, const FieldPlan& plan, FieldReport& report) {
    const Timer timer;
    FormTable table;
    for (const Outline& floe : plan.loose) table.add(floe);
    for (const Outline& floe : plan.fixed) table.add(floe);
    const Forms forms = table.take();

    Field field;
    field.radius = spec.radius;
    field.spacing = spec.spacing;
    field.mode = spec.surface_only ? "surface" : "fill";
    field.area = {plan.area.min().x(), plan.area.min().y(), plan.area.max().x(),
                  plan.area.max().y()};
    field.specification = spec.text;
    field.seed = spec.seed;
    field.shapes = fill_forms(spec, forms.outlines);
    for (std::size_t k = 0; k < forms.of_floe.size(); ++k) {
        FieldFloe floe;
        floe.shape = forms.of_floe[k];
        floe.position = {forms.centres[k].x(), forms.centres[k].y()};
        floe.fixed = k >= plan.loose.size();
        field.floes.push_back(floe);
    }
    measure_field(plan, field, report);
    field.concentration = report.concentration;
    report.fill_seconds = timer.seconds();
    return field;
}

}  // namespace ice
