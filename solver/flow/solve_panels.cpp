// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/solve_panels.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "solver/flow/equation_solver.hpp"
#include "solver/flow/flow_residual.hpp"

namespace ice {

namespace {

constexpr std::size_t kBlock = FluxTargets::kCount;
// Points that a thread takes at a time [-]: fewer cost more hand-overs, more leave threads waiting
// at the end. Results do not depend on it.
constexpr std::size_t kPoints = 64;

// Eight panels from `first` on; beyond the last the last once more.
FluxTargets targets_of(const std::vector<SourcePanel>& panels, std::size_t first) {
    FluxTargets out;
    for (std::size_t i = 0; i < kBlock; ++i) {
        const SourcePanel& p = panels[std::min(first + i, panels.size() - 1)];
        const auto points = flux_points(p);
        for (std::size_t q = 0; q < 3; ++q) {
            out.x[q][i] = points[q].x();
            out.y[q][i] = points[q].y();
            out.z[q][i] = points[q].z();
        }
        out.nx[i] = p.normal.x();
        out.ny[i] = p.normal.y();
        out.nz[i] = p.normal.z();
    }
    return out;
}

// Mean normal velocity through panel i (row) from panel j.
Eigen::MatrixXd influence(const PanelBody& body) {
    const auto& panels = body.panels;
    const auto n = static_cast<Eigen::Index>(panels.size());
    Eigen::MatrixXd out(n, n);
    parallel_tasks((panels.size() + kBlock - 1) / kBlock, true, [&](std::size_t block) {
        std::vector<double> flux(kBlock * panels.size());
        mean_fluxes(body, targets_of(panels, kBlock * block), flux);
        const auto first = static_cast<Eigen::Index>(kBlock * block);
        const Eigen::Index rows = std::min<Eigen::Index>(kBlock, n - first);
        // Eight rows at a time, the lanes of the kernel: a thread writes rows of its own block
        // only.
        out.middleRows(first, rows) =
            Eigen::Map<const Eigen::MatrixXd>(flux.data(), kBlock, n).topRows(rows);
    });
    return out;
}

// At other points than those of the solution: there the residual is only that of the iteration, not
// that of the panels.
void check_flow(const Vec3& direction, PanelFlow& flow) {
    std::vector<Vec3> points;
    for (const SourcePanel& p : flow.body.panels)
        for (const Vec3& at : check_points(p)) points.push_back(at);
    set_residual(
        flow, flow.body.panels, [](const SourcePanel& p) { return p.area; }, direction, points);
}

}  // namespace

Eigen::MatrixXd solve_strengths(const PanelBody& body, const Eigen::MatrixXd& wanted,
                                int* iterations) {
    const Eigen::MatrixXd matrix = influence(body);
    // The integral equation is of the second kind, so the matrix is well conditioned: the iteration
    // needs no preconditioner and far fewer products than an elimination.
    Eigen::BiCGSTAB<Eigen::MatrixXd, Eigen::IdentityPreconditioner> solver(matrix);
    solver.setTolerance(kSolverTolerance);
    solver.setMaxIterations(kMostIterations);
    Eigen::MatrixXd out(wanted.rows(), wanted.cols());
    for (Eigen::Index k = 0; k < wanted.cols(); ++k) {
        const Eigen::VectorXd right = wanted.col(k);
        const Eigen::VectorXd strength = solver.solve(right);
        if (iterations != nullptr) *iterations = static_cast<int>(solver.iterations());
        if (solver.info() != Eigen::Success)
            throw run_failed("the flow around the hull",
                             fmt::format("has no solution within {} iterations", kMostIterations),
                             "look for thin plates and faces that cross in the mesh, or set "
                             "flow.model = \"none\"");
        out.col(k) = strength;
    }
    return out;
}

PanelFlow solve_panels(PanelBody body, const Vec3& direction) {
    PanelFlow flow;
    flow.body = std::move(body);
    const auto n = static_cast<Eigen::Index>(flow.body.panels.size());
    Eigen::VectorXd right(n);
    // the normal velocity that a unit speed of the hull gives to each panel
    for (Eigen::Index i = 0; i < n; ++i)
        right[i] = flow.body.panels[static_cast<std::size_t>(i)].normal.dot(direction);
    const Eigen::MatrixXd strength = solve_strengths(flow.body, right, &flow.iterations);
    flow.strength.assign(strength.data(), strength.data() + n);
    check_flow(direction, flow);
    return flow;
}

std::vector<FlowSample> flow_at(const PanelFlow& flow, std::span<const Vec3> points) {
    std::vector<FlowSample> out(points.size());
    parallel_tasks((points.size() + kPoints - 1) / kPoints, true, [&](std::size_t k) {
        const std::size_t first = kPoints * k, count = std::min(kPoints, points.size() - first);
        sum_panels(flow.body, flow.strength, points.subspan(first, count),
                   std::span(out).subspan(first, count));
    });
    return out;
}

}  // namespace ice
