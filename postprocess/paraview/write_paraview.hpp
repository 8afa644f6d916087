// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/formats/run_file.hpp"

namespace ice::paraview {

/// Options of the files.
struct ParaviewOptions {
    std::size_t every = 1;     ///< keep each `every`th frame, a count; 0 counts as 1
    bool points_only = false;  ///< no surfaces per frame: for long runs of many floes
    double load_from = 0.0;    ///< the load map averages from here on [s]; after the end: 0 Pa
};

/// Writes a run for ParaView, four files whatever its length:
///
///     run.xdmf       the run over time, to be opened with ParaView's "XDMF Reader"
///     shapes.xdmf    hull and floes in their own axes, without times: sources of 3D glyphs
///     arrays.h5      the numbers of both
///     view.py        opens run.xdmf coloured, with the water's plane: paraview --script=view.py
///
/// The parts of run.xdmf, blocks in ParaView:
///
///     hull: NAME     a named region of the hull, where it was; per triangle load_Pa, the
///                    time-averaged normal load
///     floes          posed surfaces; per triangle body, shape, group, state, contact_force_N and
///                    velocity_m_s
///     bodies         a point per floe with the same, angular_velocity_rad_s and orientation
///                    (w, x, y, z): "3D Glyphs" with orientation mode Quaternion draw them;
///                    contact_force_N is that of the ship on the floe
///     contacts       a point where a floe pressed on the hull, with floe, sphere of the hull and
///                    normal_force_N and friction_force_N of the floe on the ship, means since the
///                    stored frame before; absent at times without
///     water          the plane z = 0 about ice and ship
///
/// With points_only there are bodies, contacts and water alone. In 2D forces are per metre of
/// breadth, and their names end in _N_per_m.
/// XDMF, because ParaView before 5.12 does not read VTKHDF files with several steps.
/// @param folder is made where it is missing; files of the same names are replaced, and after an
///        error none of them is left
/// @return number of frames written
/// @throws Error (exit code 1) naming the file that cannot be written; (2) for a run without frames
std::size_t write_paraview(const RunData& run, const std::filesystem::path& folder,
                           const ParaviewOptions& options);

}  // namespace ice::paraview
