// SPDX-License-Identifier: GPL-3.0-or-later
/// The report of iceflow on a flow, as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ice {

/// How a flow was made and how well.
struct FlowReport {
    int dimension = 3;  ///< 3 or 2
    bool symmetric = false;
    double draught = 0.0, length = 0.0;   ///< of the wetted hull [m]
    std::int64_t panels = 0;              ///< of one half where symmetric
    double panel = 0.0;                   ///< longest edge of a panel [m]
    double residual = 0.0;                ///< area-rms of the normal velocity left, over U [-]
    double worst = 0.0;                   ///< its largest size [-]
    std::array<double, 3> worst_at{};     ///< where; z from the water's surface [m]
    double net_flux = 0.0;                ///< sum of the sources over the sum of their sizes [-]
    std::array<std::int64_t, 3> nodes{};  ///< 0 where no table was made
    double spacing = 0.0;                 ///< [m]
    double solve_seconds = 0.0, table_seconds = 0.0;  ///< wall time [s]
    std::vector<std::string> warnings;
    /// With --added-mass: of the hull, about the point added_mass_about; rows and columns surge,
    /// sway, heave, roll, pitch, yaw; [kg], [kg m], [kg m2]. Symmetric but for rounding.
    std::optional<std::array<std::array<double, 6>, 6>> added_mass = std::nullopt;
    std::array<double, 3> added_mass_about{};        ///< of the mesh [m]
    double displacement = 0.0, water_density = 0.0;  ///< of the panels' body [kg], [kg/m3]
};

/// Schema iceflow/1: docs/contract.md, section 10.
std::string flow_report_text(const FlowReport& report);

}  // namespace ice
