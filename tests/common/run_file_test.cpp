// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/run_file.hpp"

#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "common/formats/hdf5_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// poses are stored as float: 1e-6 of some 10 m
constexpr double kPose = 1e-6;

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    if (a.size() != b.size()) return 1e300;
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
    return most;
}

void check_frame(const RunFrame& a, const RunFrame& b) {
    CHECK(a.time == b.time);
    CHECK(a.ship_position == b.ship_position);
    CHECK(a.ship_orientation.angularDistance(b.ship_orientation) < kPose);
    CHECK(distance(a.position, b.position) < kPose);
    CHECK(distance(a.velocity, b.velocity) < kPose);
    CHECK(distance(a.angular_velocity, b.angular_velocity) < kPose);
    CHECK(distance(a.contact_force, b.contact_force) < 300 * kPose);
    CHECK(a.state == b.state);
    REQUIRE(a.orientation.size() == b.orientation.size());
    for (std::size_t k = 0; k < a.orientation.size(); ++k)
        CHECK(a.orientation[k].angularDistance(b.orientation[k]) < kPose);
    REQUIRE(a.hull_contacts.size() == b.hull_contacts.size());
    for (std::size_t k = 0; k < a.hull_contacts.size(); ++k) {
        const HullContact &x = a.hull_contacts[k], &y = b.hull_contacts[k];
        CHECK(x.floe == y.floe);
        CHECK(x.sphere == y.sphere);
        CHECK((x.point - y.point).norm() < 10 * kPose);
        CHECK(x.normal_force == y.normal_force);  // whole numbers: exact as float
        CHECK(x.friction_force == y.friction_force);
    }
}

void check_track(const TrackRow& a, const TrackRow& b) {
    CHECK(a.position == b.position);
    CHECK(a.orientation.coeffs() == b.orientation.coeffs());
    CHECK(a.velocity == b.velocity);
    CHECK(a.angular_velocity == b.angular_velocity);
    CHECK(a.contact_force == b.contact_force);
    CHECK(a.friction_force == b.friction_force);
    CHECK(a.ice_force == b.ice_force);
}

void check_history(const RunData& a, const RunData& b, std::size_t rows) {
    REQUIRE(b.history.size() == rows);
    for (std::size_t k = 0; k < rows; ++k) {
        const HistoryRow &x = a.history[k], &y = b.history[k];
        REQUIRE(x.time == y.time);
        REQUIRE(x.contact_force == y.contact_force);
        REQUIRE(x.friction_force == y.friction_force);
        REQUIRE(x.moment == y.moment);
        REQUIRE(x.ship_position == y.ship_position);
        REQUIRE(x.contacts == y.contacts);
        REQUIRE(x.moving_floes == y.moving_floes);
        REQUIRE(x.max_overlap == y.max_overlap);
        REQUIRE(x.kinetic_energy == y.kinetic_energy);
    }
    REQUIRE(b.regions.size() == a.regions.size());
    for (std::size_t r = 0; r < a.regions.size(); ++r) {
        CHECK(b.regions[r].name == a.regions[r].name);
        REQUIRE(b.regions[r].contact.size() == rows);
        REQUIRE(b.regions[r].friction.size() == rows);
        for (std::size_t k = 0; k < rows; ++k) {
            REQUIRE(b.regions[r].contact[k] == a.regions[r].contact[k]);
            REQUIRE(b.regions[r].friction[k] == a.regions[r].friction[k]);
        }
    }
}

}  // namespace

TEST_CASE("a run of 6 floes, 45 frames and 450 samples comes back", "[formats]") {
    const TempFolder folder;
    const RunData run = make_run({.dimension = GENERATE(2, 3)});
    write_run(folder / "run.h5", run);
    CHECK(folder.file_count() == 1);  // no .part left
    const RunData back = read_run(folder / "run.h5");

    CHECK(back.header.dimension == run.header.dimension);
    CHECK(back.header.title == run.header.title);
    CHECK(back.header.case_toml == run.header.case_toml);
    CHECK(back.header.command_line == run.header.command_line);
    CHECK(back.header.body_shape == run.header.body_shape);
    CHECK(back.header.body_group == run.header.body_group);
    CHECK(back.header.body_mass == run.header.body_mass);
    CHECK(back.header.body_inertia == run.header.body_inertia);
    CHECK(back.header.tracked == run.header.tracked);
    CHECK(back.header.flow_point == run.header.flow_point);
    CHECK(back.header.flow_velocity == run.header.flow_velocity);
    CHECK(back.header.average_from == 1.5);
    check_history(run, back, 450);
    CHECK(back.panels.size == 0.5);
    CHECK(back.panels.window == 0.1);
    CHECK(back.panels.of_sphere == run.panels.of_sphere);
    REQUIRE(back.panels.panels.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        const PanelLoad &a = run.panels.panels[k], &b = back.panels.panels[k];
        CHECK(a.region == b.region);
        CHECK(a.center == b.center);
        CHECK(a.normal == b.normal);
        CHECK(std::array{a.area, a.length, a.mean, a.p99, a.max} ==
              std::array{b.area, b.length, b.mean, b.p99, b.max});
    }
    REQUIRE(back.frames.size() == 45);
    for (std::size_t f = 0; f < 45; ++f) check_frame(run.frames[f], back.frames[f]);
    REQUIRE(back.tracks.size() == 2);
    REQUIRE(back.tracks[1].size() == 450);
    check_track(run.tracks[1][449], back.tracks[1][449]);
    CHECK(back.tracks[0][7].time == run.history[7].time);
}

