// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/flow_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/base/timer.hpp"
#include "common/geometry/closest_on_triangle.hpp"
#include "common/geometry/winding_number.hpp"
#include "solver/flow/line_sources.hpp"
#include "solver/flow/solve_panels.hpp"
#include "solver/flow/wetted_panels.hpp"

namespace ice {

namespace {

// Faster flow than this many ship speeds [-] is slowed down to it: at a sharp edge ideal flow has
// no bound. Larger lets single nodes at an edge throw small floes; smaller cuts into flow that is
// right, such as that at a bluff bow (1 at its stagnation point).
constexpr double kMostSpeed = 1.2;
// Share of the margin in which the flow fades to 0 [-]. Less makes the edge of the table steeper,
// which a floe feels as a force; more takes flow away near the hull.
constexpr double kFade = 1.0 / 3.0;
// Nodes of a table where no spacing is given, in 3D and in 2D; more than the last are refused: a
// node has four floats, so 320 MB. Twice the nodes take twice the time and halve a node's volume.
constexpr double kNodes = 3e5, kNodes2D = 1e4, kMostNodes = 2e7;
// Lines of a section; half as many panels of a hull. Their matrix is stored whole: 512 MB for 8000
// lines, 128 MB for 4000 panels.
constexpr std::size_t kMostPanels = 8000;
// Residual above which a flow is worth a warning [-]: hulls with sharp edges have 2 to 4 %, smooth
// ones 1 %. Only the warning depends on it.
constexpr double kWorryingResidual = 0.05;
// Net source over the sum of all sources' amounts [-]: above it the hull is not closed, or its
// panels are too large. Only the warning depends on it.
constexpr double kWorryingFlux = 0.005;
// Nodes in the hull take the flow this far off its surface [spacings]. Smaller takes it nearer to
// the panels, where it is rough by their edges; larger takes that of water farther away.
constexpr double kOffSurface = 0.1;

// The hull as the table sees it.
struct Sources {
    Vec3 low, high;       // box of the wetted hull [m]
    double margin = 0.0;  // of the table around that box [m]
    std::function<std::vector<FlowSample>(std::span<const Vec3>)> flow_at;
    std::function<Vec3(const Vec3&, double)> off_surface;  // near a point, so far off [m]
};

void lay_grid(const Sources& s, bool plane, const FlowOptions& options, FlowTable& out) {
    double spacing = options.spacing;
    // The coarsest grid within the bound on nodes that still resolves half a floe's thickness.
    const Vec3 low = s.low - Vec3::Constant(s.margin), high = s.high + Vec3::Constant(s.margin);
    const double length = high.x() - low.x(), depth = -low.z();
    // a symmetric hull has one half in the table; look_up_flow mirrors the other
    const double breadth = out.symmetric ? high.y() : high.y() - low.y();
    if (spacing <= 0.0)
        spacing = std::max(options.finest, plane ? std::sqrt(length * depth / kNodes2D)
                                                 : std::cbrt(length * breadth * depth / kNodes));
    out.spacing = spacing;
    const auto steps = [&](double extent) { return std::ceil(extent / spacing); };
    const double ny = plane ? 1.0 : steps(breadth) + 1.0;
    if ((steps(length) + 1.0) * ny * (steps(depth) + 1.0) > kMostNodes)
        throw bad_input("spacing",
                        fmt::format("{:g} m gives more than {:g} nodes", spacing, kMostNodes),
                        "give a larger one");
    out.nodes = {static_cast<std::int64_t>(steps(length)) + 1, static_cast<std::int64_t>(ny),
                 static_cast<std::int64_t>(steps(depth)) + 1};
    out.origin = Vec3(low.x(), out.symmetric || plane ? 0.0 : low.y(), -spacing * steps(depth));
}

// 1 within, 0 at the rim, and smooth: the cubic with level ends, so that the flow's slope has no
// jump, either. @param from_rim, width  [m]
double fade(double from_rim, double width) {
    const double s = std::clamp(from_rim / width, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
}

double fade_at(const FlowTable& t, const Vec3& p, double width) {
    const Vec3 high = t.origin + t.spacing * Vec3(double(t.nodes[0] - 1), double(t.nodes[1] - 1),
                                                  double(t.nodes[2] - 1));
    // a product: in the corners of the table it fades along all axes
    double out = fade(p.x() - t.origin.x(), width) * fade(high.x() - p.x(), width) *
                 fade(p.z() - t.origin.z(), width);
    if (t.nodes[1] > 1) out *= fade(high.y() - p.y(), width);
    // the rim of a half table in y = 0 is no rim
    if (t.nodes[1] > 1 && !t.symmetric) out *= fade(p.y() - t.origin.y(), width);
    return out;
}

void fill_row(const Sources& s, const WindingNumber& hull, double water, std::size_t row,
              FlowTable& t) {
    const auto nx = static_cast<std::size_t>(t.nodes[0]), ny = static_cast<std::size_t>(t.nodes[1]);
    const std::size_t j = row % ny, k = row / ny;
    std::vector<Vec3> at(nx), points(nx);
    for (std::size_t i = 0; i < nx; ++i) {
        at[i] = t.origin + t.spacing * Vec3(double(i), double(j), double(k));
        const bool in_box =
            ((at[i] - s.low).array() >= 0.0).all() && ((s.high - at[i]).array() >= 0.0).all();
        // Inside the hull the sources' sum has no meaning; the nearest flow outside keeps the
        // interpolation at the hull right.
        const bool inside = in_box && hull.contains(at[i] + Vec3(0, 0, water));
        points[i] = inside ? s.off_surface(at[i], kOffSurface * t.spacing) : at[i];
    }
    const auto flow = s.flow_at(points);
    for (std::size_t i = 0; i < nx; ++i) {
        const double speed = flow[i].velocity.norm();
        // Faded to zero at the rim, so that a floe that enters the table feels no jump.
        const double share = fade_at(t, at[i], kFade * s.margin);
        const Vec3 w =
            share * std::min(1.0, kMostSpeed / std::max(speed, 1e-300)) * flow[i].velocity;
        for (int axis = 0; axis < 3; ++axis)
            t.velocity[3 * (row * nx + i) + static_cast<std::size_t>(axis)] =
                static_cast<float>(w[axis]);
        t.potential[row * nx + i] = static_cast<float>(share * flow[i].potential);
    }
}

void fill_table(const Sources& s, const TriangleMesh& mesh, const FlowOptions& options,
                HullFlow& out) {
    // Row by row along x, by all threads: a row writes its own nodes only.
    const Timer timer;
    FlowTable& t = out.table;
    t.velocity.resize(3 * t.size());
    t.potential.resize(t.size());
    const WindingNumber hull(mesh);
    parallel_tasks(static_cast<std::size_t>(t.nodes[1] * t.nodes[2]), true,
                   [&](std::size_t row) { fill_row(s, hull, options.water, row, t); });
    out.table_seconds = timer.seconds();
}

// The point of the panels nearest to p, a little into the water.
Vec3 off_panels(const PanelBody& body, const Vec3& p, double off) {
    double least = std::numeric_limits<double>::infinity();
    Vec3 nearest = p;
    for (const SourcePanel& panel : body.panels) {
        // A sphere around the panel rules most of them out before the exact distance.
        const double radius = std::sqrt(panel.far_squared) / kFarRadii;
        const double from_centre = (panel.centre - p).norm();
        if (from_centre - radius >= least) continue;
        const Vec3 on =
            closest_on_triangle(p, panel.corner[0], panel.corner[1], panel.corner[2]).point;
        if (const double d = (on - p).norm(); d < least) {
            least = d;
            nearest = on + off * panel.normal;
        }
    }
    return nearest;
}

Vec3 off_lines(const std::vector<SourceLine>& lines, const Vec3& p, double off) {
    double least = std::numeric_limits<double>::infinity();
    Vec3 nearest = p;
    for (const SourceLine& line : lines) {
        const double share = std::clamp((p - line.from).dot(line.along), 0.0, line.length);
        const Vec3 on = line.from + share * line.along;
        if (const double d = (on - p).norm(); d < least) {
            least = d;
            nearest = on + off * line.normal;
        }
    }
    return nearest;
}

template <class Flow>
void note(const Flow& flow, HullFlow& out) {
    out.table.residual = flow.residual;
    out.worst = flow.worst;
    out.worst_place = flow.worst_place;
    out.net_flux = flow.net_flux;
}

void make_3d(const TriangleMesh& mesh, const FlowOptions& options, HullFlow& out) {
    const Timer timer;
    // half of the panels, since a symmetric hull's other half are images
    WettedHull hull = make_wetted_hull(mesh, options.water, {options.panel, kMostPanels / 2});
    const PanelFlow flow = solve_panels(std::move(hull.body));
    out.solve_seconds = timer.seconds();
    out.panel = hull.longest_edge;
    out.table.panels = static_cast<std::int64_t>(flow.body.panels.size());
    out.table.symmetric = flow.body.symmetric;
    note(flow, out);
    // the table reaches a breadth beyond the hull on all sides
    Sources s{hull.low, hull.high, hull.high.y() - hull.low.y(),
              [&](std::span<const Vec3> points) {
                  std::vector<FlowSample> samples(points.size());
                  sum_panels(flow.body, flow.strength, points, samples);
                  return samples;
              },
              [&](const Vec3& p, double off) { return off_panels(flow.body, p, off); }};
    out.length = s.high.x() - s.low.x();
    if (!options.table) return;
    lay_grid(s, false, options, out.table);
    fill_table(s, mesh, options, out);
}

void make_2d(const TriangleMesh& prism, const FlowOptions& options, HullFlow& out) {
    const Timer timer;
    auto lines = make_wetted_lines(prism, options.water, options.panel);
    if (lines.size() > kMostPanels)
        throw bad_input("panel size", fmt::format("gives more than {} lines", kMostPanels),
                        "allow longer ones");
    const LineFlow flow = solve_lines(std::move(lines));
    out.solve_seconds = timer.seconds();
    out.table.panels = static_cast<std::int64_t>(flow.lines.size());
    note(flow, out);
    const Vec3 beyond = Vec3::Constant(std::numeric_limits<double>::infinity());
    Sources s{beyond, -beyond, 0.0,
              [&](std::span<const Vec3> points) { return flow_at(flow, points); },
              [&](const Vec3& p, double off) { return off_lines(flow.lines, p, off); }};
    // a section's box from its lines; y is 0
    for (const SourceLine& line : flow.lines) {
        out.panel = std::max(out.panel, line.length);
        for (const Vec3& p : {line.from, line.to}) {
            s.low = s.low.cwiseMin(p);
            s.high = s.high.cwiseMax(p);
        }
    }
    // a section has no breadth: the table extends twice its draught around it
    s.margin = 2.0 * (s.high.z() - s.low.z());
    out.length = s.high.x() - s.low.x();
    if (!options.table) return;
    lay_grid(s, true, options, out.table);
    fill_table(s, prism, options, out);
}

}  // namespace

HullFlow make_hull_flow(const TriangleMesh& hull, int dimension, const FlowOptions& options) {
    HullFlow out;
    // the water is `water` above the mesh's origin, the keel its lowest vertex
    double keel = std::numeric_limits<double>::infinity();
    for (const Vec3& v : hull.vertices) keel = std::min(keel, v.z());
    out.table.draught = options.water - keel;
    if (dimension == 2)
        make_2d(hull, options, out);
    else
        make_3d(hull, options, out);
    return out;
}

std::vector<std::string> warnings_of(const HullFlow& flow) {
    std::vector<std::string> out;
    const Vec3& at = flow.worst_place;
    if (flow.table.residual > kWorryingResidual)
        out.push_back(fmt::format(
            "flow: velocity through the hull is {:.1f} % of the ship's speed (rms), most at "
            "({:.2f}, {:.2f}, {:.2f}) m: use smaller panels, or leave thin plates out (iceflow "
            "--without)",
            100.0 * flow.table.residual, at.x(), at.y(), at.z()));
    if (std::abs(flow.net_flux) > kWorryingFlux)
        out.push_back(
            fmt::format("flow: sources and sinks differ by {:.2f} % of all sources: the hull "
                        "is not closed, or its panels are too large",
                        100.0 * std::abs(flow.net_flux)));
    return out;
}

}  // namespace ice
