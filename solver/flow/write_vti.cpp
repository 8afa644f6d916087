// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/write_vti.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "common/base/part_file.hpp"

namespace ice {

namespace {

static_assert(std::endian::native == std::endian::little, "the header says LittleEndian");

// An appended array: its size in bytes, then the bytes.
void append(const std::vector<float>& values, std::string& out) {
    const std::uint64_t size = values.size() * sizeof(float);
    char head[sizeof size];
    std::memcpy(head, &size, sizeof size);
    out.append(head, sizeof size);
    out.append(reinterpret_cast<const char*>(values.data()), size);
}

// Both sides of a symmetric table.
FlowTable whole(const FlowTable& half) {
    if (!half.symmetric) return half;
    FlowTable out = half;
    out.symmetric = false;
    // the plane y = 0 is in both halves, once in the whole
    out.nodes[1] = 2 * half.nodes[1] - 1;
    out.origin.y() = -half.spacing * static_cast<double>(half.nodes[1] - 1);
    out.velocity.clear();
    out.potential.clear();
    for (std::int64_t k = 0; k < half.nodes[2]; ++k)
        for (std::int64_t j = 1 - half.nodes[1]; j < half.nodes[1]; ++j)
            for (std::int64_t i = 0; i < half.nodes[0]; ++i) {
                // mirrored in y = 0: x and z components alike, the y component turned round
                const std::int64_t y = j < 0 ? -j : j;
                const auto at =
                    static_cast<std::size_t>((k * half.nodes[1] + y) * half.nodes[0] + i);
                const float* v = half.velocity.data() + 3 * at;
                out.velocity.insert(out.velocity.end(), {v[0], j < 0 ? -v[1] : v[1], v[2]});
                out.potential.push_back(half.potential[at]);
            }
    return out;
}

}  // namespace

void write_vti(const std::filesystem::path& file, const FlowTable& table) {
    const FlowTable t = whole(table);
    // VTK counts extents in nodes, from 0 to the last one
    const std::string extent =
        fmt::format("0 {} 0 {} 0 {}", t.nodes[0] - 1, t.nodes[1] - 1, t.nodes[2] - 1);
    std::string out = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} {3}\" Spacing=\"{4} {4} {4}\">\n"
        "<Piece Extent=\"{0}\"><PointData Vectors=\"velocity\" Scalars=\"potential\">\n"
        "<DataArray type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\" "
        "format=\"appended\" offset=\"0\"/>\n"
        "<DataArray type=\"Float32\" Name=\"potential\" format=\"appended\" offset=\"{5}\"/>\n"
        "</PointData></Piece></ImageData>\n<AppendedData encoding=\"raw\">_",
        extent, t.origin.x(), t.origin.y(), t.origin.z(), t.spacing,
        // where the second array begins: behind the first one and its size
        sizeof(std::uint64_t) + t.velocity.size() * sizeof(float));
    append(t.velocity, out);
    append(t.potential, out);
    write_text_file(file, out + "</AppendedData></VTKFile>\n");
}

}  // namespace ice
