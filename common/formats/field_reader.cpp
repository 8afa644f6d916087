// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of an ice field: the lengths of all arrays first, then shape after shape from its rows,
// then the floes.
#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/base/rehearse.hpp"
#include "common/formats/field_arrays.hpp"
#include "common/formats/field_file.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/refuse_other_format.hpp"
#include "common/formats/sealed_file.hpp"
#include "common/formats/sphere_set_faults.hpp"

namespace ice {

namespace {

constexpr const char* kRegion = "ice";

// Most bytes in memory per byte in the file [-]: 3 are usual where most spheres are inside, without
// rows of their own. A lower bound refuses sound fields, a higher one lets a damaged file take more
// memory before it is refused.
constexpr std::uint64_t kMostTimesField = 16;

// Reads one file, with every complaint naming the file and the dataset.
class FieldReader {
public:
    explicit FieldReader(const std::filesystem::path& path)
        : path_(path), file_(path, Hdf5File::Mode::read) {
        file_.limit_reading(kMostTimesField);
    }

    Field read() {
        Field field;
        read_header(field);
        refuse_changed(path_, file_, "icefield");
        read_all();
        check(!all_.spheres.empty(), "/shape/spheres", "is empty");
        for (std::size_t k = 0; k < all_.spheres.size(); ++k)
            field.shapes.push_back(take_shape(field, k));
        read_floes(field);
        return field;
    }

private:
    // Where the next shape's rows begin in the arrays.
    struct Cursor {
        std::size_t sphere = 0, surface = 0, crease = 0, vertex = 0, triangle = 0;
    };

    void check(bool good, const std::string& dataset, const std::string& what) const {
        if (!good)
            throw bad_input(path_.string() + ": " + dataset, what,
                            "make the file again with icefield");
    }

    double number(const char* name) const {
        const double value = file_.read_number_attribute("/", name)[0];
        check(std::isfinite(value), name, "is no finite number");
        return value;
    }

    // Attributes of the whole field. A version that is not known is refused and not guessed: a
    // wrong guess would build floes of other sizes.
    void read_header(Field& field) const {
        refuse_other_format(path_, file_, detail::kFieldFormat, "an ice field");
        check(file_.has_attribute("/", "format") &&
                  file_.read_text_attribute("/", "format") == detail::kFieldFormat,
              "/", "is not an ice field (no attribute format = \"icesolve-field\")");
        check(number("format_version") == detail::kFieldVersion, "/",
              "has a format_version this program does not know");
        field.radius = number("radius");
        field.spacing = number("spacing");
        check(field.radius > 0 && field.spacing > 0, "radius, spacing", "are not positive");
        field.mode = file_.read_text_attribute("/", "mode");
        const auto area = file_.read_number_attribute("/", "area");
        check(area.size() == 4, "area", "is not two corners");
        std::copy(area.begin(), area.end(), field.area.begin());
        field.concentration = number("concentration");
        field.seed = static_cast<std::int64_t>(number("seed"));
        field.specification = file_.read_text_attribute("/", "specification");
        field.created_by = file_.read_text_attribute("/", "created_by");
        field.command_line = file_.read_text_attribute("/", "command_line");
    }

    template <class T>
    std::vector<T> finite(const std::string& name, std::size_t size) const {
        std::vector<T> values = file_.read<T>(name);
        check(values.size() == size, name, "has another length than the arrays beside it");
        for (const T v : values)
            check(std::isfinite(static_cast<double>(v)), name, "holds a NaN or infinity");
        return values;
    }

    // rows of each shape in an array, and their sum
    std::size_t read_counts(const std::string& name, std::int64_t least,
                            std::vector<std::int64_t>& counts) const {
        // Rows of a shape, at most [-]: indices into them are 32 bits wide. It also keeps the sum
        // from overflowing. A larger value lets indices overflow, a smaller one refuses large
        // shapes.
        constexpr std::int64_t kMost = std::int64_t{1} << 31;
        counts = file_.read<std::int64_t>(name);
        std::int64_t sum = 0;
        for (const std::int64_t n : counts) {
            check(n >= least && n < kMost, name, "holds an impossible number of rows");
            sum += n;
        }
        return static_cast<std::size_t>(sum);
    }

    void read_all() {
        // A shape has a sphere, and a solid at least the four vertices and triangles of a
        // tetrahedron.
        const std::size_t n = read_counts("/shape/spheres", 1, all_.spheres);
        const std::size_t s = read_counts("/shape/surface_spheres", 1, all_.surface);
        const std::size_t c = read_counts("/shape/creases", 0, all_.creases);
        const std::size_t v = read_counts("/shape/vertices", 4, all_.vertices);
        const std::size_t t = read_counts("/shape/triangles", 4, all_.triangles);
        const std::size_t k = all_.spheres.size();
        // lengths first: every later index relies on them
        for (const auto& counts : {all_.surface, all_.creases, all_.vertices, all_.triangles})
            check(counts.size() == k, "/shape", "has arrays of different lengths");
        all_.volume = finite<double>("/shape/volume", k);
        all_.area = finite<double>("/shape/area", k);
        all_.centroid = finite<double>("/shape/centroid", 3 * k);
        all_.inertia = finite<double>("/shape/inertia", 9 * k);
        all_.center = finite<double>("/sphere/center", 3 * n);
        all_.share_volume = finite<double>("/sphere/volume", n);
        all_.normal = finite<float>("/surface/normal", 3 * s);
        all_.share_area = finite<double>("/surface/area", s);
        all_.spread = finite<float>("/surface/normal_spread", s);
        all_.crease_sphere = finite<std::int32_t>("/crease/sphere", c);
        all_.crease_normal = finite<float>("/crease/normal", 3 * c);
        all_.vertex = finite<double>("/mesh/vertices", 3 * v);
        all_.triangle = finite<std::int32_t>("/mesh/triangles", 3 * t);
    }

