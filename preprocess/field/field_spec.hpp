// SPDX-License-Identifier: GPL-3.0-or-later
/// The specification of a field (TOML).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/toml/schema.hpp"
#include "preprocess/field/outline.hpp"

namespace ice {

enum class FieldPattern { grid, brick, cusps, voronoi, power_law, polygons };

/// Keys of a specification. "Size" of a floe is the diameter of the circle with its area.
struct FieldSpec {
    std::string title;
    FieldPattern pattern = FieldPattern::grid;
    std::int64_t seed = 0;  ///< of the random patterns

    double thickness = 0.0, chamfer = 0.0;  ///< [m]
    double radius = 0.0, spacing = 0.0;     ///< of the spheres [m]
    bool surface_only = false;

    std::array<double, 2> origin{0, 0};  ///< x of its leading edge, y of its centre line [m]
    std::array<double, 2> extent{0, 0};  ///< of the field along x, y [m]

    std::array<double, 2> floe_size{0, 0};  ///< grid, brick: along x, y [m]
    std::array<int, 2> count{1, 1};         ///< grid, brick: counts along x, y
    std::array<double, 2> gap{0, 0};        ///< grid, brick, cusps: along x, y [m]

    double concentration = 0.0;            ///< voronoi, power-law: ice over area [-]
    double mean_size = 0.0;                ///< voronoi [m]
    double exponent = 0.0;                 ///< power-law: a in N(> d) ~ d^-a [-]
    double smallest = 0.0, largest = 0.0;  ///< power-law [m]
    int relaxations = 0;                   ///< voronoi, power-law: rounds of Lloyd's method

    double breaking_length = 0.0;  ///< cusps: advance from row to row [m]
    double breaking_width = 0.0;   ///< cusps: chord [m]
    double breaking_depth = 0.0;   ///< cusps: height of the arc above its chord [m]
    double entrance_angle = 0.0;   ///< cusps: between a row and the centre line [rad]
    double jitter = 0.0;           ///< cusps: of the cusps' ends, in half breaking widths [-]

    std::filesystem::path file;  ///< polygons
    double scale = 1.0;          ///< polygons: metres per unit of the file

    double edge_breadth = 0.0;  ///< unbroken ice beside the field [m]; 0: none
    double edge_piece = 0.0;    ///< length of its pieces [m]
    double edge_gap = 0.0;      ///< between field and edge [m]
    double edge_ahead = 0.0;    ///< unbroken ice across the far end, along x [m]; 0: open
    std::array<double, 2> edge_overhang{0, 0};  ///< beyond the field's first and last x [m]

    std::string text;  ///< the file, verbatim, overrides behind it as comments
};

/// All keys of a specification.
const Schema& field_schema();

/// Reads and checks a specification: types, units and ranges, which keys a pattern needs and which
/// mean nothing to it.
///
/// @param overrides  "key=value", stronger than the file
/// @throws Error (exit code 2) with all mistakes at once, each with file, line and column
FieldSpec read_field_spec(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

}  // namespace ice
