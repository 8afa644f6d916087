// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of run.h5: checks everything it indexes with, because a file may be damaged or foreign.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "common/base/error.hpp"
#include "common/base/file_turn.hpp"
#include "common/formats/pieces_file.hpp"
#include "common/formats/run_arrays.hpp"
#include "common/formats/run_file.hpp"

namespace ice {

namespace {

constexpr const char* kRegionForces[] = {"/regions/contact_force", "/regions/friction_force"};

class RunFileReader : RunArrays {
public:
    explicit RunFileReader(const std::filesystem::path& path) : RunArrays(path) {}

    RunData read() {
        // header and shapes first: the later arrays are checked against their numbers
        RunData run;
        read_header(run.header);
        read_shapes(run.header.shapes);
        read_bodies(run.header);
        read_flow_arrows(run.header);
        read_history(run);
        read_regions(run);
        read_tracks(run);
        read_frames(run);
        read_contacts(run);
        read_panels(run);
        return run;
    }

private:
    void read_header(RunHeader& header) const {
        // The format before all else: another HDF5 file is named as such, not by its first missing
        // array.
        check(file().has_attribute("/", "format") &&
                  file().read_text_attribute("/", "format") == "icesolve-result",
              "/", "is not the result of a run (no attribute format = \"icesolve-result\")");
        check(file().read_number_attribute("/", "format_version")[0] == 1, "/",
              "has a format_version this program does not know");
        header.dimension = static_cast<int>(file().read_number_attribute("/", "dimension")[0]);
        check(header.dimension == 2 || header.dimension == 3, "dimension", "is neither 2 nor 3");
        header.title = file().read_text_attribute("/", "title");
        header.created_by = file().read_text_attribute("/", "created_by");
        header.git_commit = file().read_text_attribute("/", "git_commit");
        header.command_line = file().read_text_attribute("/", "command_line");
        header.case_toml = file().read_text_attribute("/", "case_toml");
        if (file().has_attribute("/", "average_from"))
            header.average_from = file().read_number_attribute("/", "average_from")[0];
        header.tracked = file().read<std::int32_t>("/tracked/floe");
    }

    void read_shapes(std::vector<RunShape>& shapes) const {
        const std::uint64_t count = length("/shapes/vertex_offset");
        // a million: an ice field of so many different floes would not fit into memory
        check(count >= 1 && count < 1000000, "/shapes/vertex_offset", "has no shapes");
        // offsets have one entry more than there are shapes: the end of the last
        shapes.resize(count - 1);
        const auto names = file().read_strings("/region_names");
        for (RunShape& shape : shapes) shape.mesh.region_names = names;
        read_vertices(shapes);
        read_triangles(shapes, names.size());
        read_spheres(shapes);
    }

    void read_vertices(std::vector<RunShape>& shapes) const {
        // All shapes' vertices are in one array [rows x 3]; shape s has rows offset[s] to
        // offset[s + 1].
        const std::uint64_t rows = rows_of("/shapes/vertices");
        const auto all = points("/shapes/vertices", {rows});
        const auto offset = offsets("/shapes/vertex_offset", shapes.size(), rows);
        for (std::size_t s = 0; s < shapes.size(); ++s)
            shapes[s].mesh.vertices.assign(all.begin() + offset[s], all.begin() + offset[s + 1]);
    }

    void read_triangles(std::vector<RunShape>& shapes, std::size_t regions) const {
        const std::uint64_t rows = rows_of("/shapes/triangles");
        // Corners count from the shape's own first vertex, so that a shape can be moved in the
        // array.
        const auto corners = read_as<std::int32_t>("/shapes/triangles", {rows, 3});
        const auto region = read_as<std::int32_t>("/shapes/region", {rows});
        const auto offset = offsets("/shapes/triangle_offset", shapes.size(), rows);
        // before anything is indexed with them
        for (const std::int32_t r : region)
            check(r >= 0 && r < static_cast<std::int32_t>(regions), "/shapes/region",
                  "points outside /region_names");
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            TriangleMesh& mesh = shapes[s].mesh;
            const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
            mesh.region.assign(region.begin() + offset[s], region.begin() + offset[s + 1]);
            for (auto t = static_cast<std::size_t>(3 * offset[s]);
                 t < static_cast<std::size_t>(3 * offset[s + 1]); t += 3) {
                mesh.triangles.push_back({corners[t], corners[t + 1], corners[t + 2]});
                for (const std::int32_t v : mesh.triangles.back())
                    check(v >= 0 && v < vertices, "/shapes/triangles",
                          "points outside the vertices");
            }
        }
    }

