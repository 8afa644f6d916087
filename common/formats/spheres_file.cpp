// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/spheres_file.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/rehearse.hpp"
#include "common/formats/flatten.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/refuse_other_format.hpp"
#include "common/formats/sealed_file.hpp"
#include "common/formats/sphere_set_faults.hpp"

namespace ice {

namespace {

constexpr const char* kSpheresFormat = "icesolve-spheres";
// Version of the format; 1 more when an array changes its meaning. A reader refuses all others.
constexpr std::int64_t kSpheresVersion = 1;

std::vector<Vec3> unflatten(const std::vector<double>& flat) {
    std::vector<Vec3> points(flat.size() / 3);
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k] = Vec3(flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]);
    return points;
}

void write_solid(Hdf5File& file, const MassProperties& solid) {
    file.create_group("/solid");
    file.write_attribute("/solid", "volume", {solid.volume}, {});
    file.write_attribute("/solid", "area", {solid.area}, {});
    file.write_attribute("/solid", "centroid",
                         {solid.centroid.x(), solid.centroid.y(), solid.centroid.z()}, {3});
    std::vector<double> inertia;
    // row by row
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) inertia.push_back(solid.inertia(r, c));
    file.write_attribute("/solid", "inertia", inertia, {3, 3});
}

void write_mesh(Hdf5File& file, const TriangleMesh& mesh) {
    file.create_group("/mesh");
    file.write("/mesh/vertices", flatten<double>(mesh.vertices).data(), {mesh.vertices.size(), 3});
    std::vector<std::int32_t> indices;
    for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
    file.write("/mesh/triangles", indices.data(), {mesh.triangles.size(), 3});
    file.write("/mesh/region", mesh.region);
}

// Most bytes in memory per byte in the file [-]: 3 are usual where most spheres are inside, without
// rows of their own. A lower bound refuses sound sets, a higher one lets a damaged file take more
// memory before it is refused.
constexpr std::uint64_t kMostTimesSpheres = 16;

// Reads one file, with every complaint naming the file and the dataset.
class SpheresReader {
public:
    explicit SpheresReader(const std::filesystem::path& path)
        : path_(path), file_(path, Hdf5File::Mode::read) {
        file_.limit_reading(kMostTimesSpheres);
    }

    SphereSet read() {
        SphereSet set;
        read_header(set);
        refuse_changed(path_, file_, "spherize");
        read_solid(set.solid);
        // names before the mesh: its regions are checked against their number
        set.mesh.region_names = file_.read_strings("/region_names");
        read_mesh(set.mesh);
        read_arrays(set);
        const std::string fault = fault_of(set);
        check(fault.empty(), "/", "has " + fault);
        return set;
    }

private:
    void check(bool good, const std::string& dataset, const std::string& what) const {
        if (!good)
            throw bad_input(path_.string() + ": " + dataset, what,
                            "make the file again with spherize");
    }

    std::vector<double> finite(const std::string& name) const {
        std::vector<double> values = file_.read<double>(name);
        for (const double v : values) check(std::isfinite(v), name, "holds a NaN or infinity");
        return values;
    }

    std::vector<Vec3> points(const std::string& name) const {
        const auto shape = file_.shape(name);
        check(shape.size() == 2 && shape[1] == 3, name, "is not an array of shape [N,3]");
        return unflatten(finite(name));
    }

