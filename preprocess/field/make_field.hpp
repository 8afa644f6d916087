// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/field.hpp"
#include "preprocess/field/field_spec.hpp"

namespace ice {

/// Measures of the field, for people and other programs: counts, and sizes of the loose floes.
struct FieldReport {
    std::size_t floes = 0, fixed = 0, shapes = 0;  ///< loose floes, pieces of unbroken ice
    std::size_t spheres = 0, surface_spheres = 0;  ///< of all floes together
    std::int64_t corners = 0;    ///< of the shapes, each with a sphere that has its three faces
    double concentration = 0.0;  ///< area of loose floes over the field's [-]
    double mean_size = 0.0, smallest = 0.0, largest = 0.0;  ///< [m]
    double plan_seconds = 0.0, fill_seconds = 0.0;          ///< wall time [s]
    std::vector<std::string> warnings;
};

/// The outlines of a specification. @throws Error (exit code 2) as the patterns do (plan_floes.hpp)
FieldPlan plan_field(const FieldSpec& spec, std::vector<std::string>& warnings);

/// Turns outlines into prisms and fills them with spheres, loose floes first. Outlines that are
/// equal but for their place (to a thousandth of a millimetre) share a shape. Provenance is the
/// caller's.
///
/// The bits are the same for any number of threads.
/// @throws Error (exit code 2) when a floe is too small for a sphere, or a corner of one that has
///         room for a sphere has none of its own
Field make_field(const FieldSpec& spec, const FieldPlan& plan, FieldReport& report);

/// The report as JSON (schema icefield/1).
std::string field_report_text(const FieldReport& report);

/// The field from above as SVG: x, the ship's way, to the right, y to port up, with axes in metres,
/// a scale bar and the colours' meaning; unbroken ice is darker.
std::string field_svg(const FieldPlan& plan);

}  // namespace ice
