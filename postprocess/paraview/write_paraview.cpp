// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/paraview/write_paraview.hpp"

#include <fmt/format.h>

#include <numeric>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "postprocess/paraview/view_script.hpp"
#include "postprocess/paraview/xdmf.hpp"
#include "postprocess/statistics/load_map.hpp"

namespace ice::paraview {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFiles[] = {"run.xdmf", "shapes.xdmf", "arrays.h5", "view.py"};
// The water's plane reaches this far beyond ice and ship [m]: enough to show that it continues. A
// larger value makes ship and ice small beside the water.
constexpr double kRoom = 2.0;

void add_point(std::vector<float>& list, const Vec3& p) {
    for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
}

// [V x 3] corners of a mesh, turned and then moved [m].
std::vector<float> posed(const TriangleMesh& mesh, const Vec3& shift,
                         const Mat3& turn = Mat3::Identity()) {
    std::vector<float> out;
    for (const Vec3& v : mesh.vertices) add_point(out, shift + turn * v);
    return out;
}

std::vector<std::int32_t> counted(std::size_t count) {
    std::vector<std::int32_t> out(count);
    std::iota(out.begin(), out.end(), 0);
    return out;
}

// A surface's triangles by named region, with values per triangle, all constant in time.
struct HullParts {
    struct Part {
        std::string name;
        StoredArray triangles;
        std::vector<NamedArray> values;
    };
    TriangleMesh mesh;
    std::vector<Part> parts;
};

class Writer {
public:
    Writer(const RunData& run, const fs::path& folder, const ParaviewOptions& options)
        : run_(run), options_(options), folder_(folder), arrays_(folder / "arrays.h5") {
        arrays_.begin_group("still");
        if (run.header.dimension == 2) force_unit_ = "_N_per_m";
    }

    std::size_t write() {
        prepare();
        std::size_t count = 0;
        const std::size_t step = std::max<std::size_t>(1, options_.every);
        for (std::size_t f = 0; f < run_.frames.size(); f += step) add_frame(f, count++);
        // Lists last: they name arrays that are complete by then, and a list without arrays would
        // be an error in ParaView.
        write_shapes();
        arrays_.close();
        write_text_file(folder_ / "run.xdmf", run_file_.text());
        write_text_file(folder_ / "view.py", view_script(folder_, force_unit_));
        return count;
    }

private:
    // Constant data are stored once and named by the grids of all frames.
    StoredArray still(const char* name, const auto& values, std::uint64_t columns = 1) {
        return arrays_.add(std::string("/still/") + name, values, columns);
    }

    // Data of all frames in common.
    void prepare() {
        const RunHeader& header = run_.header;
        bodies_ = {still("body", ids(false)), still("shape", of_bodies(header.body_shape, false)),
                   still("group", of_bodies(header.body_group, false))};
        vertices_ = still("vertices", counted(header.body_shape.size()));
        make_water();
        if (options_.points_only) return;
        surfaces_ = {still("body_of_triangle", ids(true)),
                     still("shape_of_triangle", of_bodies(header.body_shape, true)),
                     still("group_of_triangle", of_bodies(header.body_group, true))};
        triangles_ = still("triangles", floe_triangles(), 3);
        make_hull();
    }

    const TriangleMesh& mesh_of(std::size_t floe) const {
        return run_.header.shapes[static_cast<std::size_t>(run_.header.body_shape[floe])].mesh;
    }
    // One value per floe, or each as often as the floe has triangles.
    template <class T>
    std::vector<T> of_bodies(const std::vector<T>& values, bool per_triangle,
                             std::size_t columns = 1) const {
        if (!per_triangle) return values;
        // one row per floe, repeated for each of its triangles, in the order of
        // floe_triangles()
        std::vector<T> out;
        for (std::size_t b = 0; b < values.size() / columns; ++b)
            for (std::size_t t = 0; t < mesh_of(b).triangles.size(); ++t)
                out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(columns * b),
                           values.begin() + static_cast<std::ptrdiff_t>(columns * (b + 1)));
        return out;
    }
    std::vector<std::int32_t> ids(bool per_triangle) const {
        std::vector<std::int32_t> out = counted(run_.header.body_shape.size());
        // floes are numbered from 1, as in run.h5
        for (std::int32_t& id : out) ++id;
        return of_bodies(out, per_triangle);
    }
    std::vector<std::int32_t> floe_triangles() const {
        std::vector<std::int32_t> out;
        std::int32_t first = 0;
        for (std::size_t b = 0; b < run_.header.body_shape.size(); ++b) {
            for (const auto& triangle : mesh_of(b).triangles)
                for (const std::int32_t corner : triangle) out.push_back(first + corner);
            // vertices of the floes follow each other in a frame's array
            first += static_cast<std::int32_t>(mesh_of(b).vertices.size());
        }
        return out;
    }