    void read_spheres(std::vector<RunShape>& shapes) const {
        const std::uint64_t rows = rows_of("/shapes/spheres");
        // [rows x 4]: centre and radius [m]
        const auto flat = read_as<double>("/shapes/spheres", {rows, 4});
        const auto offset = offsets("/shapes/sphere_offset", shapes.size(), rows);
        for (std::size_t s = 0; s < shapes.size(); ++s)
            for (auto k = static_cast<std::size_t>(4 * offset[s]);
                 k < static_cast<std::size_t>(4 * offset[s + 1]); k += 4) {
                shapes[s].centers.emplace_back(flat[k], flat[k + 1], flat[k + 2]);
                shapes[s].radii.push_back(flat[k + 3]);
            }
    }

    void read_bodies(RunHeader& header) const {
        const std::uint64_t bodies = length("/frames/body");
        header.body_shape = read_as<std::int32_t>("/frames/body_shape", {bodies});
        header.body_group = read_as<std::int32_t>("/frames/body_group", {bodies});
        header.body_mass = read_as<double>("/frames/mass", {bodies});
        header.body_inertia = points("/frames/inertia", {bodies});
        for (const std::int32_t shape : header.body_shape)
            check(shape >= 0 && shape < static_cast<std::int32_t>(header.shapes.size()),
                  "/frames/body_shape", "points outside the shapes");
        // floes are numbered from 1, in files as in messages
        for (const std::int32_t id : header.tracked)
            check(id >= 1 && id <= static_cast<std::int32_t>(bodies), "/tracked/floe",
                  "names a floe that does not exist");
    }

    void read_flow_arrows(RunHeader& header) const {
        // only runs with [flow] have arrows
        if (!file().has("/flow/point")) return;
        const std::uint64_t rows = rows_of("/flow/point");
        header.flow_point = points("/flow/point", {rows});
        header.flow_velocity = points("/flow/velocity", {rows});
    }

    void read_history(RunData& run) const {
        // A killed run may have flushed some columns further than others: all are read up to the
        // shortest.
        std::vector<std::string> names{"/time"};
        for (const char* name : {"contact_force", "friction_force", "moment", "pose", "contacts",
                                 "moving_floes", "max_overlap", "kinetic_energy"})
            names.push_back(std::string("/ship/") + name);
        if (file().has("/ship/velocity"))
            for (const char* name : {"velocity", "angles", "thrust", "tow_force"})
                names.push_back(std::string("/ship/") + name);
        for (const std::int32_t id : run.header.tracked)
            names.push_back("/tracked/" + std::to_string(id));
        if (file().has("/regions"))
            for (const char* name : kRegionForces) names.emplace_back(name);
        const std::uint64_t n = common_rows(names);
        const auto time = read_as<double>("/time", {n});
        const auto contact = points("/ship/contact_force", {n});
        const auto friction = points("/ship/friction_force", {n});
        const auto moment = points("/ship/moment", {n});
        const auto pose = read_as<double>("/ship/pose", {n, 7});
        const auto contacts = read_as<double>("/ship/contacts", {n});
        const auto moving = read_as<double>("/ship/moving_floes", {n});
        const auto overlap = read_as<double>("/ship/max_overlap", {n});
        const auto energy = read_as<double>("/ship/kinetic_energy", {n});
        run.history.resize(n);
        for (std::size_t k = 0; k < n; ++k)
            run.history[k] = {time[k],
                              contact[k],
                              friction[k],
                              moment[k],
                              Vec3(pose[7 * k], pose[7 * k + 1], pose[7 * k + 2]),
                              contacts[k],
                              moving[k],
                              overlap[k],
                              energy[k]};
        for (std::size_t k = 0; k < n; ++k) {
            // Stored as w, x, y, z; normalised, because a resampled file may have rounded it.
            const double* q = pose.data() + 7 * k + 3;
            run.history[k].ship_orientation =
                Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
        }
        read_ship_motion(run);
    }

    // of a free ship; others keep their course
    void read_ship_motion(RunData& run) const {
        run.header.ship_is_free = file().has("/ship/velocity");
        if (!run.header.ship_is_free) return;
        const std::uint64_t n = run.history.size();
        const auto velocity = points("/ship/velocity", {n});
        const auto angles = points("/ship/angles", {n});
        const auto thrust = read_as<double>("/ship/thrust", {n});
        const auto tow = points("/ship/tow_force", {n});
        for (std::size_t k = 0; k < n; ++k) {
            HistoryRow& row = run.history[k];
            row.ship_velocity = velocity[k];
            row.ship_angles = angles[k];
            row.thrust = thrust[k];
            row.tow_force = tow[k];
        }
    }

