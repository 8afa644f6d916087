// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/looks_cut_off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <string_view>

namespace ice {

namespace {

std::string cut_off(const std::string& sign) { return "the file seems cut off: " + sign; }

// Largest vertex number of an OBJ face line "f 1/2/3 4//5 -1"; `corners` takes how many it names.
long largest_vertex(std::string_view line, long vertices, int& corners) {
    long largest = 0;
    for (std::size_t at = 1; at < line.size();) {
        at = line.find_first_not_of(" \t\r", at);
        if (at == std::string_view::npos) break;
        long number = 0;
        std::from_chars(line.data() + at, line.data() + line.size(), number);
        // a negative number counts back from the vertex before the line
        largest = std::max(largest, number < 0 ? vertices + number + 1 : number);
        ++corners;
        at = std::min(line.find_first_of(" \t", at), line.size());
    }
    return largest;
}

std::string check_obj(std::ifstream& in) {
    long vertices = 0, used = 0;
    int corners = 3;  // of the last face
    bool last_is_face = false;
    for (std::string line; std::getline(in, line);) {
        last_is_face = line.starts_with("f ");
        if (line.starts_with("v ")) ++vertices;
        if (!last_is_face) continue;
        corners = 0;
        used = std::max(used, largest_vertex(line, vertices, corners));
    }
    // Faces come last in a file: without its end vertices are left that no face uses.
    if (used > 0 && used < vertices)
        return cut_off(fmt::format("no face uses its last {} vertices", vertices - used));
    if (last_is_face && corners < 3)
        return cut_off(fmt::format("its last face has {} corners", corners));
    return {};
}

// Of text only: a binary PLY may end in any byte.
std::string check_last_line(std::ifstream& in) {
    // "format binary_..." and "OFF BINARY" stand in the first two lines
    std::string line;
    for (int k = 0; k < 2 && std::getline(in, line); ++k)
        if (line.find("binary") != std::string::npos) return {};
    // the loop above may have reached the end of a short file
    in.clear();
    in.seekg(-1, std::ios::end);
    return in.get() == '\n' ? std::string() : cut_off("its last line does not end");
}

std::string check_stl(std::ifstream& in) {
    std::string line, last;
    if (!std::getline(in, line) || !line.starts_with("solid")) return {};
    bool facets = false;
    while (std::getline(in, line)) {
        // a binary file may begin with the same word
        if (line.find('\0') != std::string::npos) return {};
        if (line.find("facet") != std::string::npos) facets = true;
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    }
    if (facets && last.find("endsolid") == std::string::npos)
        return cut_off("its last line is not \"endsolid\"");
    return {};
}

}  // namespace

std::string looks_cut_off(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string kind = file.extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!in) return {};
    if (kind == ".ply" || kind == ".off") return check_last_line(in);
    if (kind == ".obj") return check_obj(in);
    return kind == ".stl" ? check_stl(in) : std::string();
}

}  // namespace ice
