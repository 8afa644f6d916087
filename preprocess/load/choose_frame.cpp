// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/choose_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/hull_axes.hpp"
#include "preprocess/load/main_parts.hpp"
#include "preprocess/load/symmetry.hpp"

namespace ice {

namespace {

// Lengths of ships and floes [m]: a model floe and the longest ships (458 m). Lengths outside get a
// warning, and 1000 to 600 000 file units are read as millimetres. A wider range warns of fewer
// wrong units; a greater longest length takes more meshes for millimetres.
constexpr double kShortest = 0.05, kLongest = 600.0;
// Length [file units] from which a mesh in metres may as well be a model in millimetres: the report
// then states both. It changes no number: a smaller value states both more often, a larger one says
// nothing of small models.
constexpr double kModelInMillimetres = 100.0;
// Longest extent over that along forward [-], from which the axes are doubted in a warning. Hulls
// are 1.5 times as long as broad and more (half_hull.hpp); lower values would doubt floes.
constexpr double kLong = 1.5;
// Breadth of the finer end's sections over that of the other end [-] up to which the finer end
// counts as the bow. Nearer to 1 a stern with fine lines would be taken for a bow.
constexpr double kFiner = 0.8;
// The same of the breadths at the very ends [-], where the former decides nothing: a stem of full
// shoulders against a transom, 0.14 for the paper's hulls. Nearer to 1 a rounded transom would be
// taken for a bow.
constexpr double kSharper = 0.5;

std::string axis_name(int axis) { return std::string(1, static_cast<char>('x' + axis)); }

// "z" for upwards along z, as the option --up takes it; "-y" where a file is upside down.
std::string up_name(const Direction& up) { return up.positive ? axis_name(up.axis) : up.text(); }

std::string unit_name(double metres) {
    for (const auto& [name, value] :
         {std::pair{"m", 1.0}, std::pair{"mm", 1e-3}, std::pair{"cm", 1e-2},
          std::pair{"ft", 0.3048}, std::pair{"in", 0.0254}})
        if (std::abs(metres - value) < 1e-9 * value) return name;
    return fmt::format("{:g} m", metres);
}

// Decides units, then up, then forward: each later guess uses the ones before.
class Chooser {
public:
    Chooser(const TriangleMesh& mesh, const FileFrame& file, const ReadOptions& options,
            ReadNotes& notes)
        : mesh_(mesh), file_(file), options_(options), notes_(notes) {}

    Frame choose() {
        // Units first: the guess of axes compares lengths with those of ships.
        choose_units();
        if (!options_.mirror_y && !(options_.up && options_.forward)) hull_ = find_hull_axes(mesh_);
        choose_up();
        choose_forward();
        if (file_.left_handed)
            warn(
                "the file's axes are left-handed: check that port and starboard are not exchanged");
        return frame_;
    }

private:
    void note(const std::string& what, const std::string& value) { notes_.guessed[what] = value; }
    void warn(const std::string& text) { notes_.warnings.push_back(text); }

    void choose_units() {
        const double length = bounding_box(mesh_).sizes().maxCoeff();
        // In this order: the user's option, the file's statement, and a guess, which is noted.
        if (options_.scale) {
            frame_.metres = *options_.scale;
        } else if (file_.metres) {
            frame_.metres = *file_.metres;
            note("units", fmt::format("{}, as {}", unit_name(frame_.metres), file_said()));
        } else if (length >= 1000.0 && length <= 1000.0 * kLongest) {
            // no ship or floe is a kilometre long
            frame_.metres = 1e-3;
            note("units",
                 fmt::format("mm, because the solid would be {:.0f} m long in metres", length));
        } else {
            note("units", "m, as the file has them");
            if (length >= kModelInMillimetres)  // both a ship and its model in millimetres have it
                note("length", fmt::format("{:.4g} m; {:.3g} m if the file is in millimetres, with "
                                           "--units mm",
                                           length, 1e-3 * length));
        }
        const double metres = frame_.metres * length;
        if (metres < kShortest || metres > kLongest)
            warn(fmt::format("the solid is {:.3g} m long: if that is wrong, {} --units or --scale",
                             metres, options_.scale ? "correct" : "give"));
    }