    void read_regions(RunData& run) const {
        if (!file().has("/regions")) return;  // a run of a version that did not record them
        const auto names = file().read_strings("/hull_regions");
        const std::size_t n = run.history.size(), regions = names.size();
        const auto contact = read_as<float>(kRegionForces[0], {n, regions, 3});
        // rows of time, then regions, then x, y, z
        const auto friction = read_as<float>(kRegionForces[1], {n, regions, 3});
        for (std::size_t r = 0; r < regions; ++r) {
            RegionHistory history{names[r], {}, {}};
            for (std::size_t k = 0; k < n; ++k) {
                const std::size_t at = 3 * (k * regions + r);
                history.contact.emplace_back(contact[at], contact[at + 1], contact[at + 2]);
                history.friction.emplace_back(friction[at], friction[at + 1], friction[at + 2]);
            }
            run.regions.push_back(std::move(history));
        }
    }

    void read_tracks(RunData& run) const {
        // [rows x 22] per floe, in the rows of the history
        const std::uint64_t columns = track_columns().size();
        for (const std::int32_t id : run.header.tracked) {
            const auto flat =
                read_as<double>("/tracked/" + std::to_string(id), {run.history.size(), columns});
            std::vector<TrackRow> rows(run.history.size());
            for (std::size_t k = 0; k < rows.size(); ++k) {
                // the order of track_columns()
                const double* v = flat.data() + columns * k;
                TrackRow& row = rows[k];
                row.time = run.history[k].time;
                row.position = Vec3(v[0], v[1], v[2]);
                row.orientation = Eigen::Quaterniond(v[3], v[4], v[5], v[6]);
                row.velocity = Vec3(v[7], v[8], v[9]);
                row.angular_velocity = Vec3(v[10], v[11], v[12]);
                row.contact_force = Vec3(v[13], v[14], v[15]);
                row.friction_force = Vec3(v[16], v[17], v[18]);
                row.ice_force = Vec3(v[19], v[20], v[21]);
            }
            run.tracks.push_back(std::move(rows));
        }
    }

    void read_frames(RunData& run) const {
        std::vector<std::string> names{"/frames/frame_time",    "/frames/ship_position",
                                       "/frames/position",      "/frames/orientation",
                                       "/frames/velocity",      "/frames/angular_velocity",
                                       "/frames/contact_force", "/frames/state"};
        if (file().has("/frames/ship_orientation")) names.emplace_back("/frames/ship_orientation");
        // of a run that is still written one column may be longer than another: the rows that all
        // have
        const std::uint64_t frames = common_rows(names);
        const std::uint64_t n = run.header.body_shape.size();
        const auto time = read_as<double>("/frames/frame_time", {frames});
        const auto ship = points("/frames/ship_position", {frames});
        const auto position = points("/frames/position", {frames, n});
        const auto orientation = read_as<double>("/frames/orientation", {frames, n, 4});
        const auto velocity = points("/frames/velocity", {frames, n});
        const auto spin = points("/frames/angular_velocity", {frames, n});
        const auto force = points("/frames/contact_force", {frames, n});
        const auto state = read_as<std::uint8_t>("/frames/state", {frames, n});
        std::vector<double> attitude;  // of a free ship
        if (file().has("/frames/ship_orientation"))
            attitude = read_as<double>("/frames/ship_orientation", {frames, 4});
        run.frames.resize(frames);
        for (std::size_t f = 0; f < frames; ++f) {
            RunFrame& frame = run.frames[f];
            const auto part = [&](const std::vector<Vec3>& all) {
                const auto begin = all.begin() + static_cast<std::ptrdiff_t>(f * n);
                return std::vector<Vec3>(begin, begin + static_cast<std::ptrdiff_t>(n));
            };
            frame.time = time[f];
            frame.ship_position = ship[f];
            if (!attitude.empty()) {
                const double* q = attitude.data() + 4 * f;
                frame.ship_orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
            }
            frame.position = part(position);
            frame.velocity = part(velocity);
            frame.angular_velocity = part(spin);
            frame.contact_force = part(force);
            for (std::size_t k = f * n; k < (f + 1) * n; ++k) {
                const double* q = orientation.data() + 4 * k;
                // stored as float: unit again
                frame.orientation.push_back(
                    Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized());
                check(state[k] <= 2, "/frames/state", "holds a state that is not 0, 1 or 2");
                frame.state.push_back(static_cast<FloeState>(state[k]));
            }
        }
    }

