// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of run.h5. In: rows of the solver's recorder. Out: the layout listed in run_file.hpp.
#include "common/formats/run_file.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/file_turn.hpp"
#include "common/base/part_file.hpp"
#include "common/formats/run_buffers.hpp"
#include "common/formats/run_parts.hpp"

namespace ice {

namespace {

// Rows of history that may wait in memory [-]: of a run that stores few frames a kill loses no
// more. About 3 MB, and more with regions and tracked floes; fewer rows mean more waits for readers
// (FileTurn).
constexpr std::uint64_t kHistoryPerFlush = 16384;

using run_parts::Column;
using run_parts::frames_per_chunk;
using run_parts::kContactChunk;
using run_parts::kHistoryChunk;
using Shape = std::vector<std::uint64_t>;
using Scales = std::vector<std::string>;
using run_parts::attach_scales;
using run_parts::write_labels;

// w, x, y, z: the order of the files (Eigen itself stores w last)
Eigen::Vector4d wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

template <class T>
void create_column(Hdf5File& file, const std::string& name, const Shape& row, std::uint64_t chunk,
                   const std::string& unit, const Scales& scales) {
    file.create_appendable<T>(name, row, chunk);
    file.write_attribute(name, "units", unit);
    attach_scales(file, name, scales);
}

void write_attributes(Hdf5File& file, const RunHeader& header) {
    file.write_attribute("/", "format", std::string("icesolve-result"));
    file.write_attribute("/", "format_version", std::int64_t{1});
    file.write_attribute("/", "dimension", std::int64_t{header.dimension});
    file.write_attribute("/", "title", header.title);
    file.write_attribute("/", "created_by", header.created_by);
    file.write_attribute("/", "git_commit", header.git_commit);
    file.write_attribute("/", "command_line", header.command_line);
    file.write_attribute("/", "case_toml", header.case_toml);
    file.write_attribute("/", "units", std::string("SI"));
    file.write_attribute("/", "average_from", {header.average_from}, {});
}

// meanings that the names alone do not give
void name_history(Hdf5File& file) {
    // In the file itself, so that it can be read without this project's documents (CF's long_name).
    const auto say = [&](const char* name, const char* text) {
        file.write_attribute(name, "long_name", text);
    };
    say("/time", "time at the end of the row's steps");
    say("/ship/contact_force", "force of the ice on the ship, normal parts, world axes");
    say("/ship/friction_force", "force of the ice on the ship, tangential parts, world axes");
    say("/ship/force", "force of the ice on the ship, world axes; resistance is -x");
    say("/ship/moment", "moment of the ice on the ship about its reference point, world axes");
    say("/ship/pose", "position of the hull mesh's origin and orientation of the ship");
    say("/ship/contacts", "hull and floe contacts that carried an impulse, mean of the steps");
    say("/ship/moving_floes", "floes that are not held");
    say("/ship/max_overlap", "deepest overlap of two bodies in the row's steps");
    say("/ship/kinetic_energy", "kinetic energy of the floes");
    say("/regions/contact_force", "force of the ice on a region of the hull, normal parts");
    say("/regions/friction_force", "force of the ice on a region of the hull, tangential parts");
    file.write_attribute("/ship/moment", "reference_point",
                         "origin of the hull's mesh (ship frame 0, 0, 0), which is at /ship/pose");
}

}  // namespace

RunWriter::Buffers::Buffers(const std::filesystem::path& path, const std::filesystem::path& part,
                            const RunHeader& header)
    : final_path(path),
      part_path(part),
      file(part_path, Hdf5File::Mode::create_growing),
      bodies(header.body_shape.size()) {
    // arrays of floes are indexed together from here on
    if (header.body_group.size() != bodies || header.body_mass.size() != bodies ||
        header.body_inertia.size() != bodies)
        throw run_failed(path.string(), "the floes' shapes, groups, masses differ in number",
                         "this is a fault of the program: please report it");
    const FileTurn turn(part_path, FileTurn::Kind::write);
    write_attributes(file, header);
    // coordinates of the arrays' short axes, so that xarray labels them
    write_labels(file, "/xyz", {"x", "y", "z"});
    write_labels(file, "/wxyz", {"w", "x", "y", "z"});
    write_labels(file, "/pose_parts", {"x", "y", "z", "qw", "qx", "qy", "qz"});
    run_parts::write_shapes(file, header);
    run_parts::write_flow_arrows(file, header);
    create_history(header);
    create_frames(header);
    create_contacts(header);
    file.flush();
}

void RunWriter::Buffers::create_history(const RunHeader& header) {
    const std::string force = header.dimension == 2 ? "N/m" : "N";
    const auto create = [&](Column<double>& column, const std::string& name, const Shape& row,
                            const std::string& unit, const Scales& scales) {
        column.name = name;
        create_column<double>(file, name, row, kHistoryChunk, unit, scales);
    };
    // Every column hangs on the scale /time, so that a reader after a kill can cut all of them to
    // the shortest.
    create(time, "/time", {}, "s", {});
    file.make_scale("/time");
    file.create_group("/ship");
    create(contact, "/ship/contact_force", {3}, force, {"/time", "/xyz"});
    create(friction, "/ship/friction_force", {3}, force, {"/time", "/xyz"});
    create(total, "/ship/force", {3}, force, {"/time", "/xyz"});
    create(moment, "/ship/moment", {3}, header.dimension == 2 ? "N" : "N m", {"/time", "/xyz"});
    // "m, 1": three lengths and a quaternion
    create(pose, "/ship/pose", {7}, "m, 1", {"/time", "/pose_parts"});
    create(contacts, "/ship/contacts", {}, "1", {"/time"});
    create(moving, "/ship/moving_floes", {}, "1", {"/time"});
    create(overlap, "/ship/max_overlap", {}, "m", {"/time"});
    create(energy, "/ship/kinetic_energy", {}, header.dimension == 2 ? "J/m" : "J", {"/time"});
    if (header.ship_is_free) {
        ship_is_free = true;
        create(ship_velocity, "/ship/velocity", {3}, "m/s", {"/time", "/xyz"});
        create(ship_angles, "/ship/angles", {3}, "rad", {"/time", "/xyz"});
        create(thrust, "/ship/thrust", {}, force, {"/time"});
        create(tow, "/ship/tow_force", {3}, force, {"/time", "/xyz"});
        file.write_attribute("/ship/velocity", "long_name",
                             "velocity of the ship's centre of gravity, world axes");
        file.write_attribute("/ship/angles", "long_name", "roll, pitch and yaw of the ship");
    }
    create_regions(header);
    name_history(file);

    write_labels(file, "/track_columns", track_columns());
    file.create_group("/tracked");
    file.write("/tracked/floe", header.tracked);
    file.make_scale("/tracked/floe");
    std::string joined;
    for (const std::string& name : track_columns()) joined += (joined.empty() ? "" : ",") + name;
    // HDF5 has no unit for each column of a row: names and units are joined in attributes.
    tracks.resize(header.tracked.size());
    for (std::size_t k = 0; k < tracks.size(); ++k) {
        create(tracks[k], "/tracked/" + std::to_string(header.tracked[k]), {track_columns().size()},
               "SI", {"/time", "/track_columns"});
        file.write_attribute(tracks[k].name, "columns", joined);
        file.write_attribute(tracks[k].name, "column_units", run_parts::track_units(force));
    }
}

void RunWriter::Buffers::create_regions(const RunHeader& header) {
    const std::vector<std::string> names = run_parts::hull_regions(header);
    dimension = header.dimension;
    regions = names.size();
    file.create_group("/regions");
    write_labels(file, "/hull_regions", names);
    for (auto& [column, name] : {std::pair(&region_contact, "/regions/contact_force"),
                                 std::pair(&region_friction, "/regions/friction_force")}) {
        // single precision: three numbers for each region in every row
        column->name = name;
        create_column<float>(file, name, {regions, 3}, kHistoryChunk,
                             header.dimension == 2 ? "N/m" : "N",
                             {"/time", "/hull_regions", "/xyz"});
    }
}

void RunWriter::Buffers::create_frames(const RunHeader& header) {
    const std::uint64_t n = bodies;
    const auto create = [&]<class T>(Column<T>& column, const std::string& name, const Shape& row,
                                     const std::string& unit, Scales scales) {
        column.name = "/frames/" + name;
        if (name != "frame_time") scales.insert(scales.begin(), "/frames/frame_time");
        // a chunk holds whole frames
        create_column<T>(file, column.name, row, frames_per_chunk(bodies), unit, scales);
    };
    file.create_group("/frames");
    run_parts::write_bodies(file, header);
    create(frame_time, "frame_time", {}, "s", {});
    file.make_scale("/frames/frame_time");
    create(ship_position, "ship_position", {3}, "m", {"/xyz"});
    if (header.ship_is_free) {
        create(ship_orientation, "ship_orientation", {4}, "1", {"/wxyz"});
        // only of a free ship; another stays upright on its course
        file.write_attribute("/frames/ship_orientation", "order", "w,x,y,z ship to world");
    }
    create(position, "position", {n, 3}, "m", {"/frames/body", "/xyz"});
    create(orientation, "orientation", {n, 4}, "1", {"/frames/body", "/wxyz"});
    create(velocity, "velocity", {n, 3}, "m/s", {"/frames/body", "/xyz"});
    create(spin, "angular_velocity", {n, 3}, "rad/s", {"/frames/body", "/xyz"});
    create(floe_force, "contact_force", {n, 3}, header.dimension == 2 ? "N/m" : "N",
           {"/frames/body", "/xyz"});
    // one byte per floe and frame
    create(state, "state", {n}, "1", {"/frames/body"});
    file.write_attribute("/frames/orientation", "order", "w,x,y,z body to world");
    file.write_attribute("/frames/contact_force", "meaning", "of the ship on the floe");
    file.write_attribute("/frames/state", "meaning", "0 held, 1 moving, 2 behind the hull");
}

void RunWriter::Buffers::create_contacts(const RunHeader& header) {
    const auto create = [&]<class T>(Column<T>& column, const std::string& name, const Shape& row,
                                     const std::string& unit, Scales scales) {
        column.name = "/contacts/" + name;
        // all columns but the time itself hang on the scale of time
        if (name != "contact_time") scales.insert(scales.begin(), "/contacts/contact_time");
        create_column<T>(file, column.name, row, kContactChunk, unit, scales);
    };
    const std::string force = header.dimension == 2 ? "N/m" : "N";
    file.create_group("/contacts");
    create(contact_time, "contact_time", {}, "s", {});
    file.make_scale("/contacts/contact_time");
    create(contact_frame, "frame", {}, "1", {});
    create(contact_floe, "floe", {}, "1", {});
    create(contact_sphere, "sphere", {}, "1", {});
    create(contact_point, "point", {3}, "m", {"/xyz"});
    create(contact_push, "normal_force", {3}, force, {"/xyz"});
    create(contact_rub, "friction_force", {3}, force, {"/xyz"});
    file.write_attribute("/contacts/frame", "meaning",
                         "row of /frames; forces since the one before");
    file.write_attribute("/contacts/point", "meaning", "ship frame, weighted by normal impulse");
}

void RunWriter::Buffers::write_all() { write_rows(true); }
void RunWriter::Buffers::write_whole_chunks() { write_rows(false); }

void RunWriter::Buffers::write_rows(bool all) {
    if (torn)
        throw run_failed(final_path.string(), "cannot be written",
                         "check that the disk is not full");
    const FileTurn turn(part_path, FileTurn::Kind::write);
    // a write that throws leaves columns of different length: no later one may follow it
    torn = true;  // until all went well
    // of the buffered rows: all, or as many as complete the file's last chunk and whole ones
    const auto take = [all](std::uint64_t& buffered, std::int64_t& on_disk, std::uint64_t chunk) {
        const auto before = static_cast<std::uint64_t>(on_disk);
        const std::uint64_t end = all ? before + buffered : (before + buffered) / chunk * chunk;
        const std::uint64_t count = end - std::min(end, before);
        buffered -= count;
        on_disk += static_cast<std::int64_t>(count);
        return count;
    };
    // append_to() needs the number of rows before take() changed it
    const std::uint64_t old_samples = samples, old_frames = frames, old_contacts = contact_rows;
    const std::uint64_t s = take(samples, written.samples, kHistoryChunk);
    const std::uint64_t f = take(frames, written.frames, frames_per_chunk(bodies));
    const std::uint64_t c = take(contact_rows, written.contacts, kContactChunk);
    for_history([&](auto& column) { column.append_to(file, s, old_samples); });
    for_frames([&](auto& column) { column.append_to(file, f, old_frames); });
    for_contacts([&](auto& column) { column.append_to(file, c, old_contacts); });
    file.flush();
    torn = false;
}

RunWriter::RunWriter(const std::filesystem::path& path, const RunHeader& header)
    : buffers_(std::make_unique<Buffers>(path, path.string() + ".part", header)) {}

RunWriter::RunWriter(RunWriter&&) noexcept = default;
RunWriter::~RunWriter() = default;

void RunWriter::add(const HistoryRow& row, const std::vector<RegionForce>& regions) {
    Buffers& b = *buffers_;
    if (!regions.empty() && regions.size() != b.regions)
        throw run_failed(b.final_path.string(), "got another number of regions than promised",
                         "this is a fault of the program: please report it");
    // before the new row, when the tracked floes' rows of the last one are complete
    if (b.samples >= kHistoryPerFlush) b.write_whole_chunks();
    b.time.add_value(row.time);
    b.contact.add(row.contact_force);
    b.friction.add(row.friction_force);
    b.total.add(Vec3(row.contact_force + row.friction_force));
    b.moment.add(row.moment);
    b.pose.add(row.ship_position);
    b.pose.add(wxyz(row.ship_orientation));
    b.contacts.add_value(row.contacts);
    b.moving.add_value(row.moving_floes);
    b.overlap.add_value(row.max_overlap);
    b.energy.add_value(row.kinetic_energy);
    if (b.ship_is_free) {
        b.ship_velocity.add(row.ship_velocity);
        b.ship_angles.add(row.ship_angles);
        b.thrust.add_value(row.thrust);
        b.tow.add(row.tow_force);
    }
    // a row without forces on regions has not-a-numbers, since a zero would count in means
    const Vec3 unknown = Vec3::Constant(std::nan(""));
    for (std::size_t r = 0; r < b.regions; ++r) {
        b.region_contact.add(regions.empty() ? unknown : regions[r].contact);
        b.region_friction.add(regions.empty() ? unknown : regions[r].friction);
    }
    ++b.samples;
}

void RunWriter::add_tracked(const std::vector<TrackRow>& rows) {
    Buffers& b = *buffers_;
    if (rows.size() != b.tracks.size())
        throw run_failed(b.final_path.string(), "got another number of tracked floes than promised",
                         "this is a fault of the program: please report it");
    for (std::size_t k = 0; k < rows.size(); ++k) {
        b.tracks[k].add(rows[k].position);
        b.tracks[k].add(wxyz(rows[k].orientation));
        for (const Vec3& v : {rows[k].velocity, rows[k].angular_velocity, rows[k].contact_force,
                              rows[k].friction_force, rows[k].ice_force})
            b.tracks[k].add(v);
    }
}

void RunWriter::add(const RunFrame& frame) {
    Buffers& b = *buffers_;
    b.frame_time.add_value(frame.time);
    b.ship_position.add(frame.ship_position);
    if (b.ship_is_free) b.ship_orientation.add(wxyz(frame.ship_orientation));
    b.position.add_all(frame.position);
    b.velocity.add_all(frame.velocity);
    b.spin.add_all(frame.angular_velocity);
    b.floe_force.add_all(frame.contact_force);
    for (const FloeState state : frame.state)
        b.state.rows.push_back(static_cast<std::uint8_t>(state));
    const auto row =
        static_cast<std::int32_t>(b.written.frames) + static_cast<std::int32_t>(b.frames);
    for (const HullContact& contact : frame.hull_contacts) {
        // contacts are one long table with the row of their frame, since their number differs by
        // frame
        b.contact_time.add_value(frame.time);
        b.contact_frame.rows.push_back(row);
        b.contact_floe.rows.push_back(contact.floe);
        b.contact_sphere.rows.push_back(contact.sphere);
        b.contact_point.add(contact.point);
        b.contact_push.add(contact.normal_force);
        b.contact_rub.add(contact.friction_force);
        ++b.contact_rows;
    }
    // q and -q are the same rotation: keep the sign nearer to the last frame, for interpolation
    std::vector<Eigen::Quaterniond>& last = b.written.last_orientation;
    last.resize(b.bodies, Eigen::Quaterniond::Identity());
    for (std::size_t k = 0; k < frame.orientation.size(); ++k) {
        Eigen::Quaterniond q = frame.orientation[k];
        if (q.dot(last[k]) < 0.0) q.coeffs() = -q.coeffs();
        b.orientation.add(wxyz(q));
        last[k] = q;
    }
    if (++b.frames >= frames_per_chunk(b.bodies)) b.write_whole_chunks();
}

bool RunWriter::is_about_to_write() const {
    return buffers_->samples + 1 >= kHistoryPerFlush ||
           buffers_->frames + 1 >= frames_per_chunk(buffers_->bodies);
}

void RunWriter::finish(const HullPanels& panels) {
    Buffers& b = *buffers_;
    // the rest of the buffers; then the file gets its name, and is whole whenever it has it
    b.write_all();
    const FileTurn turn(b.part_path, FileTurn::Kind::write);
    if (!panels.panels.empty()) run_parts::write_panels(b.file, panels, b.dimension);
    b.file.close();
    keep_file(b.part_path, b.final_path);
    remove_saved_rows(b.final_path.parent_path());  // the finished file has them all
}

}  // namespace ice