    std::string file_said() const {
        return file_.format == "glTF" ? "glTF defines"
                                      : fmt::format("the {} file says", file_.format);
    }

    void choose_up() {
        // The user's word, then the file's, then the shape; without any z, as in most CAD programs.
        // Only choices that the user has not made are noted.
        if (options_.up) {
            frame_.up = Direction::from(*options_.up);
        } else if (file_.up) {
            frame_.up = *file_.up;
            note("up", fmt::format("{}, as {}", up_name(frame_.up), file_said()));
        } else if (hull_ && hull_->vertical == 1 && may_turn_up()) {
            frame_.up = {1, true};
            note("up",
                 fmt::format("y, because the hull is symmetric across {} and longest along {}",
                             axis_name(hull_->breadth), axis_name(hull_->length)));
        } else {
            note("up", "z");
        }
        if (!options_.up) doubt_up();
    }

    // A warning only: a deckhouse on a hull, or a floe's shape, may be broad at the bottom, too.
    void doubt_up() {
        if (!hull_ || hull_->prism || hull_->vertical != frame_.up.axis) return;
        if (!narrows_upwards(mesh_, *hull_, frame_.up.positive)) return;
        const Direction down{frame_.up.axis, !frame_.up.positive};
        warn(
            fmt::format("the hull is broader at the bottom than at the top: it may be upside down; "
                        "give --up {} if so",
                        up_name(down)));
    }

    // Forward given along y leaves z for up. A prism across its breadth is a floe lying flat.
    bool may_turn_up() {
        if (options_.forward && Direction::from(*options_.forward).axis == 1) return false;
        const Vec3 size = bounding_box(mesh_).sizes();
        if (hull_->prism) return false;
        // A hull is broader than deep; a mesh that is not is named in a warning, not turned.
        if (size[hull_->breadth] >= size[hull_->vertical]) return true;
        warn(
            fmt::format("the mesh is symmetric across {0} only: if it is a hull with y up, "
                        "give --up y",
                        axis_name(hull_->breadth)));
        return false;
    }

    void choose_forward() {
        if (options_.forward) {
            frame_.forward = Direction::from(*options_.forward);
            return;
        }
        // The found hull axes are of use only if they agree with the chosen up axis.
        const bool lies_flat = hull_ && hull_->vertical == frame_.up.axis;
        // x, unless x is up
        frame_.forward = {frame_.up.axis == 0 ? 1 : 0, true};
        if (lies_flat && hull_->length == frame_.forward.axis) {
            keep_forward();
        } else if (lies_flat) {
            turn_forward();
        } else {
            note("forward", frame_.forward.text());
            doubt_length();
            doubt_half();
        }
    }

    bool front_along_length() const { return file_.front && file_.front->axis == hull_->length; }

    // -1 where the end at the smaller coordinate is clearly the finer one, +1 where the other is,
    // 0 where the shape does not show it.
    int finer_end() const {
        const double ends = fineness_ratio(mesh_, *hull_), tips = tip_ratio(mesh_, *hull_);
        if (ends <= kFiner || ends >= 1.0 / kFiner) return ends < 1.0 ? -1 : 1;
        if (tips <= kSharper || tips >= 1.0 / kSharper) return tips < 1.0 ? -1 : 1;
        return 0;
    }

    // The hull lies along the axis that forward has anyway.
    void keep_forward() {
        if (front_along_length()) {
            frame_.forward = *file_.front;
            note("forward", fmt::format("{}, as {}", frame_.forward.text(), file_said()));
            return;
        }
        const int bow = finer_end();
        // the breadth of a prism is that of a 2D section and does not show its ends
        note("forward",
             frame_.forward.text() +
                 (bow == 0 && hull_->prism ? ", but which end is the bow cannot be seen" : ""));
        // Only warnings: the axis is right, and sterns of icebreakers are fine, too.
        if (bow < 0)
            warn(fmt::format("the bow seems to point to -{0}: give --forward -{0} if so",
                             axis_name(hull_->length)));
        else if (bow == 0 && !hull_->prism)
            warn_of_unseen_bow();
    }

