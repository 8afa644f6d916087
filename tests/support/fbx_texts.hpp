// SPDX-License-Identifier: GPL-3.0-or-later
/// The tetrahedron of mesh_texts.hpp as FBX, text and binary.
#pragma once

#include <vector>

#include "tests/support/mesh_texts.hpp"

namespace ice::test {

/// @param settings  lines of GlobalSettings, such as fbx_settings()
inline std::string fbx_text(float scale, const std::string& settings,
                            const std::string& scaling = "1,1,1") {
    std::string numbers, indices;
    for (const auto& [x, y, z] : tetrahedron_corners(scale))
        numbers += fmt::format("{}{},{},{}", numbers.empty() ? "" : ",", x, y, z);
    for (const auto& [a, b, c] : kTetrahedronFaces)  // the last of a face is given as -index - 1
        indices += fmt::format("{}{},{},{}", indices.empty() ? "" : ",", a, b, -c - 1);
    return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n"
           " FBXVersion: 7400\n Creator: \"test\"\n}\nGlobalSettings: {\n Version: 1000\n"
           " Properties70: {\n" +
           settings +
           " }\n}\nObjects: {\n Geometry: 1, \"Geometry::bow\", \"Mesh\" {\n  Vertices: *12 {\n"
           "   a: " +
           numbers + "\n  }\n  PolygonVertexIndex: *12 {\n   a: " + indices +
           "\n  }\n  GeometryVersion: 124\n }\n Model: 2, \"Model::bow\", \"Mesh\" {\n"
           "  Version: 232\n  Properties70: {\n   P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", "
           "\"A\"," +
           scaling + "\n  }\n }\n}\nConnections: {\n C: \"OO\",2,0\n C: \"OO\",1,2\n}\n";
}

/// Axes are 0, 1, 2 for x, y, z. @param centimetres  per file unit
inline std::string fbx_settings(int up, int up_sign, int front, int front_sign, int right,
                                double centimetres) {
    const auto line = [](const char* name, int value) {
        return fmt::format("  P: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, value);
    };
    return line("UpAxis", up) + line("UpAxisSign", up_sign) + line("FrontAxis", front) +
           line("FrontAxisSign", front_sign) + line("CoordAxis", right) + line("CoordAxisSign", 1) +
           fmt::format("  P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n", centimetres);
}

/// A record of a binary FBX file; its properties are encoded already.
struct FbxNode {
    std::string name;
    std::vector<std::string> properties;
    std::vector<FbxNode> children = {};

    /// Its bytes when it begins at `offset` of the file: ends are absolute.
    std::string bytes(std::size_t offset) const {
        std::string values, inside;
        for (const std::string& p : properties) values += p;
        const std::size_t head = 13 + name.size() + values.size();
        for (const FbxNode& child : children) inside += child.bytes(offset + head + inside.size());
        if (!children.empty()) inside += std::string(13, '\0');
        std::string out;
        for (const std::size_t n :
             {offset + head + inside.size(), properties.size(), values.size()})
            append_bytes(out, static_cast<std::uint32_t>(n));
        return out + static_cast<char>(name.size()) + name + values + inside;
    }
};

template <typename T>
std::string fbx_value(char type, const T& value) {
    std::string out(1, type);
    append_bytes(out, value);
    return out;
}

inline std::string fbx_string(const std::string& text) {
    return fbx_value('S', static_cast<std::uint32_t>(text.size())) + text;
}

template <typename T>
std::string fbx_array(char type, const std::vector<T>& values) {
    std::string out = fbx_value(type, static_cast<std::uint32_t>(values.size()));
    append_bytes(out, std::uint32_t{0});  // not compressed
    append_bytes(out, static_cast<std::uint32_t>(values.size() * sizeof(T)));
    for (const T& value : values) append_bytes(out, value);
    return out;
}

/// Version 7.4, y up, front z. @param centimetres  per file unit
inline std::string fbx_bytes(float scale, double centimetres) {
    std::vector<double> numbers;
    std::vector<std::int32_t> indices;
    for (const auto& corner : tetrahedron_corners(scale))
        numbers.insert(numbers.end(), corner.begin(), corner.end());
    for (const auto& [a, b, c] : kTetrahedronFaces) indices.insert(indices.end(), {a, b, -c - 1});
    const auto setting = [](const char* name, const char* type, const std::string& value) {
        return FbxNode{"P",
                       {fbx_string(name), fbx_string(type), fbx_string(""), fbx_string(""), value}};
    };
    const auto number = [](std::int64_t n) { return fbx_value('L', n); };
    const auto link = [&](std::int64_t from, std::int64_t to) {
        return FbxNode{"C", {fbx_string("OO"), number(from), number(to)}};
    };
    const std::string separator("\0\1", 2);
    const FbxNode nodes[] = {
        {"FBXHeaderExtension", {}, {{"FBXVersion", {fbx_value('I', std::int32_t{7400})}}}},
        {"GlobalSettings",
         {},
         {{"Properties70",
           {},
           {setting("UpAxis", "int", fbx_value('I', std::int32_t{1})),
            setting("FrontAxis", "int", fbx_value('I', std::int32_t{2})),
            setting("CoordAxis", "int", fbx_value('I', std::int32_t{0})),
            setting("UnitScaleFactor", "double", fbx_value('D', centimetres))}}}},
        {"Objects",
         {},
         {{"Geometry",
           {number(1), fbx_string("bow" + separator + "Geometry"), fbx_string("Mesh")},
           {{"Vertices", {fbx_array('d', numbers)}},
            {"PolygonVertexIndex", {fbx_array('i', indices)}}}},
          {"Model",
           {number(2), fbx_string("bow" + separator + "Model"), fbx_string("Mesh")},
           {{"Version", {fbx_value('I', std::int32_t{232})}}}}}},
        {"Connections", {}, {link(2, 0), link(1, 2)}}};
    std::string out("Kaydara FBX Binary  \0\x1a\0", 23);
    append_bytes(out, std::uint32_t{7400});
    for (const FbxNode& node : nodes) out += node.bytes(out.size());
    return out + std::string(13, '\0');
}

}  // namespace ice::test
