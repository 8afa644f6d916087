// SPDX-License-Identifier: GPL-3.0-or-later
/// VTK XML PolyData files (.vtp): appended raw data, zlib blocks, 64-bit headers. zlib only here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ice::paraview {

/// One array of a .vtp file: `components` numbers per row, raw little-endian bytes.
struct VtpArray {
    std::string name, type;  ///< type: Float32, Int32, UInt8, Int64
    int components = 1;
    std::vector<char> bytes;
};

VtpArray make_array(const std::string& name, int components, const std::vector<float>& values);
VtpArray make_array(const std::string& name, int components,
                    const std::vector<std::int32_t>& values);

/// Points, and triangles between them or, when there are none, a vertex per point.
struct VtpFile {
    std::vector<float> points;            ///< 3 per point [m]
    std::vector<std::int32_t> triangles;  ///< 3 indices of points each
    std::vector<VtpArray> point_data;     ///< a row per point
    std::vector<VtpArray> cell_data;      ///< a row per triangle or vertex
};

/// The file's content.
std::string vtp_text(const VtpFile& file);

/// Writes it. @throws Error (exit code 1) naming the path.
void write_vtp(const std::filesystem::path& path, const VtpFile& file);

}  // namespace ice::paraview