    void warn_of_unseen_bow() {
        warn(
            fmt::format("which end is the bow cannot be seen: give --forward -{0} if it is at -{0}",
                        axis_name(hull_->length)));
    }

    void turn_forward() {
        const std::string along = axis_name(hull_->length);
        if (front_along_length()) {
            frame_.forward = *file_.front;
            note("forward", fmt::format("{}, as {}", frame_.forward.text(), file_said()));
            return;
        }
        const int bow = finer_end();
        // to the positive end, unless the other one is clearly finer
        frame_.forward = {hull_->length, bow >= 0};
        note("forward",
             fmt::format("{}, because the hull is longest along {}{}", frame_.forward.text(), along,
                         bow != 0 ? " and finer at that end" : ""));
        if (bow == 0) warn_of_unseen_bow();
    }

    // Longest along another axis; a floe that lies flat, a prism along up, may be.
    void doubt_length() {
        const Vec3 size = bounding_box(mesh_).sizes();
        int longest = 0;
        const double length = size.maxCoeff(&longest);
        const double across = size[frame_.forward.axis];
        if (longest != frame_.forward.axis && length >= kLong * across &&
            !is_prism(mesh_, frame_.up.axis))
            warn(
                fmt::format("the solid is longest along {0} but {1} is taken as forward: if it is "
                            "a hull, give --up and --forward",
                            axis_name(longest), frame_.forward.text()));
    }

    // An open half hull in other axes: named, not turned, since an open deck has the same open
    // edges.
    void doubt_half() {
        // the axis that is left: the three numbers add up to 3
        const int port = 3 - frame_.up.axis - frame_.forward.axis;
        int open = -1, count = 0;
        for (int axis = 0; axis < 3 && !options_.up; ++axis)
            if (looks_like_half_hull(mesh_, axis).kind == HalfHull::Kind::open) {
                open = axis;
                ++count;
            }
        if (count == 1 && open != port)
            warn(
                fmt::format("the mesh is open along {} = 0, like half a hull with its centre plane "
                            "there: if it is one, give --up, --forward and --mirror y",
                            axis_name(open)));
    }

    const TriangleMesh& mesh_;
    const FileFrame& file_;
    const ReadOptions& options_;
    ReadNotes& notes_;
    std::optional<HullAxes> hull_;
    Frame frame_;
};

}  // namespace

std::string Direction::text() const { return (positive ? "+" : "-") + axis_name(axis); }

Direction Direction::from(const std::string& text) {
    return {text.back() - 'x', text.front() != '-'};
}

Mat3 Frame::matrix() const {
    if (up.axis == forward.axis)
        throw bad_input("--forward " + forward.text(), "points along the up axis " + up_name(up),
                        "choose --up and --forward at right angles");
    Mat3 m;
    // the ship's x, y and z in the file's axes: up x forward points to port
    m.row(0) = forward.vector().transpose();
    m.row(1) = up.vector().cross(forward.vector()).transpose();
    m.row(2) = up.vector().transpose();
    return metres * m;
}

Frame choose_frame(const TriangleMesh& mesh, const FileFrame& file, const ReadOptions& options,
                   ReadNotes& notes) {
    std::int64_t left_out = 0;
    const std::optional<TriangleMesh> main = main_parts(mesh, left_out);
    if (left_out > 0 && !(options.up && options.forward && (options.scale || file.metres)))
        notes.warnings.push_back(fmt::format(
            "units and axes are guessed without {} part{} far from the largest or around it: check "
            "them, or give --units, --up and --forward",
            left_out, left_out == 1 ? "" : "s"));
    return Chooser(main ? *main : mesh, file, options, notes).choose();
}

}  // namespace ice
