// SPDX-License-Identifier: GPL-3.0-or-later
/// The tetrahedron (0,0,0), (1,0,0), (0,2,0), (0,0,3), times a scale, in every format that
/// spherize reads; FBX is in fbx_texts.hpp. Volume 1 and centroid (1/4, 1/2, 3/4) at scale 1: no
/// two axes are alike, so a wrong turn shows.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace ice::test {

using Corners = std::array<std::array<float, 3>, 4>;
using Faces = std::array<std::array<int, 3>, 4>;

inline constexpr Faces kTetrahedronFaces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

inline Corners tetrahedron_corners(float scale) {
    return {{{0, 0, 0}, {scale, 0, 0}, {0, 2 * scale, 0}, {0, 0, 3 * scale}}};
}

template <typename T>
void append_bytes(std::string& out, const T& value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

inline std::string obj_text(float scale) {
    std::string out;
    for (const auto& [x, y, z] : tetrahedron_corners(scale))
        out += fmt::format("v {} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kTetrahedronFaces)
        out += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return out;
}

inline std::string stl_text(float scale) {
    const Corners corners = tetrahedron_corners(scale);
    std::string out = "solid t\n";
    for (const auto& face : kTetrahedronFaces) {
        out += "facet normal 0 0 0\nouter loop\n";
        for (const int k : face) {
            const auto& [x, y, z] = corners[static_cast<std::size_t>(k)];
            out += fmt::format("vertex {} {} {}\n", x, y, z);
        }
        out += "endloop\nendfacet\n";
    }
    return out + "endsolid t\n";
}

inline std::string stl_bytes(float scale) {
    const Corners corners = tetrahedron_corners(scale);
    std::string out(80, ' ');
    append_bytes(out, std::uint32_t{4});
    for (const auto& face : kTetrahedronFaces) {
        append_bytes(out, std::array<float, 3>{});
        for (const int k : face) append_bytes(out, corners[static_cast<std::size_t>(k)]);
        append_bytes(out, std::uint16_t{0});
    }
    return out;
}

inline std::string ply_head(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text(float scale) {
    std::string out = ply_head("ascii");
    for (const auto& [x, y, z] : tetrahedron_corners(scale))
        out += fmt::format("{} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kTetrahedronFaces) out += fmt::format("3 {} {} {}\n", a, b, c);
    return out;
}

inline std::string ply_bytes(float scale) {
    std::string out = ply_head("binary_little_endian");
    for (const auto& corner : tetrahedron_corners(scale)) append_bytes(out, corner);
    for (const auto& face : kTetrahedronFaces) {
        out += '\3';
        append_bytes(out, face);
    }
    return out;
}

inline std::string off_text(float scale) {
    std::string out = "OFF\n4 4 6\n";
    for (const auto& [x, y, z] : tetrahedron_corners(scale))
        out += fmt::format("{} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kTetrahedronFaces) out += fmt::format("3 {} {} {}\n", a, b, c);
    return out;
}

/// @param asset   what stands in <asset> beside the dates: <unit>, <up_axis>
/// @param matrix  of the node "bow", 16 numbers by rows
inline std::string dae_text(float scale, const std::string& asset,
                            const std::string& matrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") {
    std::string numbers, indices;
    for (const auto& [x, y, z] : tetrahedron_corners(scale))
        numbers += fmt::format("{} {} {} ", x, y, z);
    for (const auto& [a, b, c] : kTetrahedronFaces) indices += fmt::format("{} {} {} ", a, b, c);
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
           "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
           "<asset><created>2020-01-01T00:00:00</created>"
           "<modified>2020-01-01T00:00:00</modified>" +
           asset +
           "</asset><library_geometries><geometry id=\"g\" name=\"g\"><mesh><source id=\"p\">"
           "<float_array id=\"pa\" count=\"12\">" +
           numbers +
           "</float_array><technique_common><accessor source=\"#pa\" count=\"4\" stride=\"3\">"
           "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
           "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
           "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" +
           indices +
           "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
           "<visual_scene id=\"s\"><node id=\"bow\" name=\"bow\"><matrix>" +
           matrix +
           "</matrix><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
           "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

inline std::string base64(const std::string& bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group =
                group << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            out += k + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63u];
    }
    return out;
}

inline std::string gltf_buffer(float scale) {
    std::string bytes;
    for (const auto& corner : tetrahedron_corners(scale)) append_bytes(bytes, corner);
    for (const auto& face : kTetrahedronFaces)
        for (const int k : face) append_bytes(bytes, static_cast<std::uint16_t>(k));
    return bytes;  // 48 + 24 bytes
}

/// @param nodes  JSON of the nodes; mesh 0 is the tetrahedron, node 0 the scene's only one
inline std::string gltf_json(float scale, const std::string& buffer_uri, const std::string& nodes) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":{},)"
        R"("meshes":[{{"name":"skin",)"
        R"("primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
        R"("buffers":[{{{}"byteLength":72}}],"bufferViews":[{{"buffer":0,"byteLength":48}},)"
        R"({{"buffer":0,"byteOffset":48,"byteLength":24}}],"accessors":[{{"bufferView":0,)"
        R"("componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[{},{},{}]}},)"
        R"({{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}]}})",
        nodes, buffer_uri, scale, 2 * scale, 3 * scale);
}

inline std::string gltf_text(float scale,
                             const std::string& nodes = R"([{"mesh":0,"name":"bow"}])") {
    return gltf_json(
        scale,
        R"("uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer(scale)) + "\",",
        nodes);
}

inline std::string glb_bytes(float scale) {
    std::string json = gltf_json(scale, "", R"([{"mesh":0,"name":"bow"}])");
    while (json.size() % 4 != 0) json += ' ';
    const std::string buffer = gltf_buffer(scale);
    const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
    std::string out = "glTF";
    append_bytes(out, std::uint32_t{2});
    append_bytes(out, 28 + size(json) + size(buffer));
    append_bytes(out, size(json));
    out += "JSON" + json;
    append_bytes(out, size(buffer));
    out += std::string("BIN\0", 4) + buffer;
    return out;
}

}  // namespace ice::test
