// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/edge_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Share of a cell that may miss from a whole one [-]: rounding to the lattice. Larger takes a cell
// with a small cut for whole, which then has no tile; 0 lays tiles around rounding.
constexpr double kWhole = 1e-6;

// An edge this near to a cell counts as one in it, in cells [-]: rounding to the lattice. Larger
// cuts cells that no edge touches; 0 could take a cell for whole that an edge along its side cuts.
constexpr double kNearCell = 1e-6;

// Columns of cells whose ice is taken from the sheet at once [-]. More read more corners for each
// cell, fewer the whole sheet more often.
constexpr std::int64_t kBand = 8;

using Box = Eigen::AlignedBox2d;

// From its corner with the smallest x, then y: a tile is recognized by its corners, which begin at
// the same one however it was cut.
void begin_at_first(Loop& loop) {
    const auto first = std::min_element(loop.begin(), loop.end(), [](const Vec2& l, const Vec2& r) {
        return std::pair(l.x(), l.y()) < std::pair(r.x(), r.y());
    });
    std::rotate(loop.begin(), first, loop.end());
}

// The cells that a box touches, and one more around them.
class Cells {
public:
    Cells(const IceSheet& sheet, const EdgeGrid& grid, const Box& reach) : grid_(grid) {
        for (int d = 0; d < 2; ++d) {
            first_[d] = index_of(reach.min()[d], d) - 1;
            count_[d] = index_of(reach.max()[d], d) + 2 - first_[d];
        }
        parts_.resize(static_cast<std::size_t>(count_[0] * count_[1]));
        whole_.resize(parts_.size(), 0);
        const std::vector<std::uint8_t> crossed = cells_of_edges(sheet);
        // Bands begin at the same cells wherever the reach is: a cell's corners stay the same.
        const std::int64_t first = band_of(first_[0]), last = band_of(first_[0] + count_[0] - 1);
        parallel_tasks(static_cast<std::size_t>(last - first + 1), true, [&](std::size_t k) {
            fill_band(sheet, crossed, first + static_cast<std::int64_t>(k));
        });
    }

    void join_slivers(const std::function<bool(const Loop&)>& can_be_filled) {
        // A strip too thin for a sphere would be ice that nothing meets. It joins a neighbour
        // with which it has a common side; without one it is left out.
        for (std::int64_t i = 0; i < count_[0]; ++i)
            for (std::int64_t j = 0; j < count_[1]; ++j) {
                if (whole_[row(i, j)]) continue;
                std::vector<Loop> kept;
                for (Loop& part : parts(i, j)) {
                    if (can_be_filled(part))
                        kept.push_back(std::move(part));
                    else
                        join(part, i, j);
                }
                parts(i, j) = std::move(kept);
            }
    }

    // A floe may lie below these cells.
    void mark(const Box& floe) {
        near_floe_.resize(parts_.size(), 0);
        for_cells(floe, [&](std::size_t cell) { near_floe_[cell] = 1; });
    }

    // Those of the cells that the box touches which may be met.
    std::vector<Loop> met() {
        std::vector<Loop> out;
        // the outer row of cells serves to judge the others only
        for (std::int64_t i = 1; i + 1 < count_[0]; ++i)
            for (std::int64_t j = 1; j + 1 < count_[1]; ++j) {
                // whole, with whole neighbours: only a floe below it reaches it before a crack or
                // the hull has opened them
                if (is_inside(i, j) && (near_floe_.empty() || !near_floe_[row(i, j)])) continue;
                for (Loop& part : parts(i, j)) out.push_back(std::move(part));
            }
        return out;
    }

private:
    std::int64_t index_of(double x, int d) const {
        return static_cast<std::int64_t>(std::floor((x - grid_.origin[d]) / grid_.cell));
    }
    Vec2 corner(std::int64_t i, std::int64_t j) const {
        return grid_.origin + grid_.cell * Vec2(static_cast<double>(first_[0] + i),
                                                static_cast<double>(first_[1] + j));
    }
    std::size_t row(std::int64_t i, std::int64_t j) const {
        return static_cast<std::size_t>(i * count_[1] + j);
    }
    std::vector<Loop>& parts(std::int64_t i, std::int64_t j) { return parts_[row(i, j)]; }