TEST_CASE("meshes, regions and spheres of the shapes come back to float precision", "[formats]") {
    const TempFolder folder;
    const RunData run = make_run();
    write_run(folder / "run.h5", run);
    const RunData back = read_run(folder / "run.h5");
    REQUIRE(back.header.shapes.size() == 2);
    for (std::size_t s = 0; s < 2; ++s) {
        const RunShape &a = run.header.shapes[s], &b = back.header.shapes[s];
        CHECK(distance(a.mesh.vertices, b.mesh.vertices) < kPose);
        CHECK(a.mesh.triangles == b.mesh.triangles);
        CHECK(distance(a.centers, b.centers) < kPose);
        CHECK(b.radii.size() == a.radii.size());
        for (std::size_t t = 0; t < a.mesh.region.size(); ++t)
            CHECK(b.mesh.region_names[static_cast<std::size_t>(b.mesh.region[t])] ==
                  a.mesh.region_names[static_cast<std::size_t>(a.mesh.region[t])]);
    }
    CHECK(back.header.shapes[0].mesh.region_names == run.header.shapes[0].mesh.region_names);
}

TEST_CASE("a run of 45 frames so far, alive or killed, can be read up to the flush at frame 40",
          "[formats]") {
    const TempFolder folder;
    RunData run = make_run();
    // so many contacts that some of their chunks, of 1024 rows, are whole by frame 40
    for (RunFrame& frame : run.frames)
        while (!frame.hull_contacts.empty() && frame.hull_contacts.size() < 100)
            frame.hull_contacts.push_back(frame.hull_contacts.front());
    int ready[2] = {};
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0) {
        RunWriter writer(folder / "run.h5", run.header);
        add_frames(writer, run, 45);
        const bool told = write(ready[1], "x", 1) == 1;
        while (told) pause();
        _exit(1);
    }
    char byte = 0;
    REQUIRE(read(ready[0], &byte, 1) == 1);
    const RunData alive = read_run(folder / "run.h5.part");
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ready[0]);
    close(ready[1]);
    CHECK(WIFSIGNALED(status));
    CHECK_FALSE(std::filesystem::exists(folder / "run.h5"));
    const RunData killed = read_run(folder / "run.h5.part");
    for (const RunData* back : {&alive, &killed}) {
        REQUIRE(back->frames.size() == 40);
        check_history(run, *back, 384);  // whole chunks of 64 rows of the 400
        check_frame(run.frames[20], back->frames[20]);
        CHECK(distance(run.frames[39].position, back->frames[39].position) < kPose);
        std::size_t contacts = 0;
        for (const RunFrame& frame : back->frames) contacts += frame.hull_contacts.size();
        CHECK(contacts > 0);
        CHECK(contacts % 1024 == 0);
    }
}

TEST_CASE("a run that writes without a pause is read whole at any moment", "[formats]") {
    const TempFolder folder;
    const RunData run = make_run();
    const pid_t child = fork();
    if (child == 0) {
        RunWriter busy(folder / "busy.h5", run.header);
        for (int k = 0; k < 1'000'000; ++k) {
            busy.add(run.history[0]);
            busy.add_tracked({run.tracks[0][0], run.tracks[1][0]});
            busy.add(run.frames[1]);
        }
        _exit(1);
    }
    const auto part = folder / "busy.h5.part";
    for (int k = 0; k < 600 && !std::filesystem::exists(part); ++k) usleep(10'000);
    std::size_t before = 0;
    for (int k = 0; k < 20 || (before == 0 && k < 6000); ++k) {  // a busy machine may start late
        if (before == 0) usleep(10'000);
        const RunData now = read_run(part);
        CHECK(now.frames.size() % 20 == 0);  // a flush, no part of one
        CHECK(now.history.size() == now.frames.size() / 64 * 64);
        CHECK(now.frames.size() >= before);
        before = now.frames.size();
    }
    CHECK(before > 0);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));  // it was writing all the while
}

