// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/paraview/vtp.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstring>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"

namespace ice::paraview {

namespace {

static_assert(std::endian::native == std::endian::little, "files are written in this byte order");

// The appended data: every array is a header {blocks, block size, size of a last partial block,
// compressed size of each block} of 64-bit numbers, then the blocks. One block per array.
class Appended {
public:
    std::string add(const VtpArray& array) {
        const std::size_t offset = bytes_.size();
        const std::uint64_t size = array.bytes.size();
        if (size == 0) {
            append_number(0);
        } else {
            uLongf packed = compressBound(size);
            std::vector<Bytef> block(packed);
            if (compress2(block.data(), &packed, reinterpret_cast<const Bytef*>(array.bytes.data()),
                          size, 5) != Z_OK)
                throw run_failed(array.name, "cannot be compressed", "free some memory");
            for (const std::uint64_t number :
                 {std::uint64_t{1}, size, std::uint64_t{0}, static_cast<std::uint64_t>(packed)})
                append_number(number);
            bytes_.append(reinterpret_cast<const char*>(block.data()), packed);
        }
        return fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            array.type, array.name, array.components, offset);
    }
    const std::string& bytes() const { return bytes_; }

private:
    void append_number(std::uint64_t number) {
        char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        bytes_.append(raw, sizeof number);
    }
    std::string bytes_;
};

template <class T>
VtpArray pack(const std::string& name, const char* type, int components,
              const std::vector<T>& values) {
    VtpArray array{name, type, components, {}};
    array.bytes.resize(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(array.bytes.data(), values.data(), array.bytes.size());
    return array;
}

std::string data_element(const char* tag, const std::vector<VtpArray>& arrays, Appended& data) {
    std::string out = fmt::format("<{}>\n", tag);
    for (const VtpArray& array : arrays) out += data.add(array);
    return out + fmt::format("</{}>\n", tag);
}

// cells with `corners` points each
std::string cells_element(const char* tag, const std::vector<std::int32_t>& connectivity,
                          int corners, Appended& data) {
    std::vector<std::int32_t> offsets;
    for (std::size_t end = static_cast<std::size_t>(corners); end <= connectivity.size();
         end += static_cast<std::size_t>(corners))
        offsets.push_back(static_cast<std::int32_t>(end));
    return data_element(
        tag, {make_array("connectivity", 1, connectivity), make_array("offsets", 1, offsets)},
        data);
}

}  // namespace

VtpArray make_array(const std::string& name, int components, const std::vector<float>& values) {
    return pack(name, "Float32", components, values);
}

VtpArray make_array(const std::string& name, int components,
                    const std::vector<std::int32_t>& values) {
    return pack(name, "Int32", components, values);
}

std::string vtp_text(const VtpFile& file) {
    const std::size_t points = file.points.size() / 3, triangles = file.triangles.size() / 3;
    std::vector<std::int32_t> singles;
    if (file.triangles.empty())
        for (std::size_t k = 0; k < points; ++k) singles.push_back(static_cast<std::int32_t>(k));
    Appended data;
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\">\n";
    out += fmt::format(
        "<PolyData><Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
        points, singles.size(), triangles);
    out += data_element("Points", {make_array("Points", 3, file.points)}, data);
    out += data_element("PointData", file.point_data, data);
    out += data_element("CellData", file.cell_data, data);
    out += cells_element("Verts", singles, 1, data);
    out += cells_element("Polys", file.triangles, 3, data);
    out += "</Piece></PolyData>\n<AppendedData encoding=\"raw\">_";
    out += data.bytes();
    return out + "</AppendedData></VTKFile>\n";
}

void write_vtp(const std::filesystem::path& path, const VtpFile& file) {
    write_text_file(path, vtp_text(file));
}

}  // namespace ice::paraview
