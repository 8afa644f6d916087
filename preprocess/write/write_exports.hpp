// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// Formats of --export.
///
/// | format   | files              | frame of the coordinates                           |
/// |----------|--------------------|----------------------------------------------------|
/// | csv      | .csv               | the mesh's                                         |
/// | vtp      | .vtp               | the mesh's                                         |
/// | yade     | .yade.txt, .py     | centre of mass and principal axes; pose in the .py |
/// | liggghts | .liggghts.txt, .in | centre of mass, mesh axes                          |
/// | chrono   | .chrono.csv, .json | centre of mass and principal axes; pose in .json   |
///
/// All spheres of the set are written; `--mode surface` leaves out the interior.
std::vector<std::string> export_formats();

/// The files that write_exports() makes of these formats.
std::vector<std::filesystem::path> export_files(const std::vector<std::string>& formats,
                                                const std::filesystem::path& base);

/// True where a format carries a mass, and so needs a density.
bool has_mass(const std::string& format);

/// Refuses sets that a format cannot hold: a 2D set (per metre of breadth) as a rigid body in 3D,
/// fewer than two spheres for LIGGGHTS, a file name that cannot stand between the quotes of a
/// script.
/// @throws Error (exit code 2) naming the option
void check_exports(const SphereSet& set, const std::vector<std::string>& formats,
                   const std::filesystem::path& base);

/// Writes the set in each format to `base` with the endings above; a repeated format once.
///
/// Mass and inertia are the exact integrals of the solid at `density` [kg/m3]. All files get their
/// final names after the last one is complete.
/// @return the files written
/// @throws Error (exit code 1) naming the file that cannot be written; nothing half-written stays
std::vector<std::filesystem::path> write_exports(const SphereSet& set,
                                                 const std::vector<std::string>& formats,
                                                 double density, const std::filesystem::path& base);

}  // namespace ice
