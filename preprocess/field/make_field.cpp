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
#include "preprocess/field/plan_floes.hpp"
#include "preprocess/field/prism.hpp"
#include "preprocess/fill/fill_spheres.hpp"

namespace ice {

namespace {

constexpr double kEqual = 1e-6;  // [m]
// Cosine of 6.3 degrees: the sides of an arc meet in edges and corners, too. Without them no sphere
// has the normals between two sides, and another piece's edge goes in there.
constexpr double kSharp = 0.994;
constexpr double kMostSpheres = 2e8;  // of all shapes together; 100 bytes each in the file

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

bool is_mirror_symmetric(const Outline& outline) {
    return std::all_of(outline.begin(), outline.end(), [&](const Vec2& p) {
        return std::any_of(outline.begin(), outline.end(), [&](const Vec2& q) {
            return (q - Vec2(p.x(), -p.y())).norm() < kEqual;
        });
    });
}

// Turns about x by a quarter: the middle plane of a prism, z = 0, becomes y = 0, and back.
Vec3 turned(const Vec3& p) { return {p.x(), -p.z() + 0.0, p.y()}; }
Vec3 turned_back(const Vec3& p) { return {p.x(), p.z(), -p.y() + 0.0}; }

// How a floe lies while it is filled.
//
// The fill makes half of what is symmetric about y = 0 and mirrors it, which takes half the time. A
// prism is symmetric about its middle plane: it is turned so that this one is y = 0, and back. One
// that is symmetric about y = 0 as it lies stays so, and its port and starboard spheres are alike.
//
// The shell is made in tiles of 32 spacings, and their corner is the origin. A floe about its
// centroid would lie in eight of them; it is moved into one.
class FillPose {
public:
    FillPose(const Outline& outline, double spacing)
        : turn_(!is_mirror_symmetric(outline)), move_(16.0 * spacing, 0.0, 16.0 * spacing) {}

    bool turns() const { return turn_; }
    Vec3 to(const Vec3& p) const { return (turn_ ? turned(p) : p) + move_; }
    Vec3 from(const Vec3& p) const { return turn_ ? turned_back(p - move_) : Vec3(p - move_); }
    Vec3 direction_from(const Vec3& d) const { return turn_ ? turned_back(d) : d; }

private:
    bool turn_;
    Vec3 move_;
};

// @param corners  becomes the number of the form's corners, each with a sphere of its own
SphereSet fill_form(const FieldSpec& spec, const Outline& outline, std::int64_t& corners) {
    FillOptions options;
    options.radius = spec.radius;
    options.spacing = spec.spacing;
    options.surface_only = spec.surface_only;
    options.quick = true;
    const FillPose pose(outline, spec.spacing);
    options.sharp = kSharp;
    options.edges_by_ends = pose.turns();  // the others are those of grids: a few for all floes
    TriangleMesh prism = make_prism(outline, spec.thickness, spec.chamfer);
    for (Vec3& vertex : prism.vertices) vertex = pose.to(vertex);
    SpheresReport report;
    SphereSet set = fill_spheres(prism, options, report);
    if (report.blind_corners > 0)
        throw bad_input("--radius",
                        fmt::format("{} of {} corners have no sphere that knows their three faces",
                                    report.blind_corners, report.corners),
                        "");
    corners = report.corners;
    for (Vec3& vertex : set.mesh.vertices) vertex = pose.from(vertex);
    for (Vec3& center : set.centers) center = pose.from(center);
    for (Vec3& normal : set.normals) normal = pose.direction_from(normal);
    for (CreaseNormal& crease : set.creases) crease.normal = pose.direction_from(crease.normal);
    set.solid = measure_mass(set.mesh);
    return set;
}

// Surface spheres: a hexagonal layer.
void refuse_too_many(const FieldSpec& spec, const std::vector<Outline>& outlines) {
    double surface = 0.0;
    for (const Outline& outline : outlines)
        surface += 2.0 * area_of(outline) + 4.0 * size_of(outline) * spec.thickness;
    const double count = 1.155 * surface / (spec.spacing * spec.spacing);
    if (count > kMostSpheres)
        throw bad_input(
            "spheres.spacing",
            fmt::format("{} shapes would take about {:.1g} spheres", outlines.size(), count),
            "use a larger spacing, or fewer floes");
}

std::vector<SphereSet> fill_forms(const FieldSpec& spec, const std::vector<Outline>& outlines,
                                  FieldReport& report) {
    refuse_too_many(spec, outlines);
    std::vector<SphereSet> shapes(outlines.size());
    std::vector<std::optional<Error>> errors(outlines.size());
    std::vector<std::int64_t> corners(outlines.size(), 0);
    parallel_tasks(outlines.size(), true, [&](std::size_t k) {
        try {
            shapes[k] = fill_form(spec, outlines[k], corners[k]);
        } catch (const Error& error) {
            errors[k] = error;
        }
    });
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        if (!errors[k]) continue;
        // what fill_spheres says about its own option stands behind "--radius: "
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
    field.shapes = fill_forms(spec, forms.outlines, report);
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
