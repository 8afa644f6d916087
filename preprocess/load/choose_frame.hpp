// SPDX-License-Identifier: GPL-3.0-or-later
/// Units and axes of a mesh file: from the file, from the user, or guessed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A direction along one of the file's axes.
struct Direction {
    int axis = 0;  ///< 0, 1, 2 for x, y, z
    bool positive = true;

    bool operator==(const Direction&) const = default;
    Vec3 vector() const { return (positive ? 1.0 : -1.0) * Vec3::Unit(axis); }
    /// "+x", "-y", ...
    std::string text() const;
    /// From "+x", "-y", "z", ...
    static Direction from(const std::string& text);
};

/// The file's own statements on its numbers.
struct FileFrame {
    std::string format;            ///< "glTF", "Collada", "FBX"; empty for formats without these
    std::optional<double> metres;  ///< per file unit
    std::optional<Direction> up;
    std::optional<Direction> front;  ///< a habit of the program that wrote it: see choose_frame()
    bool left_handed = false;
};

/// How a file's numbers become metres in the ship frame (x forward, y to port, z up). Values that
/// are not given are taken from the file or guessed.
struct ReadOptions {
    std::optional<double> scale;         ///< metres per file unit
    std::optional<std::string> up;       ///< file axis that points up: y z -y -z
    std::optional<std::string> forward;  ///< direction, after `up`, of the bow: +x -x +y -y +z -z
    bool mirror_y = false;               ///< add the mirror image across y = 0 (half hulls)
};

/// Values that reading took from the file or guessed, and its changes to the mesh.
struct ReadNotes {
    /// "units", "up", "forward": value and reason, such as "mm, because the solid would be 9000 m
    /// long in metres". No entry where an option gave the value.
    std::map<std::string, std::string> guessed;
    std::vector<std::string> warnings;
    std::int64_t centre_plane_dropped = 0;  ///< triangles in y = 0 removed before mirroring
};

/// Units and axes in use.
struct Frame {
    double metres = 1.0;  ///< per file unit
    Direction up{2, true}, forward{0, true};

    /// From the file's axes and unit to the ship frame: a rotation times `metres`.
    /// @throws Error (exit code 2) when up and forward lie along one axis
    Mat3 matrix() const;
};

/// Settles units and axes: an option wins, then the file's statement, then a guess that changes
/// nothing unless the mesh leaves no doubt. Boxes and floes keep their axes.
///
/// **Units.** Ships and floes are 0.05 m to 600 m long (the longest ships: 458 m). A length in that
/// range is metres. 1000 to 600 000 file units are millimetres, in which drawing programs export.
/// All else (600 to 1000: a floe in mm or a boat in cm; below 0.05; above 600 000) stays in
/// metres, with a warning. A solid below 600 mm drawn in millimetres does not differ from a ship.
///
/// **Axes.** A mesh is taken for a hull when its longest extent is 1.5 times the next or more and
/// exactly one of the two axis planes along it is a plane of symmetry (asymmetry()): the centre
/// plane. The third axis is the vertical. Boxes are symmetric about both planes, most floes about
/// none but the plane halfway up their thickness. Up is therefore z unless the vertical found is y,
/// the breadth is at least the depth (a flat floe is thinner than wide) and the mesh is no prism
/// across its centre plane (a floe of irregular outline is). Doubtful cases keep z, with a warning;
/// a hull that narrows upwards (narrows_upwards()) keeps z with a warning, too, where no option
/// gives the axis.
///
/// Forward is +x unless the hull is longest along another horizontal axis. The bow is then at the
/// end the file calls its front; else where sections are narrower by a fifth or more between 2 %
/// and 14 % of the length from the end, or by half at 0.5 % (a stem against a transom); else at the
/// positive end, with a warning. A hull that lies along x already is not turned about even when its
/// finer end is aft, since sterns can be fine and bows bluff: that is a warning, and so are two
/// ends of one fineness, unless the hull is a prism (a 2D section), whose breadth does not show
/// its ends. The file's front direction counts only along the hull's length: programs write it out
/// of habit, whatever the hull's axes.
///
/// @param mesh   in the file's axes and units; one half of a hull is symmetric about nothing, so
///               axes of half hulls are never guessed
/// @param notes  guesses and warnings are added
Frame choose_frame(const TriangleMesh& mesh, const FileFrame& file, const ReadOptions& options,
                   ReadNotes& notes);

}  // namespace ice
