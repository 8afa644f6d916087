// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/fit_cells.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// Newton steps at most [-]. Near the solution full steps square the error; where 60 do not reach
// it, the cells stay as near as they came. Fewer leave more fits unfinished, more take longer where
// none is found.
constexpr int kMostSteps = 60;
// Shortest share of a Newton step that is tried [-]; the fit ends where it brings nothing. A larger
// value ends difficult fits early, a smaller one tries more cells without success.
constexpr double kSmallestStep = 1e-4;

struct State {
    std::vector<PowerCell> cells;
    Eigen::VectorXd lack;   // wanted - area
    double smallest = 0.0;  // area of a cell
};

State measure(const std::vector<Vec2>& sites, const std::vector<double>& areas,
              const Rectangle& rectangle, const std::vector<double>& weights) {
    State state;
    state.cells = power_cells(sites, weights, rectangle);
    state.lack.resize(static_cast<Eigen::Index>(sites.size()));
    state.smallest = rectangle.volume();
    for (std::size_t k = 0; k < sites.size(); ++k) {
        const double area = state.cells[k].corners.empty() ? 0.0 : area_of(state.cells[k].corners);
        state.lack[static_cast<Eigen::Index>(k)] = areas[k] - area;
        state.smallest = std::min(state.smallest, area);
    }
    return state;
}

// Change of the weights that would close the lack if areas were linear in them. Weights count up
// to a constant only: the first keeps its own.
Eigen::VectorXd newton_step(const std::vector<Vec2>& sites, const State& state) {
    const auto n = static_cast<Eigen::Index>(sites.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index i = 0; i < n; ++i) {
        const PowerCell& cell = state.cells[static_cast<std::size_t>(i)];
        double sum = 0.0;
        for (std::size_t k = 0; k < cell.corners.size(); ++k) {
            const Eigen::Index j = cell.neighbours[k];
            if (j < 0) continue;
            const double edge =
                (cell.corners[(k + 1) % cell.corners.size()] - cell.corners[k]).norm();
            const double apart =
                (sites[static_cast<std::size_t>(j)] - sites[static_cast<std::size_t>(i)]).norm();
            // the common edge moves by 1 / (2 apart) for a unit of weight, and its length
            // sweeps the area
            const double slope = 0.5 * edge / apart;
            sum += slope;
            if (i > 0 && j > 0 && j < i) entries.emplace_back(i - 1, j - 1, -slope);
        }
        if (i > 0) entries.emplace_back(i - 1, i - 1, sum);
    }
    // with a column for every site the matrix would be singular: a constant on all weights
    // moves no edge
    Eigen::SparseMatrix<double> matrix(n - 1, n - 1);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);  // lower triangle
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    if (solver.info() == Eigen::Success) step.tail(n - 1) = solver.solve(state.lack.tail(n - 1));
    return step;
}

}  // namespace

std::vector<PowerCell> fit_cells(const std::vector<Vec2>& sites, const std::vector<double>& areas,
                                 const Rectangle& rectangle, double tolerance,
                                 std::vector<double>& weights) {
    const double least = *std::min_element(areas.begin(), areas.end());
    State now = measure(sites, areas, rectangle, weights);
    if (!(now.smallest > 0.0)) {
        std::fill(weights.begin(), weights.end(), 0.0);
        now = measure(sites, areas, rectangle, weights);
    }
    // A cell that vanishes has no edges left, and the matrix has no entry to bring it
    // back.
    const double floor = 0.5 * std::min(least, now.smallest);
    for (int step = 0; step < kMostSteps && sites.size() > 1; ++step) {
        // relative to the smallest wanted area: a small floe's error must not hide behind a large
        // one's
        const double error = now.lack.cwiseAbs().maxCoeff();
        if (error <= tolerance * least) break;
        const Eigen::VectorXd change = newton_step(sites, now);
        bool better = false;
        for (double length = 1.0; length >= kSmallestStep && !better; length *= 0.5) {
            std::vector<double> trial = weights;
            for (std::size_t k = 0; k < trial.size(); ++k)
                trial[k] += length * change[static_cast<Eigen::Index>(k)];
            State next = measure(sites, areas, rectangle, trial);
            // a full step would close the whole lack if areas were linear in the weights; half
            // of that is enough
            better = next.smallest >= floor &&
                     next.lack.norm() <= (1.0 - 0.5 * length) * now.lack.norm();
            if (!better) continue;
            now = std::move(next);
            weights = std::move(trial);
        }
        if (!better) break;  // rounding
    }
    return now.cells;
}

}  // namespace ice