    // By cell: may an edge of the sheet touch it? All others are whole or without ice.
    std::vector<std::uint8_t> cells_of_edges(const IceSheet& sheet) const {
        std::vector<std::uint8_t> out(parts_.size(), 0);
        for (const Loop& loop : sheet.loops())
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Vec2 &p = loop[k], &q = loop[(k + 1) % loop.size()];
                const Vec2 beside = Vec2::Constant(kNearCell * grid_.cell);
                for_cells({Vec2(p.cwiseMin(q) - beside), Vec2(p.cwiseMax(q) + beside)},
                          [&](std::size_t cell) { out[cell] = 1; });
            }
        return out;
    }

    // Calls visit(row) for the cells that the box touches.
    template <class Visit>
    void for_cells(const Box& box, const Visit& visit) const {
        std::array<std::int64_t, 2> low, high;
        for (int d = 0; d < 2; ++d) {
            low[d] = std::max(index_of(box.min()[d], d) - first_[d], std::int64_t{0});
            high[d] = std::min(index_of(box.max()[d], d) - first_[d], count_[d] - 1);
        }
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
            for (std::int64_t j = low[1]; j <= high[1]; ++j) visit(row(i, j));
    }

    static std::int64_t band_of(std::int64_t column) {
        return (column - (column < 0 ? kBand - 1 : 0)) / kBand;
    }

    // the sheet's many corners are read once for each band, not for each cell
    void fill_band(const IceSheet& sheet, const std::vector<std::uint8_t>& crossed,
                   std::int64_t band) {
        const std::int64_t begin = std::max(kBand * band - first_[0], std::int64_t{0}),
                           end = std::min(kBand * (band + 1) - first_[0], count_[0]);
        const std::int64_t from = kBand * band - first_[0];
        const IceSheet part = sheet.in_box({corner(from, 0), corner(from + kBand, count_[1])});
        for (std::int64_t i = begin; i < end; ++i) fill_column(part, crossed, i);
    }

    void fill_column(const IceSheet& sheet, const std::vector<std::uint8_t>& crossed,
                     std::int64_t i) {
        const Box box(corner(i, 0), corner(i + 1, count_[1]));
        const IceSheet column = sheet.in_box(box);
        const double whole = grid_.cell * grid_.cell * (1.0 - kWhole);
        for (std::int64_t j = 0; j < count_[1]; ++j) {
            const Box cell(corner(i, j), corner(i + 1, j + 1));
            if (crossed[row(i, j)]) {
                parts(i, j) = column.parts_in(cell);
                whole_[row(i, j)] = parts(i, j).size() == 1 && area_of(parts(i, j)[0]) >= whole;
                continue;
            }
            // side by side, such cells are alike
            whole_[row(i, j)] = j > 0 && !crossed[row(i, j - 1)] ? whole_[row(i, j - 1)]
                                                                 : sheet.contains(cell.center());
            if (whole_[row(i, j)]) parts(i, j) = {on_lattice(loop_of(cell))};
        }
        for (std::int64_t j = 0; j < count_[1]; ++j)
            for (Loop& part : parts(i, j)) begin_at_first(part);
    }

    void join(const Loop& sliver, std::int64_t i, std::int64_t j) {
        constexpr std::array<std::pair<int, int>, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
        for (const auto& [di, dj] : kBeside) {
            const std::int64_t k = i + di, l = j + dj;
            if (k < 0 || l < 0 || k >= count_[0] || l >= count_[1]) continue;
            for (Loop& part : parts(k, l)) {
                Loop both = joined(part, sliver);
                if (both.empty()) continue;
                part = std::move(both);
                begin_at_first(part);
                return;
            }
        }
    }

    // Is the cell whole, and all around it?
    bool is_inside(std::int64_t i, std::int64_t j) const {
        for (std::int64_t k = i - 1; k <= i + 1; ++k)
            for (std::int64_t l = j - 1; l <= j + 1; ++l)
                if (!whole_[row(k, l)]) return false;
        return true;
    }

    EdgeGrid grid_;
    std::array<std::int64_t, 2> first_, count_;
    std::vector<std::vector<Loop>> parts_;  // by cell
    std::vector<std::uint8_t> whole_;
    std::vector<std::uint8_t> near_floe_;  // empty where there are no floes
};

}  // namespace

std::vector<Loop> edge_tiles(const IceSheet& sheet, const EdgeGrid& grid, const Box& reach,
                             const std::vector<Box>& floes,
                             const std::function<bool(const Loop&)>& can_be_filled) {
    Cells cells(sheet, grid, reach);
    cells.join_slivers(can_be_filled);
    for (const Box& floe : floes) cells.mark(floe);
    return cells.met();
}

}  // namespace ice