    void read_header(SphereSet& set) const {
        refuse_other_format(path_, file_, kSpheresFormat, "a sphere set");
        check(file_.has_attribute("/", "format") &&
                  file_.read_text_attribute("/", "format") == kSpheresFormat,
              "/", "is not a sphere set (no attribute format = \"icesolve-spheres\")");
        check(file_.read_number_attribute("/", "format_version")[0] == kSpheresVersion, "/",
              "has a format_version this program does not know");
        const double dimension = file_.read_number_attribute("/", "dimension")[0];
        // Each number is checked before its first use: no unchecked number of the file is a size or
        // an index.
        check(dimension == 2.0 || dimension == 3.0, "dimension", "is neither 2 nor 3");
        set.dimension = static_cast<int>(dimension);
        set.radius = file_.read_number_attribute("/", "radius")[0];
        set.spacing = file_.read_number_attribute("/", "spacing")[0];
        check(set.radius > 0 && std::isfinite(set.radius), "radius", "is not positive");
        check(set.spacing > 0 && std::isfinite(set.spacing), "spacing", "is not positive");
        set.mode = file_.read_text_attribute("/", "mode");
        set.source_mesh = file_.read_text_attribute("/", "source_mesh");
        set.source_sha256 = file_.read_text_attribute("/", "source_sha256");
        set.created_by = file_.read_text_attribute("/", "created_by");
        set.command_line = file_.read_text_attribute("/", "command_line");
    }

    void read_solid(MassProperties& solid) const {
        solid.volume = file_.read_number_attribute("/solid", "volume")[0];
        solid.area = file_.read_number_attribute("/solid", "area")[0];
        const auto centroid = file_.read_number_attribute("/solid", "centroid");
        const auto inertia = file_.read_number_attribute("/solid", "inertia");
        check(centroid.size() == 3 && inertia.size() == 9, "/solid",
              "has a centroid or inertia of the wrong size");
        solid.centroid = Vec3(centroid[0], centroid[1], centroid[2]);
        for (int k = 0; k < 9; ++k)
            solid.inertia(k / 3, k % 3) = inertia[static_cast<std::size_t>(k)];
        const std::string fault = fault_of(solid);
        check(fault.empty(), "/solid", "has " + fault);
    }

    void read_mesh(TriangleMesh& mesh) const {
        mesh.vertices = points("/mesh/vertices");
        const auto shape = file_.shape("/mesh/triangles");
        check(shape.size() == 2 && shape[1] == 3, "/mesh/triangles", "is not of shape [T,3]");
        const auto flat = file_.read<std::int32_t>("/mesh/triangles");
        // [T, 3] rows of vertices; with one outside later loops would read beyond the array
        const auto vertex_count = static_cast<std::int32_t>(mesh.vertices.size());
        for (const std::int32_t v : flat)
            check(v >= 0 && v < vertex_count, "/mesh/triangles", "points outside the vertices");
        mesh.triangles.resize(flat.size() / 3);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            mesh.triangles[t] = {flat[3 * t], flat[3 * t + 1], flat[3 * t + 2]};
        mesh.region = file_.read<std::int32_t>("/mesh/region");
        check(mesh.region.size() == mesh.triangles.size(), "/mesh/region",
              "has another length than /mesh/triangles");
        check_regions(mesh.region, mesh.region_names.size(), "/mesh/region");
    }

    void check_regions(const std::vector<std::int32_t>& rows, std::size_t count,
                       const std::string& name) const {
        for (const std::int32_t row : rows)
            check(row >= 0 && row < static_cast<std::int32_t>(count), name,
                  "points outside /region_names");
    }

    void read_arrays(SphereSet& set) const {
        set.centers = points("/center");
        const std::size_t n = set.centers.size();
        check(n > 0, "/center", "is empty");
        for (const char* name : {"/radius", "/area", "/volume", "/layer", "/region"})
            // shapes before contents: a damaged length takes no memory
            check(file_.shape(name) == std::vector<std::uint64_t>{n}, name,
                  "has another length than /center");
        const auto layers = file_.read<std::uint8_t>("/layer");
        for (std::size_t k = 0; k < n; ++k) {
            check(layers[k] <= 1, "/layer", "holds a layer other than 0 and 1");
            // Surface spheres first: the solver uses a prefix of the arrays and no layers.
            check(k == 0 || layers[k] <= layers[k - 1], "/layer",
                  "does not have the surface spheres first");
            set.surface_count += layers[k];
        }
        set.radii = finite("/radius");
        for (const double r : set.radii)
            check(r > 0, "/radius", "holds a radius that is not positive");
        set.volumes = finite("/volume");
        read_surface(set);
        read_creases(set);
    }

