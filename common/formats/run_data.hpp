// SPDX-License-Identifier: GPL-3.0-or-later
/// The records of a run as plain data: the contract between icesolve and icepost.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/formats/load_statistics.hpp"

namespace ice {

/// A body's shape, shared by all floes made from one sphere file.
struct RunShape {
    TriangleMesh mesh;  ///< body axes [m]; floes: about the centre of mass, hull: ship frame
    std::vector<Vec3> centers;  ///< [N] contact spheres, same axes [m]
    std::vector<double> radii;  ///< [N] [m]
};

/// Data that do not change during the run. Shape 0 is the hull.
struct RunHeader {
    int dimension = 3;  ///< 3 or 2
    std::string title, created_by, git_commit, command_line;
    std::string case_toml;  ///< the resolved case, verbatim
    /// Start of the statistics [s]; NaN in files of versions that did not store it.
    double average_from = std::numeric_limits<double>::quiet_NaN();
    std::vector<RunShape> shapes;
    std::vector<std::int32_t>
        body_shape;  ///< [Nb] row of shapes, one per floe; floe k has id k + 1
    std::vector<std::int32_t> body_group;  ///< [Nb] row of [[floes]] in the case
    std::vector<double> body_mass;         ///< [Nb] kg (2D: kg per metre of breadth)
    std::vector<Vec3> body_inertia;        ///< [Nb] diagonal about the mesh's axes [kg m2]
    std::vector<std::int32_t> tracked;     ///< ids of floes with their own histories
    /// In runs in level ice, set where pieces are read: when a floe broke off [s], the load that
    /// broke it off [N]; inf and 0 for floes that did not. Empty in other runs.
    std::vector<double> body_born, body_breaking_load;
    /// In runs in level ice: the group of its unbroken sheet, whose bodies are parts without a line
    /// between them; -1 in other runs.
    std::int32_t sheet_group = -1;
    bool ship_is_free = false;  ///< the ship moves by forces: rows have its motion
    /// Places at which the water's flow is known, from the water's surface above the ship's origin
    /// [m], and its velocity there for a ship at 1 m/s [1]. They do not turn with the ship.
    std::vector<Vec3> flow_point, flow_velocity;
};

/// One history sample. Forces are those of the ice on the ship, world axes.
struct HistoryRow {
    double time = 0.0;                   ///< [s]
    Vec3 contact_force = Vec3::Zero();   ///< normal parts [N] (2D: N per metre)
    Vec3 friction_force = Vec3::Zero();  ///< tangential parts [N]
    Vec3 moment = Vec3::Zero();          ///< about the mesh origin of the hull [N m]
    Vec3 ship_position = Vec3::Zero();   ///< of the hull's mesh origin [m]
    double contacts = 0.0;               ///< count of contacts with an impulse, mean of the steps
    double moving_floes = 0.0;           ///< count, at the end of the row
    double max_overlap = 0.0;            ///< deepest overlap of the steps [m]
    double kinetic_energy = 0.0;         ///< of the floes [J] (2D: J per metre)
    double breaking_x = 0.0;  ///< force along x of ice held until it bends [N]; not in run.h5

    // of a free ship, at the end of the row; forces are means
    Eigen::Quaterniond ship_orientation = Eigen::Quaterniond::Identity();  ///< ship to world
    Vec3 ship_angles = Vec3::Zero();    ///< roll, pitch, yaw [rad]
    Vec3 ship_velocity = Vec3::Zero();  ///< of its centre of gravity [m/s]
    double thrust = 0.0;                ///< along the heading [N]
    Vec3 tow_force = Vec3::Zero();      ///< on the ship [N]
};

/// Force of the ice on one region of the hull, world axes [N] (2D: N per metre).
struct RegionForce {
    Vec3 contact = Vec3::Zero(), friction = Vec3::Zero();
};

/// Forces on one region of the hull, one row per history sample [N] (2D: N per metre).
struct RegionHistory {
    std::string name;
    std::vector<Eigen::Vector3f> contact, friction;  ///< [S] each
};

/// One history sample of a tracked floe.
struct TrackRow {
    double time = 0.0;                                                ///< [s]
    Vec3 position = Vec3::Zero();                                     ///< centre of mass [m]
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
    Vec3 velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();    ///< world axes [m/s], [rad/s]
    Vec3 contact_force = Vec3::Zero();   ///< this floe on the ship, normal part [N]
    Vec3 friction_force = Vec3::Zero();  ///< this floe on the ship, tangential part [N]
    Vec3 ice_force = Vec3::Zero();       ///< of the other floes on this one [N]
};

/// Where a floe pressed on the hull since the last frame: all touches of one floe at one sphere of
/// the hull, as means over that time, so that force x time summed over the frames is the impulse.
struct HullContact {
    std::int32_t floe = 0;               ///< id, from 1
    std::int32_t sphere = 0;             ///< surface sphere of the hull's set
    Vec3 point = Vec3::Zero();           ///< mean weighted by normal impulse, ship frame [m]
    Vec3 normal_force = Vec3::Zero();    ///< of the floe on the ship [N] (2D: N per metre)
    Vec3 friction_force = Vec3::Zero();  ///< of the floe on the ship [N]
};

/// State of a floe as seen in a frame. Absent are, in level ice, pieces that have not broken off,
/// and parts of the sheet that have; run.h5 has no such body.
enum class FloeState : std::uint8_t { held = 0, moving = 1, behind = 2, absent = 3 };

/// Poses of all floes at one instant; arrays of length Nb.
struct RunFrame {
    double time = 0.0;                             ///< [s]
    Vec3 ship_position = Vec3::Zero();             ///< of the hull's mesh origin [m]
    std::vector<Vec3> position;                    ///< centres of mass [m]
    std::vector<Eigen::Quaterniond> orientation;   ///< body to world, sign continuous in time
    std::vector<Vec3> velocity, angular_velocity;  ///< [m/s], [rad/s]
    std::vector<Vec3> contact_force;         ///< of the ship on the floe, mean since last frame [N]
    std::vector<FloeState> state;            ///< in body_shape's order, as the others
    std::vector<HullContact> hull_contacts;  ///< sorted by floe, sphere; as many as there were
    Eigen::Quaterniond ship_orientation = Eigen::Quaterniond::Identity();  ///< ship to world
};

}  // namespace ice
