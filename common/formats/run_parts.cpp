// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/run_parts.hpp"

#include <algorithm>

#include "common/formats/flatten.hpp"

namespace ice::run_parts {

void write_labels(Hdf5File& file, const std::string& name, const std::vector<std::string>& texts) {
    file.write_strings(name, texts);
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
        std::vector<std::int32_t> global;
        for (const std::string& name : shape.mesh.region_names) {
            const auto found = std::find(names.begin(), names.end(), name);
            global.push_back(static_cast<std::int32_t>(found - names.begin()));
            if (found == names.end()) names.push_back(name);
        }
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

void write_bodies(Hdf5File& file, const RunHeader& header) {
    const std::uint64_t count = header.body_shape.size();
    std::vector<std::int32_t> ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<std::int32_t>(k + 1);
    file.write("/frames/body", ids);
    file.make_scale("/frames/body");
    file.write("/frames/body_shape", header.body_shape);
    file.write("/frames/body_group", header.body_group);
    file.write("/frames/mass", header.body_mass);
    file.write("/frames/inertia", flatten<double>(header.body_inertia).data(), {count, 3});
    file.write_attribute("/frames/mass", "units", header.dimension == 2 ? "kg/m" : "kg");
    file.write_attribute("/frames/inertia", "units", header.dimension == 2 ? "kg m" : "kg m2");
    for (const char* name : {"/frames/body_shape", "/frames/body_group", "/frames/mass"})
        attach_scales(file, name, {"/frames/body"});
    attach_scales(file, "/frames/inertia", {"/frames/body", "/xyz"});
}

}  // namespace ice::run_parts