    // The first S rows; those of the interior have no information.
    void read_surface(SphereSet& set) const {
        const std::size_t n = set.centers.size(), s = set.surface_count;
        set.normals = points("/normal");
        set.areas = finite("/area");
        set.regions = file_.read<std::int32_t>("/region");
        set.normal_spread =
            file_.has("/normal_spread") ? finite("/normal_spread") : std::vector<double>(n, 0.0);
        for (const std::size_t size : {set.normals.size(), set.normal_spread.size()})
            check(size == n, "/center", "has another length than the arrays beside it");
        // Rows of the interior hold the fill value, which costs no room in the file.
        set.normals.resize(s);
        set.areas.resize(s);
        set.regions.resize(s);
        set.normal_spread.resize(s);
        check_regions(set.regions, set.mesh.region_names.size(), "/region");
        for (std::size_t k = 0; k < s; ++k) {
            check(set.areas[k] >= 0, "/area", "holds a negative area");
            const double length = set.normals[k].norm();
            check(std::abs(length - 1.0) < 1e-3, "/normal",
                  "holds a normal that is no unit vector");
            // Stored in single precision: to unit length again in double.
            set.normals[k] /= length;
        }
    }

    void read_creases(SphereSet& set) const {
        if (!file_.has("/crease/sphere")) return;
        const auto spheres = file_.read<std::int32_t>("/crease/sphere");
        const std::vector<Vec3> normals = points("/crease/normal");
        check(spheres.size() == normals.size(), "/crease/normal",
              "has another length than /crease/sphere");
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            check(spheres[k] >= 0 && static_cast<std::size_t>(spheres[k]) < set.surface_count,
                  "/crease/sphere", "points outside the surface spheres");
            set.creases.push_back({spheres[k], normals[k].normalized()});
        }
    }

    std::filesystem::path path_;
    Hdf5File file_;
};

}  // namespace

namespace {

void write_certificate(Hdf5File& file, SpheresReport& c) {
    // The report as a whole, for people, and its numbers as attributes, for programs that read no
    // JSON.
    c.seconds.clear();  // equal calls give equal bytes
    file.write_attribute("/", "certificate", spheres_report_text(c));
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"protrusion_max_m", c.protrusion_max},
             {"covering_radius_m", c.covering_radius},
             {"gap_p50_m", c.gap_p50},
             {"gap_p99_m", c.gap_p99},
             {"gap_max_m", c.gap_max},
             {"normal_error_mean_deg", c.normal_error_mean_deg},
             {"normal_error_p99_deg", c.normal_error_p99_deg}})
        file.write_attribute("/", name, {value}, {});
    file.write_attribute("/", "unfitted_share", {c.unfitted_share}, {});
    if (c.source.known) {
        file.write_attribute("/", "source_distance_max_m",
                             {std::max(c.source.to_solid.max, c.source.to_source.max)}, {});
        file.write_attribute("/", "source_distance_p99_m",
                             {std::max(c.source.to_solid.p99, c.source.to_source.p99)}, {});
    }
    if (c.belt) {
        file.write_attribute("/", "draught", {c.belt.draught}, {});
        file.write_attribute("/", "ice_thickness", {c.belt.thickness}, {});
        file.write_attribute("/", "ice_belt", ice_belt_text(c));
    }
    for (const auto& [name, count] : std::initializer_list<std::pair<const char*, std::size_t>>{
             {"spheres", static_cast<std::size_t>(c.spheres)},
             {"surface_spheres", static_cast<std::size_t>(c.surface_spheres)},
             {"thin_features", c.thin_features.size()},
             {"repairs", c.repairs.size()}})
        file.write_attribute("/", name, static_cast<std::int64_t>(count));
}

