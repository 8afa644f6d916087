// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/inscribed.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Cells at the beginning, at most [-]. More split a slender box finer and cost a query each.
constexpr double kMostCells = 4096.0;
// Closest-point queries at most [-]. Beyond them bound and radius stay apart: a flat plate's
// deepest points fill a plane. More narrow them a little and take longer.
constexpr std::size_t kMostQuestions = 1000000;
// Relative accuracy of the largest radius [-]: messages state three digits. A smaller value takes
// more queries.
constexpr double kKnown = 0.01;

struct Cell {
    Vec3 center;
    double bound;  // no sphere with its centre in here is larger [m]
};

class Search {
public:
    Search(const SurfaceTree& tree, int dimension, double wanted)
        : tree_(tree), wanted_(wanted), flat_(dimension == 2) {
        for (const Vec3& v : tree.mesh().vertices) box_.extend(v);
    }

    Inscribed run() {
        std::vector<Cell> cells = first_cells();
        // Branch and bound: measure the cells' centres, improve the best by climbing, drop the
        // cells that cannot hold a larger sphere, halve the rest.
        for (std::size_t asked = 0; !cells.empty();) {
            ask(cells);
            asked += cells.size();
            climb();
            if (wanted_ > 0.0 && best_.radius >= wanted_) break;
            keep_promising(cells);
            if (cells.empty() || asked + 8 * cells.size() > kMostQuestions) break;
            cells = halve(cells);
        }
        best_.bound = best_.radius;
        for (const Cell& cell : cells) best_.bound = std::max(best_.bound, cell.bound);
        best_.bound = std::max(best_.bound, dropped_);
        return best_;
    }

private:
    std::vector<Cell> first_cells() {
        Vec3 size = box_.sizes();
        if (flat_) size.y() = 0.0;
        const double least = flat_ ? std::min(size.x(), size.z()) : size.minCoeff();
        const double most = size.maxCoeff();
        edge_ = std::max(least, most / kMostCells);
        const auto along = [&](int d) { return std::max(1.0, std::ceil(size[d] / edge_)); };
        while (along(0) * along(1) * along(2) > kMostCells) edge_ *= 1.1;
        std::vector<Cell> out;
        for (double x = 0; x < along(0); ++x)
            for (double y = 0; y < along(1); ++y)
                for (double z = 0; z < along(2); ++z) {
                    // the cells' block is centred on the box's
                    Vec3 at = box_.center() + edge_ * Vec3(x - 0.5 * (along(0) - 1.0),
                                                           y - 0.5 * (along(1) - 1.0),
                                                           z - 0.5 * (along(2) - 1.0));
                    if (flat_) at.y() = 0.0;
                    out.push_back({at, most});
                }
        return out;
    }

    Vec3 half() const { return 0.5 * edge_ * Vec3(1.0, flat_ ? 0.0 : 1.0, 1.0); }

    double depth_at(const Vec3& p) const {
        const Foot foot = tree_.closest(p);
        return foot.inside ? foot.distance : -foot.distance;
    }

    // The bounds of all cells, and the deepest of their centres.
    void ask(std::vector<Cell>& cells) {
        std::vector<double> depth(cells.size());
        const Vec3 half = this->half();
        parallel_for(cells.size(), 256, [&](std::size_t k) {
            Cell& cell = cells[k];
            const Foot foot = tree_.closest(cell.center);
            depth[k] = foot.inside ? foot.distance : -foot.distance;
            // Two bounds: the farthest point of the cell from the centre's foot, and the depth
            // of the centre plus half the cell's diagonal, as depth changes by no more than the
            // distance.
            const double farthest =
                ((cell.center - foot.point).cwiseAbs() + half).norm();  // of the cell from the foot
            cell.bound = std::min({cell.bound, farthest, depth[k] + half.norm()});
        });
        for (std::size_t k = 0; k < cells.size(); ++k)
            if (depth[k] > best_.radius) {
                best_.radius = depth[k];
                best_.center = cells[k].center;
            }
    }

    // Uphill from the deepest point known: along ridges of the depth cells gain little.
    void climb() {
        if (best_.radius <= 0.0) return;
        for (double step = 0.5 * edge_; step > 1e-4 * best_.radius; step *= 0.5)
            for (int d = 0; d < 6; ++d) {
                if (flat_ && d / 2 == 1) continue;
                const Vec3 p = best_.center + (d % 2 ? step : -step) * Vec3::Unit(d / 2);
                const double now = depth_at(p);
                if (now <= best_.radius) continue;
                best_.radius = now;
                best_.center = p;
            }
    }

    void keep_promising(std::vector<Cell>& cells) {
        const double least = best_.radius * (1.0 + kKnown);
        std::erase_if(cells, [&](const Cell& cell) {
            if (cell.bound > least || (wanted_ > 0.0 && cell.bound >= wanted_)) return false;
            dropped_ = std::max(dropped_, cell.bound);
            return true;
        });
    }

    std::vector<Cell> halve(const std::vector<Cell>& cells) {
        edge_ *= 0.5;
        std::vector<Cell> out;
        for (const Cell& cell : cells)
            for (int part = 0; part < 8; ++part) {
                if (flat_ && (part & 2) != 0) continue;
                const Vec3 offset(part & 1 ? 0.5 : -0.5, flat_ ? 0.0 : (part & 2 ? 0.5 : -0.5),
                                  part & 4 ? 0.5 : -0.5);
                out.push_back({cell.center + edge_ * offset, cell.bound});
            }
        return out;
    }

    const SurfaceTree& tree_;
    double wanted_;
    bool flat_;
    Eigen::AlignedBox3d box_;
    double edge_ = 0.0;     // of the cells
    double dropped_ = 0.0;  // largest bound of the cells that were dropped
    Inscribed best_;
};

}  // namespace

Inscribed find_inscribed(const SurfaceTree& tree, int dimension, double wanted) {
    return Search(tree, dimension, wanted).run();
}

}  // namespace ice
