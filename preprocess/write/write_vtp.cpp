// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_vtp.hpp"

#include <bit>

namespace ice {

namespace {

static_assert(std::endian::native == std::endian::little, "the header says LittleEndian");

template <class T>
void append(fmt::memory_buffer& out, T value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    out.append(bytes, bytes + sizeof value);
}

template <class T>
void append(fmt::memory_buffer& out, const Vec3& v) {
    for (int d = 0; d < 3; ++d) append(out, static_cast<T>(v[d]));
}

// Arrays are announced in the header with the place of their bytes, which follow at its end in the
// same order: so nothing but the header is ever held in memory.
class AppendedArrays {
public:
    explicit AppendedArrays(std::size_t count) : count_(count) {}

    // row(out, k) appends `components` values of the VTK type `type`, `size` bytes each
    template <class Row>
    std::string add(const char* name, const char* type, std::size_t size, int components,
                    const Row& row) {
        std::string line = fmt::format(
            "        <DataArray Name=\"{}\" type=\"{}\" NumberOfComponents=\"{}\" "
            "format=\"appended\" offset=\"{}\"/>\n",
            name, type, components, offset_);
        // each array is preceded by its length in bytes, as header_type="UInt64" says
        const std::uint64_t bytes = count_ * size * static_cast<std::size_t>(components);
        offset_ += sizeof bytes + bytes;
        const std::size_t count = count_;
        writers_.push_back([bytes, count, row](const Sink& sink) {
            sink(std::string_view(reinterpret_cast<const char*>(&bytes), sizeof bytes));
            write_rows(sink, count, row);
        });
        return line;
    }
    void write(const Sink& sink) const {
        for (const auto& writer : writers_) writer(sink);
    }

private:
    std::size_t count_;
    std::uint64_t offset_ = 0;
    std::vector<std::function<void(const Sink&)>> writers_;
};

using Buffer = fmt::memory_buffer;

std::string point_data(const SphereSet& set, AppendedArrays& arrays) {
    return arrays.add("radius", "Float64", 8, 1, [&](Buffer& out, std::size_t k) {
        append(out, set.radii[k]);
    }) + arrays.add("normal", "Float32", 4, 3, [&](Buffer& out, std::size_t k) {
        append<float>(out, set.normal(k));
    }) + arrays.add("area", "Float64", 8, 1, [&](Buffer& out, std::size_t k) {
        append(out, set.area(k));
    }) + arrays.add("volume", "Float64", 8, 1, [&](Buffer& out, std::size_t k) {
        append(out, set.volumes[k]);
    }) + arrays.add("layer", "UInt8", 1, 1, [&](Buffer& out, std::size_t k) {
        append(out, static_cast<std::uint8_t>(set.on_surface(k) ? 1 : 0));
    }) + arrays.add("region", "Int32", 4, 1, [&](Buffer& out, std::size_t k) {
        append(out, set.region(k));
    });
}

}  // namespace

void write_vtp(const SphereSet& set, const Sink& sink) {
    // Raw bytes behind the header: text would be three times as long, and base64 a third longer.
    AppendedArrays arrays(set.size());
    sink(
        fmt::format("<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\">\n"
                    "  <PolyData>\n"
                    "    <Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                    "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
                    "      <PointData Scalars=\"radius\" Normals=\"normal\">\n",
                    set.size()));
    sink(point_data(set, arrays));
    sink("      </PointData>\n      <Points>\n");
    sink(arrays.add("Points", "Float64", 8, 3,
                    [&](Buffer& out, std::size_t k) { append<double>(out, set.centers[k]); }));
    sink("      </Points>\n      <Verts>\n");
    // one cell per sphere, so that thresholds and selections can take spheres apart
    sink(arrays.add("connectivity", "Int64", 8, 1,
                    [](Buffer& out, std::size_t k) { append(out, static_cast<std::int64_t>(k)); }));
    sink(arrays.add("offsets", "Int64", 8, 1, [](Buffer& out, std::size_t k) {
        append(out, static_cast<std::int64_t>(k + 1));
    }));
    sink("      </Verts>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_");
    arrays.write(sink);
    sink("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace ice