    void make_water() {
        Eigen::AlignedBox3d box;
        const TriangleMesh& hull = run_.header.shapes[0].mesh;
        // the water's plane covers ship and floes at the first and the last frame
        for (const RunFrame* frame : {&run_.frames.front(), &run_.frames.back()}) {
            for (const Vec3& p : frame->position) box.extend(p);
            for (const Vec3& v : hull.vertices)
                box.extend(Vec3(frame->ship_position + frame->ship_orientation * v));
        }
        std::vector<float> corners;
        for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            add_point(corners, Vec3(x ? box.max().x() + kRoom : box.min().x() - kRoom,
                                    y ? box.max().y() + kRoom : box.min().y() - kRoom, 0.0));
        water_ = {still("water", corners, 3),
                  still("water_triangles", std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}, 3),
                  {}};
    }

    // The hull in the small triangles of its load map, by region.
    void make_hull() {
        const statistics::LoadMap map = statistics::make_load_map(run_, options_.load_from);
        const bool mapped = !map.mesh.triangles.empty();
        hull_.mesh = mapped ? map.mesh : run_.header.shapes[0].mesh;
        const TriangleMesh& mesh = hull_.mesh;
        // One part for each region: ParaView shows and hides parts by name.
        for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
            std::vector<std::int32_t> triangles;
            std::vector<float> load;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                if (mesh.region[t] != static_cast<std::int32_t>(r)) continue;
                triangles.insert(triangles.end(), mesh.triangles[t].begin(),
                                 mesh.triangles[t].end());
                load.push_back(mapped ? static_cast<float>(map.load[t]) : 0.0F);
            }
            if (triangles.empty()) continue;
            hull_.parts.push_back(
                {"hull: " + mesh.region_names[r],
                 still(fmt::format("hull_{}_triangles", r).c_str(), triangles, 3),
                 {{"load_Pa", still(fmt::format("hull_{}_load", r).c_str(), load)}}});
        }
    }

    void add_frame(std::size_t f, std::size_t count) {
        group_ = fmt::format("/{:05d}", count);
        arrays_.begin_group(group_);
        const RunFrame& frame = run_.frames[f];
        run_file_.add("water", frame.time, water_);
        if (!options_.points_only) add_surfaces(frame);
        add_bodies(frame);
        add_contacts(frame);
    }

    StoredArray now(const char* name, const auto& values, std::uint64_t columns = 1) {
        return arrays_.add(group_ + "/" + name, values, columns);
    }

    static std::vector<float> vectors(const std::vector<Vec3>& of) {
        std::vector<float> out;
        for (const Vec3& v : of) add_point(out, v);
        return out;
    }
    static std::vector<std::int32_t> states(const RunFrame& frame) {
        std::vector<std::int32_t> out;
        for (const FloeState state : frame.state) out.push_back(static_cast<std::int32_t>(state));
        return out;
    }

    std::vector<NamedArray> floe_values(const RunFrame& frame, bool per_triangle) {
        const std::string of = per_triangle ? "_of_triangle" : "";
        const auto add = [&](const char* name, const auto& values, std::size_t columns) {
            return now((name + of).c_str(), of_bodies(values, per_triangle, columns), columns);
        };
        std::vector<NamedArray> out;
        // constant columns are stored once; of a frame only state, forces and velocities are new
        const std::vector<StoredArray>& same = per_triangle ? surfaces_ : bodies_;
        for (std::size_t k = 0; k < 3; ++k)
            out.push_back({std::array{"body", "shape", "group"}[k], same[k]});
        out.push_back({"state", add("state", states(frame), 1)});
        out.push_back(
            {"contact_force" + force_unit_, add("contact_force", vectors(frame.contact_force), 3)});
        out.push_back({"velocity_m_s", add("velocity", vectors(frame.velocity), 3)});
        return out;
    }

    void add_surfaces(const RunFrame& frame) {
        const StoredArray hull = now(
            "hull",
            posed(hull_.mesh, frame.ship_position, frame.ship_orientation.toRotationMatrix()), 3);
        for (const HullParts::Part& part : hull_.parts)
            run_file_.add(part.name, frame.time, {hull, part.triangles, part.values});
        std::vector<float> corners;
        for (std::size_t b = 0; b < frame.position.size(); ++b) {
            // Corners are stored turned and moved, in world axes: ParaView has no rigid bodies. All
            // frames share the triangles: those of a floe that is not there shrink to a point.
            const bool absent = frame.state[b] == FloeState::absent;
            const std::vector<float> one =
                posed(mesh_of(b), frame.position[b],
                      absent ? Mat3(Mat3::Zero()) : frame.orientation[b].toRotationMatrix());
            corners.insert(corners.end(), one.begin(), one.end());
        }
        run_file_.add("floes", frame.time,
                      {now("floes", corners, 3), triangles_, floe_values(frame, true)});
    }

    void add_bodies(const RunFrame& frame) {
        std::vector<float> turns;
        for (const Eigen::Quaterniond& q : frame.orientation)
            // orientation as w, x, y, z, as all of the project's files have it
            for (const double v : {q.w(), q.x(), q.y(), q.z()})
                turns.push_back(static_cast<float>(v));
        std::vector<NamedArray> values = floe_values(frame, false);
        values.push_back({"angular_velocity_rad_s",
                          now("angular_velocity", vectors(frame.angular_velocity), 3)});
        values.push_back({"orientation", now("orientation", turns, 4)});
        run_file_.add("bodies", frame.time,
                      {now("bodies", vectors(frame.position), 3), vertices_, values});
    }

    void add_contacts(const RunFrame& frame) {
        // a grid without points would be an error in ParaView: a frame without contacts has none
        if (frame.hull_contacts.empty()) return;
        std::vector<std::int32_t> floe, sphere;
        std::vector<float> places, push, rub;
        for (const HullContact& c : frame.hull_contacts) {
            // points are recorded in the ship's axes, forces in those of the world
            add_point(places, frame.ship_position + frame.ship_orientation * c.point);
            floe.push_back(c.floe);
            sphere.push_back(c.sphere);
            add_point(push, c.normal_force);
            add_point(rub, c.friction_force);
        }
        run_file_.add("contacts", frame.time,
                      {now("contacts", places, 3),
                       now("contact_vertices", counted(floe.size())),
                       {{"floe", now("floe", floe)},
                        {"sphere", now("sphere", sphere)},
                        {"normal_force" + force_unit_, now("normal_force", push, 3)},
                        {"friction_force" + force_unit_, now("friction_force", rub, 3)}}});
    }

    void write_shapes() {
        // In their own axes, for ParaView's glyphs: one shape is drawn at all of its floes' places.
        XdmfFile file;
        for (std::size_t k = 0; k < run_.header.shapes.size(); ++k) {
            const TriangleMesh& mesh = run_.header.shapes[k].mesh;
            std::vector<std::int32_t> triangles;
            for (const auto& t : mesh.triangles)
                triangles.insert(triangles.end(), t.begin(), t.end());
            const std::string name = fmt::format("shape_{}", k);
            file.add(k == 0 ? "hull" : fmt::format("floe shape {}", k),
                     {still(name.c_str(), posed(mesh, Vec3::Zero()), 3),
                      still((name + "_triangles").c_str(), triangles, 3),
                      {{"region", still((name + "_region").c_str(), mesh.region)}}});
        }
        write_text_file(folder_ / "shapes.xdmf", file.text());
    }

    const RunData& run_;
    const ParaviewOptions& options_;
    fs::path folder_;
    ArrayFile arrays_;
    XdmfFile run_file_;
    std::string force_unit_ = "_N", group_;
    std::vector<StoredArray> bodies_, surfaces_;  // body, shape, group of floes and their triangles
    StoredArray vertices_, triangles_;
    HullParts hull_;
    Grid water_;
};

// A full disk leaves arrays without a list that names them.
void remove_files(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : kFiles) fs::remove(folder / name, ignored);
    fs::remove(folder, ignored);  // only where nothing else is in it
}

}  // namespace

std::size_t write_paraview(const RunData& run, const fs::path& folder,
                           const ParaviewOptions& options) {
    if (run.frames.empty() || run.header.shapes.empty())
        throw bad_input(run.header.title, "the run has no frames to export",
                        "set output.frames_every in the case and run it again");
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw run_failed(folder.string(), "cannot be created: " + error.message(),
                         "check that the folder is writable");
    try {
        return Writer(run, folder, options).write();
    } catch (...) {
        remove_files(folder);
        throw;
    }
}

}  // namespace ice::paraview