    template <class T>
    static Vec3 row(const std::vector<T>& flat, std::size_t k) {
        return {flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]};
    }

    SphereSet take_shape(const Field& field, std::size_t k) {
        SphereSet set;
        set.radius = field.radius;
        set.spacing = field.spacing;
        set.mode = field.mode;
        set.source_mesh = path_.filename().string();
        set.mesh.region_names = {kRegion};
        // Shapes lie one after the other in the arrays of the file: at_ counts the rows taken so
        // far.
        const auto n = static_cast<std::size_t>(all_.spheres[k]);
        set.surface_count = static_cast<std::size_t>(all_.surface[k]);
        check(set.surface_count <= n, "/shape/surface_spheres", "are more than the spheres");
        for (std::size_t i = 0; i < n; ++i, ++at_.sphere) {
            set.centers.push_back(row(all_.center, at_.sphere));
            set.volumes.push_back(all_.share_volume[at_.sphere]);
        }
        set.radii.assign(n, field.radius);
        for (std::size_t i = 0; i < set.surface_count; ++i, ++at_.surface) {
            const Vec3 normal = row(all_.normal, at_.surface);
            // 1e-3: wide for single precision, narrow for a normal that was never normalised
            check(std::abs(normal.norm() - 1.0) < 1e-3, "/surface/normal",
                  "holds a normal that is no unit vector");
            set.normals.push_back(normal.normalized());
            set.normal_spread.push_back(all_.spread[at_.surface]);
            set.areas.push_back(all_.share_area[at_.surface]);
            check(set.areas.back() >= 0, "/surface/area", "holds a negative area");
        }
        set.regions.assign(set.surface_count, 0);
        take_creases(static_cast<std::size_t>(all_.creases[k]), set);
        take_solid(k, set);
        // The seal guards against changed bytes only; a set written by another program may
        // contradict itself.
        const std::string fault = fault_of(set);
        check(fault.empty(), "/shape", fmt::format("has, of shape {}, {}", k, fault));
        return set;
    }

    void take_creases(std::size_t count, SphereSet& set) {
        for (std::size_t i = 0; i < count; ++i, ++at_.crease) {
            const std::int32_t sphere = all_.crease_sphere[at_.crease];
            check(sphere >= 0 && static_cast<std::size_t>(sphere) < set.surface_count,
                  "/crease/sphere", "points outside the surface spheres");
            set.creases.push_back({sphere, row(all_.crease_normal, at_.crease).normalized()});
        }
    }

    // Solid and mesh of shape k. The arrays hold all shapes one after the other, so `at_` counts
    // the rows that are used; corners are checked before anything is indexed with them.
    void take_solid(std::size_t k, SphereSet& set) {
        set.solid.volume = all_.volume[k];
        set.solid.area = all_.area[k];
        set.solid.centroid = row(all_.centroid, k);
        for (std::size_t i = 0; i < 9; ++i)
            set.solid.inertia(static_cast<int>(i / 3), static_cast<int>(i % 3)) =
                all_.inertia[9 * k + i];
        // the solid before its mesh: a wrong one is named at once
        const std::string fault = fault_of(set.solid);
        check(fault.empty(), "/shape", "has " + fault);
        const auto vertices = static_cast<std::size_t>(all_.vertices[k]);
        const auto triangles = static_cast<std::size_t>(all_.triangles[k]);
        for (std::size_t i = 0; i < vertices; ++i, ++at_.vertex)
            set.mesh.vertices.push_back(row(all_.vertex, at_.vertex));
        for (std::size_t i = 0; i < triangles; ++i, ++at_.triangle) {
            const std::int32_t* corner = &all_.triangle[3 * at_.triangle];
            for (int c = 0; c < 3; ++c)
                check(corner[c] >= 0 && static_cast<std::size_t>(corner[c]) < vertices,
                      "/mesh/triangles", "points outside the shape's vertices");
            set.mesh.triangles.push_back({corner[0], corner[1], corner[2]});
        }
        set.mesh.region.assign(triangles, 0);
    }

    void read_floes(Field& field) const {
        const auto shape = file_.read<std::int32_t>("/floe/shape");
        const std::size_t count = shape.size();
        const auto position = finite<double>("/floe/position", 2 * count);
        const auto orientation = finite<double>("/floe/orientation", 4 * count);
        const auto fixed = finite<std::uint8_t>("/floe/fixed", count);
        check(count > 0, "/floe/shape", "is empty");
        for (std::size_t i = 0; i < count; ++i) {
            FieldFloe floe;
            check(shape[i] >= 0 && static_cast<std::size_t>(shape[i]) < field.shapes.size(),
                  "/floe/shape", "points outside the shapes");
            floe.shape = shape[i];
            floe.position = {position[2 * i], position[2 * i + 1]};
            const double* q = &orientation[4 * i];
            floe.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
            // 1e-6: stored in double precision, possibly written by another program in single
            check(std::abs(floe.orientation.norm() - 1.0) < 1e-6, "/floe/orientation",
                  "holds a quaternion that is not of unit length");
            floe.fixed = fixed[i] != 0;
            field.floes.push_back(floe);
        }
    }

    std::filesystem::path path_;
    Hdf5File file_;
    detail::FieldArrays all_;
    Cursor at_;
};

}  // namespace

Field read_field(const std::filesystem::path& path) {
    std::error_code missing;  // FieldReader complains of it
    const auto size = std::filesystem::file_size(path, missing);
    if (!missing) rehearse(path, ReadBounds::for_size(size), [&] { FieldReader(path).read(); });
    return FieldReader(path).read();
}

}  // namespace ice
