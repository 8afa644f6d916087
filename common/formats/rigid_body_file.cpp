// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/rigid_body_file.hpp"

#include <nlohmann/json.hpp>

namespace ice {

std::string rigid_body_text(const RigidBody& body, const std::string& spheres_file,
                            const std::string& frame, std::size_t count) {
    // Keys carry their unit, quaternions their order: programs disagree on both.
    const Eigen::Quaterniond& q = body.axes;
    const Mat3& inertia = body.inertia;
    nlohmann::ordered_json json;
    json["schema"] = "spherize-body/1";
    json["spheres_file"] = spheres_file;
    json["spheres_frame"] = frame;
    json["spheres"] = count;
    json["density_kg_m3"] = body.density;
    json["volume_m3"] = body.volume;
    json["mass_kg"] = body.mass;
    json["moments_kg_m2"] = {body.moments.x(), body.moments.y(), body.moments.z()};
    json["centroid_m"] = {body.centroid.x(), body.centroid.y(), body.centroid.z()};
    json["quaternion_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
    json["quaternion_xyzw"] = {q.x(), q.y(), q.z(), q.w()};  // the order of Chrono's DEM-Engine
    json["inertia_mesh_axes_kg_m2"] = {{"xx", inertia(0, 0)}, {"yy", inertia(1, 1)},
                                       {"zz", inertia(2, 2)}, {"xy", inertia(0, 1)},
                                       {"xz", inertia(0, 2)}, {"yz", inertia(1, 2)}};
    // a file name may be no UTF-8, JSON must be
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ice
