// SPDX-License-Identifier: GPL-3.0-or-later
/// The parameters of a run, as the case file states them (docs/contract.md, section 4).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"
#include "solver/case/contact_law.hpp"
#include "solver/case/ship_keys.hpp"

namespace ice {

/// Where a floe group's places come from: rows and columns, columns shifted by half a floe, one
/// floe, or a field file.
enum class Pattern { grid, brick, single, file };
/// Until when a floe is immovable (infinite mass).
enum class Hold { never, until_hull_contact, until_contact, until_bent, always };
/// Direction of a contact: that of the surfaces which the spheres represent, or of the centres.
enum class NormalRule { surface, centres };
/// None, a force alone, or force and moment: (14).
enum class BuoyancyModel { none, centre, distributed };
/// None, on the projected area (16), or on every piece of the surface (17).
enum class DragModel { none, projected, panel };
/// How the ship moves the water: not at all, as a double body (solver/flow), or as a file says.
enum class FlowModel { none, double_body, file };
/// Load under which ice bends until it breaks: Nevel's wedges, or Kashtelyan's formula.
enum class BendingModel { wedge, kashtelyan };

/// One [[floes]] table: floes of one shape, or those of a field file.
struct FloeGroup {
    std::filesystem::path spheres;  ///< not with pattern "file"
    std::filesystem::path file;     ///< pattern "file"
    bool unbroken_part = false;  ///< pattern "file": the file's unbroken ice, held always; else the
                                 ///< loose floes
    Pattern pattern = Pattern::grid;
    std::array<int, 2> count{1, 1};  ///< floes along x, y
    /// x of the first row's leading edge, y of the centre line [m].
    std::array<double, 2> origin{0, 0};
    std::array<double, 2> gap{0, 0};  ///< between neighbours along x, y [m]
    Hold hold = Hold::until_hull_contact;
    Vec3 position = Vec3::Zero();  ///< [m], pattern "single"; z is NaN for floating equilibrium
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world, unit
    /// At the start, world axes [m/s], [rad/s].
    Vec3 velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
};

/// [bending]: when ice held until it bends is released (solver/bending).
struct BendingLaw {
    double flexural_strength = 5e5;  ///< [Pa]
    double elastic_modulus = 5e9;    ///< [Pa]
    double poisson_ratio = 0.3;      ///< [-]
    BendingModel model = BendingModel::wedge;
    double factor = 1.0;  ///< on the breaking load [-]
    /// Opening angle of a piece [rad], 0 to pi; NaN: from its outline.
    double opening_angle = std::numeric_limits<double>::quiet_NaN();
    double load_length = 0.0;  ///< over which the load is spread from the edge [m]
    /// Rows (normal speed [m/s], a second factor [-]), speed rising; empty: none.
    std::vector<std::pair<double, double>> factor_table;
};

/// Default of level_ice.spacing, in thicknesses [-]: a little less than the widest spacing at which
/// no corner passes between the spheres, whose radius is a quarter of the thickness
/// (kWidestSpacing). Smaller gives more spheres and slower runs.
constexpr double kLevelIceSpacing = 0.7;

/// [level_ice]: a sheet that the ship breaks into pieces (solver/level_ice).
struct LevelIce {
    double thickness = 0.0;          ///< [m]; 0: none
    std::array<double, 4> extent{};  ///< smallest and largest x, smallest and largest y [m]
    /// Distance of contact spheres [m], here kLevelIceSpacing of ice 1 m thick; gap between a tile
    /// and its neighbours [m].
    double spacing = 0.7, gap = 0.05;
    int seed = 0;  ///< of the cracks' scatter
    /// CrackLaw: C_l [-], C_v [s/m], largest relative deviation [-].
    double length_factor = 0.32, speed_factor = -0.144, scatter = 0.2;
};

struct Case {
    std::string title;
    int dimension = 3;  ///< 2: the plane y = 0, all quantities per metre of breadth
    double duration = 0.0, time_step = 0.01;  ///< [s]
    int seed = 0;         ///< of the jitter: another seed, another member of an ensemble
    double jitter = 0.0;  ///< largest offset of a floe's place along x and y [m]
    double gravity = 9.81, water_density = 1000.0;  ///< [m/s2], [kg/m3]

    std::filesystem::path hull_spheres;
    Vec3 hull_position = Vec3::Zero();  ///< of the mesh's origin [m]; a draught wins over its z
    /// From the mesh's lowest point up to the water [m]; NaN: hull_position's z places the hull.
    double hull_draught = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::pair<double, double>>
        speed_table;  ///< (t [s], u [m/s]), t rising; never empty

    ShipKeys ship;  ///< without a freedom the ship keeps to speed_table
    Propulsion propulsion;
    Tow tow;
    Mooring mooring;

    double ice_density = 900.0;                      ///< [kg/m3]
    std::array<double, 2> drift_velocity{0.0, 0.0};  ///< of the floes at the start [m/s]
    /// In the case's order; behind them one group of unbroken ice for each pattern "file".
    std::vector<FloeGroup> floes;

    ContactLaw contact;
    NormalRule normal = NormalRule::surface;

    BendingLaw bending;
    LevelIce level_ice;

    BuoyancyModel buoyancy = BuoyancyModel::distributed;
    DragModel drag = DragModel::panel;
    double drag_coefficient = 1.0;  ///< of the pressure rho/2 u^2 on an area across the flow [-]

    FlowModel flow = FlowModel::none;
    std::filesystem::path flow_file;          ///< with FlowModel::file
    std::array<double, 2> current{0.0, 0.0};  ///< of all the water, along x and y [m/s]
    bool flow_pressure = false;               ///< the flow's dynamic pressure acts on floes
    bool floes_move_water = false;            ///< floes have added mass

    /// Time between stored poses, and between rows of the histories [s]; history 0: every step.
    double frames_every = 0.1, history_every = 0.0;
    std::vector<int> track;     ///< numbers of floes with files of their own
    double average_from = 0.0;  ///< start of the averages [s]

    std::filesystem::path file;  ///< the case file
    std::string resolved;        ///< every key with its value, as TOML

    bool has_level_ice() const { return level_ice.thickness > 0.0; }
    /// Are there floes held until they bend? Those of level ice have to be laid before.
    bool has_bending() const;
    /// Speed of the ship at time t [m/s]: linear between the table's rows, constant outside.
    double ship_speed(double time) const;
    /// Distance that the ship covers along x from one time to a later one [s] -> [m], exactly: the
    /// speed is linear between rows.
    double ship_travel(double from, double to) const;
};

}  // namespace ice