// Arrays of the surface are written for its spheres only: the interior's rows read as the fill
// value, and a set of millions costs little more than its centres.
void write_spheres_arrays(Hdf5File& file, const SphereSet& set) {
    const std::uint64_t n = set.size(), s = set.surface_count;
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    file.write("/center", set.centers.data()->data(), {n, 3});
    // Constant columns take no room: the value is the fill value, and no row is written.
    const bool equal_radii =
        std::all_of(set.radii.begin(), set.radii.end(), [&](double r) { return r == set.radius; });
    const std::uint64_t radii = set.radii.size();
    file.write_rows("/radius", set.radii.data(), {radii}, equal_radii ? 0 : radii, set.radius);
    // shares of the interior are equal more often than not
    const double inside = set.volumes.back();
    const bool equal_volumes =
        std::all_of(set.volumes.begin() + static_cast<std::ptrdiff_t>(s), set.volumes.end(),
                    [&](double v) { return v == inside; });
    file.write_rows("/volume", set.volumes.data(), {n}, equal_volumes ? s : n, inside);

    const std::vector<float> normals = flatten<float>(set.normals);
    const std::vector<float> spread(set.normal_spread.begin(), set.normal_spread.end());
    const std::vector<std::uint8_t> layers(s, 1);
    // Directions in single precision: 1e-7 is far below the error of any mesh. Areas in double,
    // since they are summed.
    file.write_rows("/normal", normals.data(), {n, 3}, s, 0.0f);
    file.write_rows("/normal_spread", spread.data(), {n}, s, 0.0f);
    file.write_rows("/area", set.areas.data(), {n}, s, 0.0);
    file.write_rows("/layer", layers.data(), {n}, s, std::uint8_t{0});
    file.write_rows("/region", set.regions.data(), {n}, s, std::int32_t{0});

    std::vector<std::int32_t> crease_spheres;
    std::vector<Vec3> crease_normals;
    for (const CreaseNormal& crease : set.creases) {
        crease_spheres.push_back(crease.sphere);
        crease_normals.push_back(crease.normal);
    }
    file.create_group("/crease");
    file.write("/crease/sphere", crease_spheres);
    file.write("/crease/normal", flatten<float>(crease_normals).data(), {crease_normals.size(), 3});
}

void write_all(Hdf5File& file, const SphereSet& set, SpheresReport& certificate) {
    // Attributes first: a reader gets kind, version and origin without an array.
    file.write_attribute("/", "format", std::string(kSpheresFormat));
    file.write_attribute("/", "format_version", kSpheresVersion);
    file.write_attribute("/", "dimension", std::int64_t{set.dimension});
    file.write_attribute("/", "radius", {set.radius}, {});
    file.write_attribute("/", "spacing", {set.spacing}, {});
    file.write_attribute("/", "mode", set.mode);
    file.write_attribute("/", "source_mesh", set.source_mesh);
    file.write_attribute("/", "source_sha256", set.source_sha256);
    file.write_attribute("/", "created_by", set.created_by);
    file.write_attribute("/", "command_line", set.command_line);
    file.write_attribute("/", "units", std::string("SI"));
    write_certificate(file, certificate);

    write_spheres_arrays(file, set);
    file.write_strings("/region_names", set.mesh.region_names);
    write_solid(file, set.solid);
    write_mesh(file, set.mesh);
}

}  // namespace

void write_spheres(const std::filesystem::path& path, const SphereSet& set,
                   SpheresReport certificate) {
    write_sealed(path, [&](Hdf5File& file) { write_all(file, set, certificate); });
}

std::string read_ice_belt(const std::filesystem::path& path) {
    const Hdf5File file(path, Hdf5File::Mode::read);
    return file.has_attribute("/", "ice_belt") ? file.read_text_attribute("/", "ice_belt")
                                               : std::string();
}

SphereSet read_spheres(const std::filesystem::path& path) {
    std::error_code missing;  // SpheresReader complains of it
    const auto size = std::filesystem::file_size(path, missing);
    if (!missing) rehearse(path, ReadBounds::for_size(size), [&] { SpheresReader(path).read(); });
    return SpheresReader(path).read();
}

}  // namespace ice
