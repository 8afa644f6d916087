// SPDX-License-Identifier: GPL-3.0-or-later
// Writing; field_reader.cpp reads.
#include "common/formats/field_file.hpp"

#include "common/formats/field_arrays.hpp"
#include "common/formats/flatten.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/sealed_file.hpp"

namespace ice {

namespace {

using detail::FieldArrays;

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
    all.insert(all.end(), part.begin(), part.end());
}

void add_shape(const SphereSet& set, FieldArrays& all) {
    // Radii and regions are left out: all spheres of a field have one radius, all triangles one
    // region.
    all.spheres.push_back(static_cast<std::int64_t>(set.size()));
    all.surface.push_back(static_cast<std::int64_t>(set.surface_count));
    all.creases.push_back(static_cast<std::int64_t>(set.creases.size()));
    all.vertices.push_back(static_cast<std::int64_t>(set.mesh.vertices.size()));
    all.triangles.push_back(static_cast<std::int64_t>(set.mesh.triangles.size()));
    all.volume.push_back(set.solid.volume);
    all.area.push_back(set.solid.area);
    for (int k = 0; k < 3; ++k) all.centroid.push_back(set.solid.centroid[k]);
    for (int k = 0; k < 9; ++k) all.inertia.push_back(set.solid.inertia(k / 3, k % 3));
    // all shapes in the same arrays, one after the other: thousands of small datasets would be
    // slow
    append(all.center, flatten<double>(set.centers));
    append(all.share_volume, set.volumes);
    append(all.share_area, set.areas);
    // As in a sphere set: single precision is enough for a direction.
    append(all.normal, flatten<float>(set.normals));
    all.spread.insert(all.spread.end(), set.normal_spread.begin(), set.normal_spread.end());
    for (const CreaseNormal& crease : set.creases) {
        all.crease_sphere.push_back(crease.sphere);
        for (int k = 0; k < 3; ++k)
            all.crease_normal.push_back(static_cast<float>(crease.normal[k]));
    }
    append(all.vertex, flatten<double>(set.mesh.vertices));
    for (const auto& t : set.mesh.triangles)
        all.triangle.insert(all.triangle.end(), t.begin(), t.end());
}

template <class T>
void write_rows_of(Hdf5File& file, const std::string& name, const std::vector<T>& flat,
                   std::uint64_t width) {
    file.write(name, flat.data(), {flat.size() / width, width});
}

void write_field_arrays(Hdf5File& file, const FieldArrays& all) {
    // The paths of the datasets are the format (field_file.hpp).
    for (const char* group : {"/shape", "/sphere", "/surface", "/crease", "/mesh"})
        file.create_group(group);
    file.write("/shape/spheres", all.spheres);
    file.write("/shape/surface_spheres", all.surface);
    file.write("/shape/creases", all.creases);
    file.write("/shape/vertices", all.vertices);
    file.write("/shape/triangles", all.triangles);
    file.write("/shape/volume", all.volume);
    file.write("/shape/area", all.area);
    write_rows_of(file, "/shape/centroid", all.centroid, 3);
    write_rows_of(file, "/shape/inertia", all.inertia, 9);
    write_rows_of(file, "/sphere/center", all.center, 3);
    file.write("/sphere/volume", all.share_volume);
    write_rows_of(file, "/surface/normal", all.normal, 3);
    file.write("/surface/area", all.share_area);
    file.write("/surface/normal_spread", all.spread);
    file.write("/crease/sphere", all.crease_sphere);
    write_rows_of(file, "/crease/normal", all.crease_normal, 3);
    write_rows_of(file, "/mesh/vertices", all.vertex, 3);
    write_rows_of(file, "/mesh/triangles", all.triangle, 3);
}

void write_floes(Hdf5File& file, const std::vector<FieldFloe>& floes) {
    std::vector<std::int32_t> shape;
    std::vector<double> position, orientation;
    // floes lie in the water's plane: two numbers of a place, but the whole quaternion [F, 4]
    std::vector<std::uint8_t> fixed;
    for (const FieldFloe& floe : floes) {
        shape.push_back(floe.shape);
        position.insert(position.end(), floe.position.begin(), floe.position.end());
        const auto& q = floe.orientation;
        for (const double part : {q.w(), q.x(), q.y(), q.z()}) orientation.push_back(part);
        fixed.push_back(floe.fixed ? 1 : 0);
    }
    file.create_group("/floe");
    file.write("/floe/shape", shape);
    write_rows_of(file, "/floe/position", position, 2);
    write_rows_of(file, "/floe/orientation", orientation, 4);
    file.write("/floe/fixed", fixed);
}

}  // namespace

void write_field(const std::filesystem::path& path, const Field& field) {
    FieldArrays all;
    for (const SphereSet& shape : field.shapes) add_shape(shape, all);
    // attributes first: a reader knows kind and version before any array
    write_sealed(path, [&](Hdf5File& file) {
        file.write_attribute("/", "format", std::string(detail::kFieldFormat));
        file.write_attribute("/", "format_version", detail::kFieldVersion);
        file.write_attribute("/", "units", std::string("SI"));
        file.write_attribute("/", "radius", {field.radius}, {});
        file.write_attribute("/", "spacing", {field.spacing}, {});
        file.write_attribute("/", "mode", field.mode);
        file.write_attribute("/", "area", {field.area.begin(), field.area.end()}, {4});
        file.write_attribute("/", "concentration", {field.concentration}, {});
        file.write_attribute("/", "specification", field.specification);
        file.write_attribute("/", "seed", field.seed);
        file.write_attribute("/", "created_by", field.created_by);
        file.write_attribute("/", "command_line", field.command_line);
        write_floes(file, field.floes);
        write_field_arrays(file, all);
    });
}

}  // namespace ice
