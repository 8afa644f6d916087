// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/run_parts.hpp"

#include <algorithm>
#include <numeric>

#include "common/formats/flatten.hpp"

namespace ice::run_parts {

void write_labels(Hdf5File& file, const std::string& name, const std::vector<std::string>& texts) {
    file.write_strings(name, texts);
    file.write_attribute(name, "_Encoding", std::string("utf-8"));  // xarray: str, not bytes
    file.make_scale(name);
}

void attach_scales(Hdf5File& file, const std::string& name,
                   const std::vector<std::string>& scales) {
    for (unsigned k = 0; k < scales.size(); ++k) file.attach_scale(name, k, scales[k]);
}

// Meshes and spheres of all shapes one after the other; row s of an offset is where shape s begins.
void write_shapes(Hdf5File& file, const RunHeader& header) {
    // one list of region names for all shapes; the hull is first and so keeps its numbers
    std::vector<std::string> names;
    std::vector<std::int64_t> vertex_offset{0}, triangle_offset{0}, sphere_offset{0};
    std::vector<float> vertices, spheres;
    std::vector<std::int32_t> triangles, region;
    for (const RunShape& shape : header.shapes) {
        // A shape's own region numbers -> rows of the common list: shapes come from different
        // files, in which a region of one name may have different numbers.
        std::vector<std::int32_t> global;
        for (const std::string& name : shape.mesh.region_names) {
            const auto found = std::find(names.begin(), names.end(), name);
            global.push_back(static_cast<std::int32_t>(found - names.begin()));
            if (found == names.end()) names.push_back(name);
        }
        // single precision: 1e-7 of a ship's length is far below a contact sphere
        const auto flat = flatten<float>(shape.mesh.vertices);
        vertices.insert(vertices.end(), flat.begin(), flat.end());
        for (const auto& t : shape.mesh.triangles)
            triangles.insert(triangles.end(), t.begin(), t.end());
        for (const std::int32_t r : shape.mesh.region)
            region.push_back(global.at(static_cast<std::size_t>(r)));
        for (std::size_t k = 0; k < shape.centers.size(); ++k) {
            for (int c = 0; c < 3; ++c) spheres.push_back(static_cast<float>(shape.centers[k][c]));
            spheres.push_back(static_cast<float>(shape.radii[k]));
        }
        vertex_offset.push_back(static_cast<std::int64_t>(vertices.size() / 3));
        triangle_offset.push_back(static_cast<std::int64_t>(triangles.size() / 3));
        sphere_offset.push_back(static_cast<std::int64_t>(spheres.size() / 4));
    }
    file.create_group("/shapes");
    file.write("/shapes/vertex_offset", vertex_offset);
    file.write("/shapes/vertices", vertices.data(), {vertices.size() / 3, 3});
    file.write("/shapes/triangle_offset", triangle_offset);
    file.write("/shapes/triangles", triangles.data(), {triangles.size() / 3, 3});
    file.write("/shapes/region", region);
    file.write("/shapes/sphere_offset", sphere_offset);
    file.write("/shapes/spheres", spheres.data(), {spheres.size() / 4, 4});
    write_labels(file, "/region_names", names.empty() ? std::vector<std::string>{"hull"} : names);
}

void write_flow_arrows(Hdf5File& file, const RunHeader& header) {
    if (header.flow_point.empty()) return;
    file.create_group("/flow");
    // Arrows have numbers as their scale, since xarray needs a label for each dimension.
    std::vector<std::int32_t> ids(header.flow_point.size());
    std::iota(ids.begin(), ids.end(), 0);
    file.write("/flow/arrow", ids);
    file.make_scale("/flow/arrow");
    const auto write = [&](const char* name, const std::vector<Vec3>& rows, const char* unit,
                           const char* meaning) {
        file.write(name, flatten<float>(rows).data(), {rows.size(), 3});
        attach_scales(file, name, {"/flow/arrow", "/xyz"});
        file.write_attribute(name, "units", unit);
        file.write_attribute(name, "meaning", meaning);
    };
    write("/flow/point", header.flow_point, "m",
          "from the point of the water's surface above the ship's origin; does not turn with her");
    write("/flow/velocity", header.flow_velocity, "1", "of the water, for a ship at 1 m/s");
}

void write_bodies(Hdf5File& file, const RunHeader& header) {
    const std::uint64_t count = header.body_shape.size();
    std::vector<std::int32_t> ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<std::int32_t>(k + 1);
    file.write("/frames/body", ids);
    file.make_scale("/frames/body");
    file.write("/frames/body_shape", header.body_shape);
    file.write("/frames/body_group", header.body_group);
    // Mass and inertia are written once: they are those of the whole floe, however much of it is
    // crushed.
    file.write("/frames/mass", header.body_mass);
    file.write("/frames/inertia", flatten<double>(header.body_inertia).data(), {count, 3});
    file.write_attribute("/frames/mass", "units", header.dimension == 2 ? "kg/m" : "kg");
    file.write_attribute("/frames/inertia", "units", header.dimension == 2 ? "kg m" : "kg m2");
    for (const char* name : {"/frames/body_shape", "/frames/body_group", "/frames/mass"})
        attach_scales(file, name, {"/frames/body"});
    attach_scales(file, "/frames/inertia", {"/frames/body", "/xyz"});
}

std::vector<std::string> hull_regions(const RunHeader& header) {
    if (header.shapes.empty() || header.shapes[0].mesh.region_names.empty()) return {"hull"};
    return header.shapes[0].mesh.region_names;
}

void write_panels(Hdf5File& file, const HullPanels& hull, int dimension) {
    // written at the end of a run, when largest and 99 % loads are known
    const std::uint64_t count = hull.panels.size();
    const auto name_of = [](const char* name) { return std::string("/panels/") + name; };
    // xarray shows units and long_name at each axis of its plots.
    const auto describe = [&](const char* name, const std::string& units, const char* text) {
        file.write_attribute(name_of(name), "units", units);
        file.write_attribute(name_of(name), "long_name", std::string(text));
    };
    std::vector<std::int32_t> ids, region;
    std::vector<Vec3> center, normal;
    for (const PanelLoad& panel : hull.panels) {
        ids.push_back(static_cast<std::int32_t>(ids.size()));
        region.push_back(panel.region);
        center.push_back(panel.center);
        normal.push_back(panel.normal);
    }
    // Scales first: xarray takes the dimensions of each following dataset from them.
    file.create_group("/panels");
    file.write(name_of("panel"), ids);
    file.make_scale(name_of("panel"));
    file.write(name_of("region"), region);
    attach_scales(file, name_of("region"), {"/panels/panel"});
    describe("region", "1", "row of /hull_regions");
    for (const auto& [name, points] :
         {std::pair("center", &center), std::pair("normal", &normal)}) {
        file.write(name_of(name), flatten<double>(*points).data(), {count, 3});
        attach_scales(file, name_of(name), {"/panels/panel", "/xyz"});
    }
    describe("center", "m", "middle of the panel, ship frame");
    describe("normal", "1", "mean outward normal");
    const std::string force = dimension == 2 ? "N/m" : "N";
    // One column for each quantity, not one row for each panel: readers select by name.
    const auto column = [&](const char* name, double PanelLoad::*member, const std::string& units,
                            const char* text) {
        std::vector<double> values;
        for (const PanelLoad& panel : hull.panels) values.push_back(panel.*member);
        file.write(name_of(name), values);
        attach_scales(file, name_of(name), {"/panels/panel"});
        describe(name, units, text);
    };
    column("area", &PanelLoad::area, dimension == 2 ? "m2/m" : "m2", "area of the panel");
    column("length", &PanelLoad::length, "m", "length of the panel along the waterline");
    column("force_mean", &PanelLoad::mean, force, "normal force, mean");
    column("force_p99", &PanelLoad::p99, force, "normal force, 99 % of the windows are below");
    column("force_max", &PanelLoad::max, force, "normal force, largest of the windows");
    file.write_attribute("/panels", "size", {hull.size}, {});
    file.write_attribute("/panels", "window", {hull.window}, {});
    file.write("/shapes/hull_panel", hull.of_sphere);
    file.write_attribute("/shapes/hull_panel", "long_name",
                         std::string("row of /panels of each surface sphere of the hull"));
}

std::string track_units(const std::string& force) {
    std::string units = "m,m,m,1,1,1,1,m/s,m/s,m/s,rad/s,rad/s,rad/s";
    for (int column = 0; column < 9; ++column) units += "," + force;
    return units;
}

}  // namespace ice::run_parts
