// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/drop_surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/keep_triangles.hpp"
#include "preprocess/load/main_parts.hpp"

namespace ice {

namespace {

// A box is a flow solver's domain if, in two directions at least, its extent is this many times [-]
// that of all parts that are neither boxes nor flat sheets. Domains are usually several times as
// large, and a casing around all parts has about 1: a smaller value drops casings, a larger one
// keeps small domains.
constexpr double kBoxBeyond = 1.5;
// In a file of boxes alone, the largest box is a domain if its extent is this many times [-] that
// of all other boxes in every direction. A barge is a box with boxes (tanks) inside it, so that the
// value is above kBoxBeyond: a smaller one drops barges, a larger one keeps small domains.
constexpr double kBoxBeyondBoxes = 3.0;
// A flat sheet is a sea plane if, in both of its directions, its extent is this many times [-] that
// of the parts that are not flat. A deck has 1. A smaller value drops decks that overhang, a larger
// one keeps small sea planes.
constexpr double kFlatBeyond = 1.2;

using Box = Eigen::AlignedBox3d;

enum class PieceShape { other, box, flat };

struct Piece {
    Box box;
    bool on_box = true;  // all triangles lie in faces of the box
    bool gone = false;

    // thin along one axis: a sheet; all triangles in the box's faces: a box
    PieceShape shape() const {
        const double small = kFlatSheet * box.diagonal().norm();
        const auto thin = (box.sizes().array() <= small).count();
        return thin == 1             ? PieceShape::flat
               : thin == 0 && on_box ? PieceShape::box
                                     : PieceShape::other;
    }
};

std::vector<Piece> measure_parts(const TriangleMesh& mesh, const Parts& parts) {
    std::vector<Piece> pieces(static_cast<std::size_t>(parts.count));
    const auto of = [&](std::size_t t) -> Piece& {
        return pieces[static_cast<std::size_t>(parts.of_triangle[t])];
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) of(t).box.extend(mesh.corner(t, k));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Piece& piece = of(t);
        // A box's every triangle lies in one face of its bounding box; one triangle elsewhere and
        // the part is something else. Boxes must be known whole, so this is a second pass.
        if (!piece.on_box) continue;
        const double small = kFlatSheet * piece.box.diagonal().norm();
        piece.on_box = false;
        for (int d = 0; d < 3; ++d)
            for (const double face : {piece.box.min()[d], piece.box.max()[d]}) {
                bool all = true;
                for (int k = 0; k < 3; ++k)
                    all = all && std::abs(mesh.corner(t, k)[d] - face) <= small;
                piece.on_box = piece.on_box || all;
            }
    }
    return pieces;
}

// Whether a piece lies around the contents of a box, or reaches beyond them.
bool surrounds(const Piece& piece, const Box& rest) {
    const bool flat = piece.shape() == PieceShape::flat;
    const double times = flat ? kFlatBeyond : kBoxBeyond;
    int beyond = 0;
    // around the rest in all directions, and far larger in two of them
    for (int d = 0; d < 3; ++d) {
        if (flat && piece.box.sizes()[d] <= kFlatSheet * piece.box.diagonal().norm()) continue;
        if (piece.box.min()[d] > rest.min()[d] || piece.box.max()[d] < rest.max()[d]) return false;
        beyond += piece.box.sizes()[d] >= times * rest.sizes()[d];
    }
    return beyond >= 2;
}

// Where there is nothing but boxes: those in the largest one, if that is far larger than they are.
Box boxes_within(const std::vector<Piece>& pieces) {
    const auto volume = [](const Piece& p) {
        return p.shape() == PieceShape::box ? p.box.volume() : 0.0;
    };
    const auto largest =
        std::max_element(pieces.begin(), pieces.end(),
                         [&](const Piece& l, const Piece& r) { return volume(l) < volume(r); });
    Box rest;
    for (const Piece& piece : pieces)
        if (piece.shape() == PieceShape::box && &piece != &*largest) rest.extend(piece.box);
    if (rest.isEmpty()) return largest->box;  // there may be a sea plane about one box
    const bool far = (largest->box.sizes().array() >= kBoxBeyondBoxes * rest.sizes().array()).all();
    return far ? rest : Box();
}

}  // namespace

std::vector<std::string> drop_surroundings(TriangleMesh& mesh) {
    const Parts parts = find_parts(mesh);
    std::vector<Piece> pieces = measure_parts(mesh, parts);
    Box rest;
    for (const Piece& piece : pieces)
        if (piece.shape() == PieceShape::other) rest.extend(piece.box);
    std::vector<std::string> dropped;
    // Files of flow computations have the tank and the sea plane in them. A sheet or box is one of
    // these if it reaches around all that is neither.
    // of boxes alone it is not known which is the ship
    if (rest.isEmpty()) rest = boxes_within(pieces);
    if (rest.isEmpty()) return dropped;
    for (Piece& piece : pieces) {
        if (piece.shape() == PieceShape::other || !surrounds(piece, rest)) continue;
        piece.gone = true;
        const Vec3 size = piece.box.sizes();
        dropped.push_back(fmt::format("a {} of {:.3g} x {:.3g} x {:.3g} m around everything else",
                                      piece.shape() == PieceShape::flat ? "flat sheet" : "box",
                                      size.x(), size.y(), size.z()));
    }
    if (dropped.empty()) return dropped;
    std::vector<std::uint8_t> keep(mesh.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t)
        keep[t] = !pieces[static_cast<std::size_t>(parts.of_triangle[t])].gone;
    keep_triangles(mesh, keep);
    return dropped;
}

}  // namespace ice