    void read_contacts(RunData& run) const {
        if (!file().has("/contacts")) return;  // a run of a version that did not record them
        const std::uint64_t n =
            common_rows({"/contacts/frame", "/contacts/floe", "/contacts/sphere", "/contacts/point",
                         "/contacts/normal_force", "/contacts/friction_force"});
        const auto frame = read_as<std::int32_t>("/contacts/frame", {n});
        const auto floe = read_as<std::int32_t>("/contacts/floe", {n});
        const auto sphere = read_as<std::int32_t>("/contacts/sphere", {n});
        const auto point = points("/contacts/point", {n});
        const auto push = points("/contacts/normal_force", {n});
        const auto rub = points("/contacts/friction_force", {n});
        const auto floes = static_cast<std::int32_t>(run.header.body_shape.size());
        for (std::size_t k = 0; k < n; ++k) {
            // contacts of a frame that is not yet written whole
            // In a file that is complete the same is damage, which the check below reports.
            if (growing() && static_cast<std::size_t>(frame[k]) >= run.frames.size()) break;
            check(frame[k] >= 0 && static_cast<std::size_t>(frame[k]) < run.frames.size(),
                  "/contacts/frame", "points outside the frames");
            check(floe[k] >= 1 && floe[k] <= floes, "/contacts/floe",
                  "names a floe that does not exist");
            run.frames[static_cast<std::size_t>(frame[k])].hull_contacts.push_back(
                {floe[k], sphere[k], point[k], push[k], rub[k]});
        }
    }

    void read_panels(RunData& run) const {
        if (!file().has("/panels")) return;  // a killed run, or of a version that had none
        HullPanels& hull = run.panels;
        hull.size = file().read_number_attribute("/panels", "size")[0];
        hull.window = file().read_number_attribute("/panels", "window")[0];
        // One row per panel [P]; the spheres of the hull name their panel, so a map needs no
        // geometry.
        const auto region = file().read<std::int32_t>("/panels/region");
        const std::uint64_t n = region.size();
        const auto center = points("/panels/center", {n}), normal = points("/panels/normal", {n});
        const auto regions = static_cast<std::int32_t>(length("/hull_regions"));
        for (std::size_t k = 0; k < n; ++k) {
            check(region[k] >= 0 && region[k] < regions, "/panels/region",
                  "points outside /hull_regions");
            hull.panels.push_back({region[k], center[k], normal[k]});
        }
        const auto column = [&](const char* name, double PanelLoad::*member) {
            const auto values = read_as<double>(std::string("/panels/") + name, {n});
            for (std::size_t k = 0; k < n; ++k) hull.panels[k].*member = values[k];
        };
        column("area", &PanelLoad::area);
        column("length", &PanelLoad::length);
        column("force_mean", &PanelLoad::mean);
        column("force_p99", &PanelLoad::p99);
        column("force_max", &PanelLoad::max);
        hull.of_sphere = file().read<std::int32_t>("/shapes/hull_panel");
        for (const std::int32_t row : hull.of_sphere)
            check(row >= 0 && row < static_cast<std::int32_t>(n), "/shapes/hull_panel",
                  "points outside the panels");
    }
};

}  // namespace

const std::vector<std::string>& track_columns() {
    static const std::vector<std::string> names{
        "x",           "y",          "z",          "qw",         "qx",          "qy",
        "qz",          "vx",         "vy",         "vz",         "wx",          "wy",
        "wz",          "contact_fx", "contact_fy", "contact_fz", "friction_fx", "friction_fy",
        "friction_fz", "ice_fx",     "ice_fy",     "ice_fz"};
    return names;
}

RunData read_run(const std::filesystem::path& path) {
    // one that is being created just now is whole a moment later
    // Half a second in all: the writer creates the datasets within a few milliseconds, and a file
    // that is torn for good must not be waited for.
    for (int left = is_growing(path) ? 5 : 0;; --left) {
        try {
            std::optional<FileTurn> turn;
            if (is_growing(path)) turn.emplace(path, FileTurn::Kind::read);
            RunData run = RunFileReader(path).read();
            const std::filesystem::path pieces = path.parent_path() / kPiecesName;
            if (std::filesystem::exists(pieces)) show_pieces(read_pieces(pieces), run);
            return run;
        } catch (const Error&) {
            if (left == 0) throw;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

}  // namespace ice