TEST_CASE("a copy of the .part file taken during the run can be read", "[formats]") {
    const TempFolder folder;
    const RunData run = make_run();
    const std::size_t frames = GENERATE(0u, 19u, 20u, 41u);
    RunWriter writer(folder / "run.h5", run.header);
    add_frames(writer, run, frames);
    std::filesystem::copy(folder / "run.h5.part", folder / "copy.h5");
    CHECK(read_run(folder / "copy.h5").frames.size() == frames / 20 * 20);
}

TEST_CASE("of arrays that are written while they are read, as many rows come as all have",
          "[formats]") {
    const TempFolder folder;
    const RunData run = make_run();
    write_run(folder / "run.h5", run);
    const auto with_one_longer = [&](const char* name) {
        std::filesystem::copy(folder / "run.h5", folder / name);
        const hid_t file = H5Fopen((folder / name).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        for (const auto& [dataset, rows] :
             {std::pair("/ship/contact_force", 460), std::pair("/frames/ship_position", 50)}) {
            const hid_t longer = H5Dopen2(file, dataset, H5P_DEFAULT);
            const hsize_t shape[] = {static_cast<hsize_t>(rows), 3};
            REQUIRE(H5Dset_extent(longer, shape) >= 0);
            H5Dclose(longer);
        }
        H5Fclose(file);
        return folder / name;
    };
    CHECK_THAT(error_text([&] { read_run(with_one_longer("ended.h5")); }),
               Catch::Contains("/ship/contact_force: has another shape"));
    const RunData alive = read_run(with_one_longer("run.h5.part"));
    check_history(run, alive, 450);
    CHECK(alive.frames.size() == 45);
}

TEST_CASE("a run without frames is flushed with every 16384th sample", "[formats]") {
    const TempFolder folder;
    const RunData run = make_run();
    RunWriter writer(folder / "run.h5", run.header);
    for (int k = 0; k < 16385; ++k) {
        writer.add(run.history[0]);
        writer.add_tracked({run.tracks[0][0], run.tracks[1][0]});
    }
    std::filesystem::copy(folder / "run.h5.part", folder / "copy.h5");
    CHECK(read_run(folder / "copy.h5").history.size() == 16384);
    writer.finish();
    CHECK(read_run(folder / "run.h5").tracks[1].size() == 16385);
}

TEST_CASE("a run with 0 floes and one with 0 samples come back", "[formats]") {
    const TempFolder folder;
    write_run(folder / "a.h5", make_run({.floes = 0, .frames = 3}));
    CHECK(read_run(folder / "a.h5").frames.size() == 3);
    RunWriter writer(folder / "b.h5", make_run().header);
    writer.finish();
    CHECK(read_run(folder / "b.h5").history.empty());
}

TEST_CASE("orientations are stored with the sign nearer to the frame before", "[formats]") {
    const TempFolder folder;
    RunData run = make_run({.floes = 1, .frames = 10});
    for (std::size_t f = 0; f < 10; ++f) {
        Eigen::Quaterniond q(Eigen::AngleAxisd(0.4 * static_cast<double>(f), Vec3::UnitZ()));
        if (f % 2) q.coeffs() = -q.coeffs();
        run.frames[f].orientation = {q};
    }
    write_run(folder / "run.h5", run);
    const RunData back = read_run(folder / "run.h5");
    for (std::size_t f = 1; f < 10; ++f)
        CHECK(back.frames[f].orientation[0].dot(back.frames[f - 1].orientation[0]) > 0.9);
}

TEST_CASE("what is no result, or cut off, is refused with the file's name", "[formats]") {
    const TempFolder folder;
    CHECK_THAT(error_text([&] { read_run(folder / "run.h5"); }), Catch::Contains("file not found"));
    { Hdf5File file(folder / "other.h5", Hdf5File::Mode::create); }
    CHECK_THAT(error_text([&] { read_run(folder / "other.h5"); }),
               Catch::Contains("is not the result of a run"));
    write_run(folder / "run.h5", make_run());
    const std::string bytes = read_bytes(folder / "run.h5");
    for (std::size_t part = 1; part < 8; ++part) {
        write_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() * part / 8));
        CHECK_THAT(error_text([&] { read_run(folder / "cut.h5"); }), Catch::Contains("cut.h5"));
    }
}

TEST_CASE("a run cannot be started in a folder that does not exist", "[formats]") {
    const TempFolder folder;
    CHECK_THAT(error_text([&] { RunWriter(folder / "no/run.h5", make_run().header); }),
               Catch::Contains("cannot be created"));
}
