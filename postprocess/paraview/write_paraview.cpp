// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/paraview/write_paraview.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "postprocess/paraview/vtp.hpp"
#include "postprocess/statistics/load_map.hpp"

namespace ice::paraview {

namespace fs = std::filesystem;

namespace {

void add_point(std::vector<float>& list, const Vec3& p) {
    for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
}

// Values of one frame's floes, collected row by row.
struct BodyColumns {
    std::vector<std::int32_t> body, shape, group, state;
    std::vector<float> contact_force, velocity, angular_velocity, orientation;

    void add(const RunHeader& header, const RunFrame& frame, std::size_t b) {
        body.push_back(static_cast<std::int32_t>(b + 1));
        shape.push_back(header.body_shape[b]);
        group.push_back(header.body_group[b]);
        state.push_back(static_cast<std::int32_t>(frame.state[b]));
        add_point(contact_force, frame.contact_force[b]);
        add_point(velocity, frame.velocity[b]);
        add_point(angular_velocity, frame.angular_velocity[b]);
        const Eigen::Quaterniond& q = frame.orientation[b];
        for (const double v : {q.w(), q.x(), q.y(), q.z()})
            orientation.push_back(static_cast<float>(v));
    }
    std::vector<VtpArray> surface_arrays() const {
        return {make_array("body", 1, body),
                make_array("shape", 1, shape),
                make_array("group", 1, group),
                make_array("state", 1, state),
                make_array("contact_force", 3, contact_force),
                make_array("velocity", 3, velocity)};
    }
    std::vector<VtpArray> point_arrays() const {
        auto arrays = surface_arrays();
        arrays.push_back(make_array("angular_velocity", 3, angular_velocity));
        arrays.push_back(make_array("orientation", 4, orientation));
        return arrays;
    }
};

VtpFile floe_surfaces(const RunHeader& header, const RunFrame& frame) {
    VtpFile file;
    BodyColumns columns;
    for (std::size_t b = 0; b < frame.position.size(); ++b) {
        const TriangleMesh& mesh =
            header.shapes[static_cast<std::size_t>(header.body_shape[b])].mesh;
        const auto first = static_cast<std::int32_t>(file.points.size() / 3);
        const Mat3 turn = frame.orientation[b].toRotationMatrix();
        for (const Vec3& v : mesh.vertices) add_point(file.points, frame.position[b] + turn * v);
        for (const auto& triangle : mesh.triangles) {
            for (const std::int32_t corner : triangle) file.triangles.push_back(first + corner);
            columns.add(header, frame, b);
        }
    }
    file.cell_data = columns.surface_arrays();
    return file;
}

VtpFile floe_points(const RunHeader& header, const RunFrame& frame) {
    VtpFile file;
    BodyColumns columns;
    for (std::size_t b = 0; b < frame.position.size(); ++b) {
        add_point(file.points, frame.position[b]);
        columns.add(header, frame, b);
    }
    file.point_data = columns.point_arrays();
    return file;
}

VtpFile contact_points(const RunFrame& frame) {
    VtpFile file;
    std::vector<std::int32_t> floe, sphere;
    std::vector<float> push, rub;
    for (const HullContact& c : frame.hull_contacts) {
        add_point(file.points, frame.ship_position + frame.ship_orientation * c.point);
        floe.push_back(c.floe);
        sphere.push_back(c.sphere);
        add_point(push, c.normal_force);
        add_point(rub, c.friction_force);
    }
    file.point_data = {make_array("floe", 1, floe), make_array("sphere", 1, sphere),
                       make_array("normal_force", 3, push), make_array("friction_force", 3, rub)};
    return file;
}

VtpFile surface(const TriangleMesh& mesh, const Vec3& shift, const Mat3& turn = Mat3::Identity()) {
    VtpFile file;
    for (const Vec3& v : mesh.vertices) add_point(file.points, shift + turn * v);
    for (const auto& t : mesh.triangles)
        file.triangles.insert(file.triangles.end(), t.begin(), t.end());
    file.cell_data = {make_array("region", 1, mesh.region)};
    return file;
}

VtpFile hull_load(const RunData& run, double from) {
    const statistics::LoadMap map = statistics::make_load_map(run, from);
    VtpFile file = surface(map.mesh, Vec3::Zero());
    file.cell_data.push_back(
        make_array("load", 1, std::vector<float>(map.load.begin(), map.load.end())));
    return file;
}

// ParaView's list of files over time; `part` tells apart what belongs to one time
class Collection {
public:
    void add(double time, int part, const std::string& name, const std::string& file) {
        lines_ +=
            fmt::format("<DataSet timestep=\"{:.9g}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                        time, part, name, file);
    }
    void write(const fs::path& path) const {
        write_text_file(path,
                        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                        "byte_order=\"LittleEndian\"><Collection>\n" +
                            lines_ + "</Collection></VTKFile>\n");
    }

private:
    std::string lines_;
};

void write_shapes(const RunHeader& header, const fs::path& folder) {
    std::string blocks;
    for (std::size_t k = 0; k < header.shapes.size(); ++k) {
        const std::string name = fmt::format("frames/shape_{}.vtp", k);
        write_vtp(folder / name, surface(header.shapes[k].mesh, Vec3::Zero()));
        blocks += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", k,
                              k == 0 ? "hull" : fmt::format("floe shape {}", k), name);
    }
    write_text_file(folder / "shapes.vtm",
                    "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" "
                    "version=\"1.0\"><vtkMultiBlockDataSet>\n" +
                        blocks + "</vtkMultiBlockDataSet></VTKFile>\n");
}

}  // namespace

namespace {

// Removes the frames, of which a full disk would leave thousands without a list that names them.
void remove_frames(const fs::path& folder) {
    std::error_code ignored;
    std::vector<fs::path> frames;
    for (const auto& entry : fs::directory_iterator(folder / "frames", ignored))
        if (entry.path().extension() == ".vtp") frames.push_back(entry.path());
    for (const fs::path& frame : frames) fs::remove(frame, ignored);
    for (const char* name : {"hull_load.vtp", "shapes.vtm", "bodies.pvd", "contacts.pvd",
                             "floes.pvd", "hull.pvd", "run.pvd"})
        fs::remove(folder / name, ignored);
    fs::remove(folder / "frames", ignored);  // both only where nothing else is in them
    fs::remove(folder, ignored);
}

std::size_t write_files(const RunData& run, const fs::path& folder,
                        const ParaviewOptions& options) {
    const RunHeader& header = run.header;
    Collection both, floes, hull, bodies, contacts;
    std::size_t count = 0;
    const std::size_t step = std::max<std::size_t>(1, options.every);
    for (std::size_t f = 0; f < run.frames.size(); f += step, ++count) {
        const RunFrame& frame = run.frames[f];
        const auto add = [&](Collection& list, const char* kind, const VtpFile& file) {
            const std::string name = fmt::format("frames/{}_{:05d}.vtp", kind, count);
            write_vtp(folder / name, file);
            list.add(frame.time, 0, kind, name);
            return name;
        };
        add(bodies, "bodies", floe_points(header, frame));
        add(contacts, "contacts", contact_points(frame));
        if (options.points_only) continue;
        both.add(frame.time, 0, "hull",
                 add(hull, "hull",
                     surface(header.shapes[0].mesh, frame.ship_position,
                             frame.ship_orientation.toRotationMatrix())));
        both.add(frame.time, 1, "floes", add(floes, "floes", floe_surfaces(header, frame)));
    }
    write_shapes(header, folder);
    write_vtp(folder / "hull_load.vtp", hull_load(run, options.load_from));
    bodies.write(folder / "bodies.pvd");
    contacts.write(folder / "contacts.pvd");
    if (options.points_only) return count;
    floes.write(folder / "floes.pvd");
    hull.write(folder / "hull.pvd");
    both.write(folder / "run.pvd");
    return count;
}

}  // namespace

std::size_t write_paraview(const RunData& run, const fs::path& folder,
                           const ParaviewOptions& options) {
    if (run.frames.empty() || run.header.shapes.empty())
        throw bad_input(run.header.title, "the run has no frames to export",
                        "set output.frames_every in the case and run it again");
    std::error_code error;
    fs::create_directories(folder / "frames", error);
    if (error)
        throw run_failed(folder.string(), "cannot be created: " + error.message(),
                         "check that the folder is writable");
    try {
        return write_files(run, folder, options);
    } catch (...) {
        remove_frames(folder);
        throw;
    }
}

}  // namespace ice::paraview
