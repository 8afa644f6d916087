// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/line_sources.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "solver/flow/equation_solver.hpp"
#include "solver/flow/flow_residual.hpp"
#include "solver/flow/own_functions.hpp"

namespace ice {

namespace {

// Flow at unit distance from a point source of strength 1 in the plane: 1 / (2 pi) [-].
constexpr double kPerCircle = 0.5 / std::numbers::pi;
// Lines along the wetted section where no length is given [-]. More are more exact, and their
// matrix grows with the square.
constexpr double kLinesAlong = 100.0;
// Least square of a distance [m2], at the very end of a line: its logarithm stays finite. No other
// point is so near, so that the value has no effect elsewhere.
constexpr double kLeastSquare = 1e-60;

FlowSample line_flow(const SourceLine& line, const Vec3& x) {
    // (23) without 1 / (2 pi): t ln(r_a / r_b) + theta n, where theta is the angle in which the
    // line is seen. The potential is its integral along x.
    const Vec3 a = x - line.from, b = x - line.to;
    const double log_a = own::log(std::max(a.x() * a.x() + a.z() * a.z(), kLeastSquare));
    const double log_b = own::log(std::max(b.x() * b.x() + b.z() * b.z(), kLeastSquare));
    const double height = a.x() * line.normal.x() + a.z() * line.normal.z();
    const double angle = own::half_plane_angle(std::abs(a.x() * b.z() - a.z() * b.x()),
                                               a.x() * b.x() + a.z() * b.z());
    const double through = height < 0.0 ? -angle : angle, slip = 0.5 * (log_a - log_b);
    const double from_a = a.x() * line.along.x() + a.z() * line.along.z();
    FlowSample out;
    out.velocity = Vec3(line.along.x() * slip + line.normal.x() * through, 0.0,
                        line.along.z() * slip + line.normal.z() * through);
    out.potential =
        0.5 * (from_a * log_a - (from_a - line.length) * log_b) - line.length + height * through;
    return out;
}

// With the image in the water's surface, for strength 1.
FlowSample imaged_flow(const SourceLine& line, const Vec3& x) {
    const FlowSample own = line_flow(line, x), image = line_flow(line, Vec3(x.x(), 0.0, -x.z()));
    FlowSample out;
    out.velocity = kPerCircle * Vec3(own.velocity.x() + image.velocity.x(), 0.0,
                                     own.velocity.z() - image.velocity.z());
    out.potential = kPerCircle * (own.potential + image.potential);
    return out;
}

// On the line at this share of its length, a little into the water.
Vec3 point_on(const SourceLine& line, double share) {
    return line.from + share * (line.to - line.from) + kOffPanel * line.length * line.normal;
}

void check_line_flow(LineFlow& flow) {
    std::vector<Vec3> points;
    for (const SourceLine& line : flow.lines)
        for (const double share : {0.25, 0.5, 0.75}) points.push_back(point_on(line, share));
    set_residual(
        flow, flow.lines, [](const SourceLine& line) { return line.length; }, Vec3::UnitX(),
        points);
}

}  // namespace

SourceLine make_line(const Vec3& from, const Vec3& to, const Vec3& normal) {
    const double length = (to - from).norm();
    return {from, to, (to - from) / length, normal, length};
}

std::vector<SourceLine> make_wetted_lines(const TriangleMesh& prism, double water, double longest) {
    std::vector<SourceLine> wet;
    // The section is the prism's outline: each side once, as far as it is under water.
    double low = std::numeric_limits<double>::infinity(), high = -low, first_y = low;
    for (const Vec3& v : prism.vertices) first_y = std::min(first_y, v.y());
    for (std::size_t t = 0; t < prism.triangles.size(); ++t) {
        const Vec3 normal = prism.area_vector(t).normalized();
        if (std::abs(normal.y()) > 0.5) continue;  // an end of the prism
        // each side has one triangle with an edge in the first end
        std::vector<Vec3> ends;
        for (int k = 0; k < 3; ++k)
            if (const Vec3 p = prism.corner(t, k); p.y() < first_y + 0.25)
                ends.emplace_back(p.x(), 0.0, p.z() - water);
        if (ends.size() != 2) continue;
        if (ends[0].z() > ends[1].z()) std::swap(ends[0], ends[1]);
        if (ends[0].z() >= 0.0) continue;
        // the line that crosses the water ends at z = 0
        if (ends[1].z() > 0.0) {
            ends[1] = ends[0] + ends[0].z() / (ends[0].z() - ends[1].z()) * (ends[1] - ends[0]);
            ends[1].z() = 0.0;
        }
        wet.push_back(make_line(ends[0], ends[1], normal));
        for (const Vec3& p : ends) {
            low = std::min(low, p.x());
            high = std::max(high, p.x());
        }
    }
    if (wet.empty())
        throw bad_input("the hull", "has nothing under water",
                        "give a draught above 0, or a mesh that reaches below z = 0");
    if (longest <= 0.0) longest = (high - low) / kLinesAlong;
    std::vector<SourceLine> out;
    // parts of equal length: a strength that is constant on each follows the curve of the flow
    for (const SourceLine& line : wet) {
        const int parts = static_cast<int>(std::ceil(line.length / longest));
        for (int k = 0; k < parts; ++k)
            out.push_back(make_line(line.from + (line.to - line.from) * k / parts,
                                    line.from + (line.to - line.from) * (k + 1) / parts,
                                    line.normal));
    }
    return out;
}

LineFlow solve_lines(std::vector<SourceLine> lines) {
    LineFlow flow;
    flow.lines = std::move(lines);
    const auto n = static_cast<Eigen::Index>(flow.lines.size());
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXd right(n);
    // No flow through each line in the mean of two Gauss points, exact for a cubic; docs/method.md,
    // section 6, has the same condition for triangles.
    const double gauss = 0.5 / std::sqrt(3.0);
    parallel_for(flow.lines.size(), 16, [&](std::size_t i) {
        const SourceLine& target = flow.lines[i];
        const auto row = static_cast<Eigen::Index>(i);
        right[row] = target.normal.x();
        for (Eigen::Index j = 0; j < n; ++j) {
            double flux = 0.0;
            for (const double share : {0.5 - gauss, 0.5 + gauss})
                flux +=
                    imaged_flow(flow.lines[static_cast<std::size_t>(j)], point_on(target, share))
                        .velocity.dot(target.normal);
            matrix(row, j) = 0.5 * flux;
        }
    });
    // Not symmetric but well conditioned (a Fredholm equation of the second kind): an iteration
    // takes a few tens of products where elimination takes n.
    Eigen::BiCGSTAB<Eigen::MatrixXd, Eigen::IdentityPreconditioner> solver(matrix);
    solver.setTolerance(kSolverTolerance);
    solver.setMaxIterations(kMostIterations);
    const Eigen::VectorXd strength = solver.solve(right);
    if (solver.info() != Eigen::Success)
        throw run_failed("the flow around the hull",
                         fmt::format("has no solution within {} iterations", kMostIterations),
                         "look for thin parts of the section, or set flow.model = \"none\"");
    flow.strength.assign(strength.data(), strength.data() + n);
    check_line_flow(flow);
    return flow;
}

std::vector<FlowSample> flow_at(const LineFlow& flow, std::span<const Vec3> points) {
    std::vector<FlowSample> out(points.size());
    parallel_for(points.size(), 16, [&](std::size_t i) {
        for (std::size_t j = 0; j < flow.lines.size(); ++j) {
            const FlowSample f = imaged_flow(flow.lines[j], points[i]);
            out[i].velocity += flow.strength[j] * f.velocity;
            out[i].potential += flow.strength[j] * f.potential;
        }
    });
    return out;
}

}  // namespace ice
