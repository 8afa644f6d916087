// SPDX-License-Identifier: GPL-3.0-or-later
/// A finished run as the paper's observations ask for it.
#pragma once

#include <cmath>
#include <numbers>

#include "common/formats/run_file.hpp"
#include "common/formats/summary_file.hpp"

namespace ice::test {

struct CaseRun {
    RunData data;
    Summary summary;

    explicit CaseRun(const std::string& name)
        : data(read_run(std::string(ICE_RUNS) + "/" + name + "/run.h5")),
          summary(read_summary(std::string(ICE_RUNS) + "/" + name + "/summary.json")) {}

    std::size_t floes() const { return data.header.body_shape.size(); }

    /// Centre of a floe in the ship frame [m].
    static Vec3 in_ship(const RunFrame& frame, std::size_t floe) {
        return frame.position[floe] - frame.ship_position;
    }
    /// The floe's own vertical axis in the world.
    static Vec3 upright(const Eigen::Quaterniond& orientation) {
        return orientation * Vec3::UnitZ();
    }
    /// 2D: slope of the floe's broad faces [degrees] in (-90, 90], rising forwards positive; which
    /// face is up does not matter.
    static double slope(const Eigen::Quaterniond& orientation) {
        const Vec3 along = orientation * Vec3::UnitX();
        double angle = std::atan2(along.z(), along.x()) * 180.0 / std::numbers::pi;
        if (angle > 90.0) angle -= 180.0;
        if (angle <= -90.0) angle += 180.0;
        return angle;
    }
};

}  // namespace ice::test
