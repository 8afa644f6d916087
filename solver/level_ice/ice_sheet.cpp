// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/level_ice/ice_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <polyclipping/clipper.hpp>

#include "common/base/assert.hpp"

namespace ice {

namespace {

namespace cl = ClipperLib;

// Distance of the lattice's lines [m], 1e-9: a power of two, so that a coordinate is a double
// without rounding. Coarser moves corners more at each cut; lines finer by more than eight times
// would round coordinates of 1e6 m.
constexpr double kLattice = 0x1p-30;
// Largest coordinate of a sheet [m]: in the lattice it is a double without rounding. A larger value
// lets coordinates be rounded.
constexpr double kFarthest = 1e6;
// A part this many times as large as the cracked region is a sheet by itself [-], as the other side
// of a channel. Smaller keeps pieces in the sheet that float free; larger turns half sheets into
// one floe.
constexpr double kSheet = 10.0;

// Clipper works on whole numbers: a crack cuts the same corners on every machine. A billionth of a
// metre is far below the resolution of any load or area.
cl::Path to_lattice(const Loop& loop) {
    cl::Path out;
    for (const Vec2& p : loop)
        out.emplace_back(std::llround(p.x() / kLattice), std::llround(p.y() / kLattice));
    return out;
}

cl::Paths to_lattice(const std::vector<Loop>& loops) {
    cl::Paths out;
    for (const Loop& loop : loops) out.push_back(to_lattice(loop));
    return out;
}

Loop from_lattice(const cl::Path& path) {
    Loop out;
    for (const cl::IntPoint& p : path)
        out.emplace_back(kLattice * static_cast<double>(p.X), kLattice * static_cast<double>(p.Y));
    return out;
}

// An outer loop and the holes in it.
struct Part {
    Loop outer;
    std::vector<Loop> holes;
    double area;
};

// Largest first; equal ones in the order of their first corners, which no thread changes.
std::vector<Part> parts_of(const cl::PolyTree& tree) {
    std::vector<Part> parts;
    for (const cl::PolyNode* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
        if (node->IsHole()) continue;
        Part part{from_lattice(node->Contour), {}, 0.0};
        part.area = area_of(part.outer);
        for (const cl::PolyNode* hole : node->Childs) {
            part.holes.push_back(from_lattice(hole->Contour));
            part.area += area_of(part.holes.back());
        }
        parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& l, const Part& r) { return l.area > r.area; });
    return parts;
}

std::vector<Part> combine(const std::vector<Loop>& sheet, const std::vector<Loop>& regions,
                          cl::ClipType how) {
    // ioStrictlySimple: outlines of the result neither cross nor touch themselves
    cl::Clipper clipper(cl::ioStrictlySimple);
    clipper.AddPaths(to_lattice(sheet), cl::ptSubject, true);
    clipper.AddPaths(to_lattice(regions), cl::ptClip, true);
    cl::PolyTree tree;
    clipper.Execute(how, tree, cl::pftNonZero, cl::pftNonZero);
    return parts_of(tree);
}

std::vector<Part> combine(const std::vector<Loop>& sheet, const Loop& crack, cl::ClipType how) {
    return combine(sheet, std::vector<Loop>{crack}, how);
}

std::vector<Loop> outer_loops(std::vector<Part> parts) {
    std::vector<Loop> out;
    for (Part& part : parts) out.push_back(std::move(part.outer));
    return out;
}

std::vector<Loop> all_loops(std::vector<Part> parts) {
    std::vector<Loop> out;
    for (Part& part : parts) {
        out.push_back(std::move(part.outer));
        for (Loop& hole : part.holes) out.push_back(std::move(hole));
    }
    return out;
}

// Parts without holes: one that has some is cut across, through the middle of its first hole. A
// prism has one outline, and a ring of ice around a hole breaks there in any case.
std::vector<Part> opened(Part part) {
    if (part.holes.empty()) return {std::move(part)};
    Eigen::AlignedBox2d box, hole;
    for (const Vec2& p : part.outer) box.extend(p);
    for (const Vec2& p : part.holes[0]) hole.extend(p);
    // two halves, left and right of the hole's middle, each without that hole
    // The cut passes through the hole, so each half has one hole less: the recursion ends.
    Eigen::AlignedBox2d low = box, high = box;
    low.max().x() = high.min().x() = hole.center().x();
    const std::vector<Loop> loops = all_loops({std::move(part)});
    std::vector<Part> out;
    for (const auto& half : {low, high})
        for (Part& cut : combine(loops, loop_of(half), cl::ctIntersection))
            for (Part& whole : opened(std::move(cut))) out.push_back(std::move(whole));
    return out;
}

// Corners cut off where a loop moves [-], in widths of the strip: notches sharper than 60 degrees
// are widened square. Larger cuts a spike into the ice there.
constexpr double kMitre = 2.0;

// Loops moved outwards by `by` [m], as parts with their holes.
std::vector<Part> moved(const cl::Paths& loops, double by) {
    cl::ClipperOffset offset(kMitre);
    offset.AddPaths(loops, cl::jtMiter, cl::etClosedPolygon);
    cl::PolyTree tree;
    offset.Execute(tree, by / kLattice);
    return parts_of(tree);
}

bool is_too_small(const Loop& loop, double smallest) {
    // Too small by its area, or too narrow: 2 A / perimeter is the mean breadth of a long strip.
    const double area = area_of(loop);
    return area < smallest * smallest || 2.0 * area < 0.25 * smallest * length_of(loop);
}

}  // namespace

