// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/vtp_text.hpp"

#include <fmt/format.h>

#include <bit>
#include <numeric>
#include <span>

namespace ice {

namespace {

static_assert(std::endian::native == std::endian::little, "the header says LittleEndian");

// Collects arrays: each is announced in the header and its bytes follow at the end of the file.
class AppendedArrays {
public:
    template <class T>
    std::string add(const char* name, const char* type, std::span<const T> values,
                    int components = 1) {
        const std::string line = fmt::format(
            "        <DataArray Name=\"{}\" type=\"{}\" NumberOfComponents=\"{}\" "
            "format=\"appended\" offset=\"{}\"/>\n",
            name, type, components, bytes_.size());
        const std::uint64_t size = values.size_bytes();
        bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
        bytes_.append(reinterpret_cast<const char*>(values.data()), size);
        return line;
    }
    std::string points(const char* name, const std::vector<Vec3>& values) {
        std::vector<double> flat;
        for (const Vec3& v : values) flat.insert(flat.end(), {v.x(), v.y(), v.z()});
        return add<double>(name, "Float64", flat, 3);
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

}  // namespace

std::string vtp_text(const SphereSet& set) {
    // arrays of the surface, with the interior's rows 0
    SphereSet whole = set;
    whole.normals.resize(set.size(), Vec3::Zero());
    whole.areas.resize(set.size(), 0.0);
    whole.regions.resize(set.size(), 0);
    std::vector<std::uint8_t> layers(set.surface_count, 1);
    layers.resize(set.size(), 0);
    AppendedArrays arrays;
    std::vector<std::int64_t> ends(set.size()), vertices(set.size());
    std::iota(vertices.begin(), vertices.end(), 0);
    std::iota(ends.begin(), ends.end(), 1);
    std::string out = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "  <PolyData>\n"
        "    <Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        set.size());
    out += "      <PointData Scalars=\"radius\" Normals=\"normal\">\n";
    out += arrays.add<double>("radius", "Float64", set.radii);
    out += arrays.points("normal", whole.normals);
    out += arrays.add<double>("area", "Float64", whole.areas);
    out += arrays.add<double>("volume", "Float64", set.volumes);
    out += arrays.add<std::uint8_t>("layer", "UInt8", layers);
    out += arrays.add<std::int32_t>("region", "Int32", whole.regions);
    out += "      </PointData>\n      <Points>\n";
    out += arrays.points("Points", set.centers);
    out += "      </Points>\n      <Verts>\n";
    out += arrays.add<std::int64_t>("connectivity", "Int64", vertices);
    out += arrays.add<std::int64_t>("offsets", "Int64", ends);
    out += "      </Verts>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
    return out + arrays.bytes() + "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace ice
