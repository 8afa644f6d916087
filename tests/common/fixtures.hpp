// SPDX-License-Identifier: GPL-3.0-or-later
/// Small solids, runs and folders that several tests use.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "common/base/error.hpp"
#include "common/formats/run_file.hpp"
#include "common/geometry/mass_properties.hpp"

namespace ice::test {

/// A new empty folder, removed with everything in it at the end of the scope.
class TempFolder {
public:
    TempFolder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("ice_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    std::size_t file_count() const {
        const std::filesystem::directory_iterator begin(path_), end;
        return static_cast<std::size_t>(std::distance(begin, end));
    }

private:
    std::filesystem::path path_;
};

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// The message of the Error that `body` throws, or "" when it throws none.
template <class Body>
std::string error_text(const Body& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// A box of the given edges [m] about `center`, outward triangles.
inline TriangleMesh make_box(const Vec3& edges, const Vec3& center = Vec3::Zero()) {
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k)
        mesh.vertices.push_back(center + 0.5 * Vec3((k & 1 ? 1 : -1) * edges.x(),
                                                    (k & 2 ? 1 : -1) * edges.y(),
                                                    (k & 4 ? 1 : -1) * edges.z()));
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    mesh.region.assign(12, 0);
    return mesh;
}

/// What make_run() should hold.
struct RunSize {
    int dimension = 3;
    std::size_t floes = 6, frames = 45, samples_per_frame = 10;
};

/// Two panels of the box hull of make_run(), each with half of its spheres.
inline HullPanels make_panels(int dimension) {
    HullPanels hull{0.5, 0.1, {0, 0, 0, 0, 1, 1, 1, 1}, {}};
    const double length = dimension == 2 ? 1.0 : 0.5;
    hull.panels = {{1, Vec3(7.0, 0, -0.7), -Vec3::UnitZ(), 0.25, length, 300.0, 850.0, 900.0},
                   {0, Vec3(8.0, 0, 0), Vec3::UnitX(), 0.2, length, 10.0, 20.0, 25.0}};
    return hull;
}

/// What does not change during make_run().
inline RunHeader make_header(const RunSize& size) {
    RunHeader header;
    header.dimension = size.dimension;
    header.title = "Box among floes <test & \"quotes\">";
    header.created_by = "icesolve 0.1.0";
    header.git_commit = "abc123";
    header.command_line = "icesolve box.cfg --out box";
    header.case_toml = "title = \"Box among floes\"\n[ice]\ndensity = 900.0\n";
    header.average_from = 1.5;
    const double breadth = size.dimension == 2 ? 1.0 : 2.0;
    header.shapes.resize(2);
    header.shapes[0].mesh = make_box({8.0, breadth, 1.2}, {4.0, 0.0, -0.1});
    header.shapes[0].mesh.region_names = {"hull", "bottom"};
    header.shapes[0].mesh.region[0] = header.shapes[0].mesh.region[1] = 1;
    header.shapes[1].mesh = make_box({1.0, size.dimension == 2 ? 1.0 : 0.8, 0.2});
    for (RunShape& shape : header.shapes)
        for (const Vec3& v : shape.mesh.vertices) {
            shape.centers.push_back(0.9 * v);
            shape.radii.push_back(0.05);
        }
    for (std::size_t k = 0; k < size.floes; ++k) {
        header.body_shape.push_back(1);
        header.body_group.push_back(static_cast<std::int32_t>(k % 2));
        header.body_mass.push_back(144.0);
        header.body_inertia.emplace_back(8.16, 12.48, 19.68);
    }
    header.flow_point = {Vec3(8.5, 0.0, -0.125), Vec3(8.0, 1.5, 0.0), Vec3(-1.0, 0.0, -0.5)};
    header.flow_velocity = {Vec3(0.5, 0.0, -0.125), Vec3(0.25, 0.25, 0.0), Vec3(0.25, 0.0, 0.0)};
    if (size.floes > 1) header.tracked = {1, static_cast<std::int32_t>(size.floes)};
    return header;
}

/// The frame of a number in make_run(): floes in two columns, of which the bow has reached some.
inline RunFrame make_frame(const RunSize& size, std::size_t number) {
    RunFrame frame;
    frame.time = 0.1 * static_cast<double>(number);
    frame.ship_position = Vec3(frame.time, 0.0, 0.0);
    for (std::size_t k = 0; k < size.floes; ++k) {
        const double row = static_cast<double>(k / 2), side = k % 2 ? 1.0 : -1.0;
        const double x = 8.5 + 1.1 * row;
        const bool pushed = x - 0.5 < 8.0 + frame.time;  // the bow at x = 8 m + t has reached it
        const double angle = pushed ? 1.5 * frame.time : 0.0;
        frame.position.emplace_back(x, size.dimension == 2 ? 0.0 : 0.5 * side,
                                    pushed ? -0.85 : -0.08);
        frame.orientation.emplace_back(Eigen::AngleAxisd(angle, Vec3::UnitY()));
        frame.velocity.emplace_back(0.0, 0.0, pushed ? -0.1 : 0.0);
        frame.angular_velocity.emplace_back(0.0, pushed ? 1.5 : 0.0, 0.0);
        frame.contact_force.emplace_back(pushed ? 100.0 : 0.0, 0.0, pushed ? -300.0 : 0.0);
        frame.state.push_back(pushed ? FloeState::moving : FloeState::held);
        // on the bottom, 1 m behind the bow; the ship feels the opposite of the floe
        if (pushed && number > 0)
            frame.hull_contacts.push_back(
                {static_cast<std::int32_t>(k + 1), static_cast<std::int32_t>(k % 2),
                 Vec3(7.0, 0.5 * side, -0.7), Vec3(0.0, 0.0, 300.0), Vec3(-100.0, 0.0, 0.0)});
    }
    return frame;
}

/// The ship's history in make_run() at a time [s]: the force along x has the mean -1000 N.
inline HistoryRow make_row(double time, double moving_floes) {
    const double turn = 2 * std::numbers::pi * time;
    HistoryRow row;
    row.time = time;
    row.contact_force = Vec3(-1000.0 + 200.0 * std::sin(turn), 50.0 * std::cos(turn), 400.0);
    row.friction_force = 0.1 * row.contact_force;
    row.moment = Vec3(1.0, 2.0, 3.0) * time;
    row.ship_position = Vec3(time, 0.0, 0.0);
    row.contacts = 3.0;
    row.moving_floes = moving_floes;
    row.max_overlap = 1e-4;
    row.kinetic_energy = 12.5;
    return row;
}

/// The history of a tracked floe in make_run(), at its pose in a frame.
inline TrackRow make_track(double time, const RunFrame& frame, std::size_t body) {
    TrackRow track;
    track.time = time;
    track.position = frame.position[body];
    track.orientation = frame.orientation[body];
    track.velocity = frame.velocity[body];
    track.angular_velocity = frame.angular_velocity[body];
    track.contact_force = Vec3(-10.0, 0.0, 30.0 * std::sin(time));
    track.friction_force = Vec3(-1.0, 0.0, 0.0);
    track.ice_force = Vec3(0.0, 5.0, 0.0);
    return track;
}

/// A made-up run: a box hull of 8 x 2 x 1.2 m at 1 m/s among boxes of 1 x 0.8 x 0.2 m that slide
/// along its bottom, rotating; forces are sines with known means (see the code).
inline RunData make_run(const RunSize& size = {}) {
    RunData run;
    run.header = make_header(size);
    run.tracks.resize(run.header.tracked.size());
    run.regions = {{"hull", {}, {}}, {"bottom", {}, {}}};  // a quarter and the rest of all forces
    run.panels = make_panels(size.dimension);
    for (std::size_t f = 0; f < size.frames; ++f) {
        const RunFrame frame = make_frame(size, f);
        for (std::size_t s = 0; s < size.samples_per_frame; ++s) {
            const double time = frame.time + 0.1 * static_cast<double>(s) /
                                                 static_cast<double>(size.samples_per_frame);
            const HistoryRow row = make_row(time, static_cast<double>(f % 7));
            run.history.push_back(row);
            for (const float share : {0.25f, 0.75f}) {
                RegionHistory& region = run.regions[share > 0.5f ? 1 : 0];
                region.contact.emplace_back(share * row.contact_force.cast<float>());
                region.friction.emplace_back(share * row.friction_force.cast<float>());
            }
            for (std::size_t k = 0; k < run.tracks.size(); ++k)
                run.tracks[k].push_back(
                    make_track(time, frame, static_cast<std::size_t>(run.header.tracked[k] - 1)));
        }
        run.frames.push_back(frame);
    }
    return run;
}

/// Writes the first `frames` frames of a run with their history, in the solver's order.
inline void add_frames(RunWriter& writer, const RunData& run, std::size_t frames) {
    const std::size_t per_frame = run.history.size() / run.frames.size();
    for (std::size_t f = 0; f < frames; ++f) {
        for (std::size_t s = f * per_frame; s < (f + 1) * per_frame; ++s) {
            std::vector<RegionForce> regions;
            for (const RegionHistory& r : run.regions)
                regions.push_back({r.contact[s].cast<double>(), r.friction[s].cast<double>()});
            writer.add(run.history[s], regions);
            std::vector<TrackRow> rows;
            for (const auto& track : run.tracks) rows.push_back(track[s]);
            writer.add_tracked(rows);
        }
        writer.add(run.frames[f]);
    }
}

inline void write_run(const std::filesystem::path& path, const RunData& run) {
    RunWriter writer(path, run.header);
    add_frames(writer, run, run.frames.size());
    writer.finish(run.panels);
}

}  // namespace ice::test