IceSheet::IceSheet(const Eigen::AlignedBox2d& extent, double smallest) : smallest_(smallest) {
    ICE_ASSERT(!extent.isEmpty() && extent.min().cwiseAbs().maxCoeff() <= kFarthest &&
               extent.max().cwiseAbs().maxCoeff() <= kFarthest);
    const Vec2 &a = extent.min(), &b = extent.max();
    // Rounded to the lattice at once: the area at the start is that of the polygon that cracks will
    // cut.
    loops_ = {from_lattice(to_lattice(loop_of({a, b})))};
}

IceSheet::Broken IceSheet::break_off(const Loop& crack) {
    // Inside the crack everything is loose. Of the ice outside, the largest part is the
    // sheet, and smaller parts as well if they have ten times the crack's area.
    std::vector<Part> loose = combine(loops_, crack, cl::ctIntersection);
    if (loose.empty()) return {};
    std::vector<Part> rest = combine(loops_, crack, cl::ctDifference);
    const double sheet = kSheet * area_of(crack);
    const auto small = std::find_if(rest.begin() + (rest.empty() ? 0 : 1), rest.end(),
                                    [&](const Part& p) { return p.area < sheet; });
    std::move(small, rest.end(), std::back_inserter(loose));
    rest.erase(small, rest.end());
    // A ring around an earlier hole is no outline of a prism: it is cut open.
    std::vector<Part> whole;
    for (Part& part : loose)
        for (Part& open : opened(std::move(part))) whole.push_back(std::move(open));
    loose = std::move(whole);
    std::stable_sort(loose.begin(), loose.end(),
                     [](const Part& l, const Part& r) { return l.area > r.area; });

    Broken out;
    // ice too small for a floe is counted, and no body
    for (Part& part : loose) {
        if (is_too_small(part.outer, smallest_))
            out.brash += part.area;
        else
            out.pieces.push_back(std::move(part.outer));
    }
    loops_ = all_loops(std::move(rest));
    return out;
}

double IceSheet::take(const Loop& region) {
    const double before = area();
    std::vector<Part> rest = combine(loops_, region, cl::ctDifference);
    // slivers that the region leaves count as taken, so that areas add up
    std::erase_if(rest, [&](const Part& p) { return is_too_small(p.outer, smallest_); });
    loops_ = all_loops(std::move(rest));
    return before - area();
}

double IceSheet::area_in(const Loop& region) const {
    // holes are counted by their negative areas
    double sum = 0.0;
    for (const Part& part : combine(loops_, region, cl::ctIntersection)) sum += part.area;
    return sum;
}

IceSheet IceSheet::in_box(const Eigen::AlignedBox2d& box) const {
    IceSheet out = *this;
    out.loops_ = all_loops(combine(loops_, loop_of(box), cl::ctIntersection));
    return out;
}

std::vector<Loop> IceSheet::parts_in(const Eigen::AlignedBox2d& box) const {
    std::vector<Loop> out;
    for (Part& part : combine(loops_, loop_of(box), cl::ctIntersection))
        for (Part& open : opened(std::move(part))) out.push_back(std::move(open.outer));
    return out;
}

double IceSheet::area() const {
    double sum = 0.0;
    for (const Loop& loop : loops_) sum += area_of(loop);
    return sum;
}

// Crossings of a ray along +x with all edges: holes need no case of their own, since they change
// the count once more.
bool IceSheet::contains(const Vec2& point) const {
    bool inside = false;  // an odd number of edges lies to the right
    for (const Loop& loop : loops_)
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
            if ((a.y() > point.y()) == (b.y() > point.y())) continue;
            const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
            inside = inside != (point.x() < x);
        }
    return inside;
}

Loop loop_of(const Eigen::AlignedBox2d& box) {
    const Vec2 &a = box.min(), &b = box.max();
    return {{a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}, {a.x(), b.y()}};
}

Loop on_lattice(const Loop& loop) { return from_lattice(to_lattice(loop)); }

std::vector<Loop> common_part(const Loop& loop, const Loop& region) {
    return outer_loops(combine({loop}, region, cl::ctIntersection));
}

std::vector<Loop> without(const Loop& loop, const Loop& region) {
    return outer_loops(combine({loop}, region, cl::ctDifference));
}

std::vector<Loop> parts_without(const std::vector<Loop>& ice, const std::vector<Loop>& regions) {
    // Half the breadth of a strip that is rounding [m]: far above the lattice, nothing in a
    // picture. A larger one leaves more of the ice out.
    constexpr double kHair = 0.5e-3;
    std::vector<Loop> out;
    for (Part& part : combine(ice, regions, cl::ctDifference))
        for (const Part& open : opened(std::move(part)))
            // inwards and outwards again: thin strips and tails are gone
            for (const Part& inner : moved({to_lattice(open.outer)}, -kHair))
                for (const Part& whole : moved({to_lattice(inner.outer)}, kHair))
                    // outlines that touch themselves become two
                    for (Part& simple : combine({whole.outer}, Loop{}, cl::ctUnion))
                        out.push_back(std::move(simple.outer));
    return out;
}

Loop joined(const Loop& a, const Loop& b) {
    std::vector<Part> parts = combine({a}, b, cl::ctUnion);
    if (parts.size() != 1 || !parts[0].holes.empty()) return {};
    return std::move(parts[0].outer);
}

std::vector<Loop> shrunk(const Loop& loop, double by, double smallest, double nearest) {
    std::vector<Loop> out;
    for (const Part& part : moved({to_lattice(loop)}, -by)) {
        cl::Path path = to_lattice(part.outer);
        cl::CleanPolygon(path, nearest / kLattice);
        if (!part.holes.empty() || path.size() < 3) continue;
        // narrow places may cross once corners are gone: there the loop becomes two
        for (Part& simple : combine({from_lattice(path)}, Loop{}, cl::ctUnion))
            if (!is_too_small(simple.outer, smallest)) out.push_back(std::move(simple.outer));
    }
    return out;
}

}  // namespace ice
