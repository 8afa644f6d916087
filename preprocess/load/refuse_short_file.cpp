// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, OFF and binary STL state the amount of data after their header. It is counted before any
// reader sees the file: assimp 5.2 crashes on PLY and OFF files that were cut off.
#include "preprocess/load/refuse_short_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include "common/base/error.hpp"

namespace ice {

namespace {

// An element of a PLY header: rows of single values and lists.
struct Property {
    std::size_t count_size = 0;  // bytes of a list's length; 0: a single value
    std::size_t size = 0;        // bytes of a value
};
struct Element {
    std::string name;
    long count = 0;
    std::vector<Property> properties;
};
// Rows of an element that are believed [-]: no file has as many, and the sum over some thousand
// elements still fits into 64 bits. A larger value lets the sum overflow.
constexpr long kMostRows = 1L << 48;
struct PlyHeader {
    bool text = false, swapped = false;
    std::vector<Element> elements;
};

std::size_t size_of(const std::string& type) {
    for (const char* one : {"char", "uchar", "int8", "uint8"})
        if (type == one) return 1;
    for (const char* two : {"short", "ushort", "int16", "uint16"})
        if (type == two) return 2;
    return type == "double" || type == "float64" ? 8 : 4;
}

PlyHeader read_header(std::ifstream& in) {
    PlyHeader header;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word, type;
        words >> word;
        if (word == "end_header") break;
        if (word == "format") {
            words >> type;
            header.text = type == "ascii";
            header.swapped =
                (type == "binary_big_endian") != (std::endian::native == std::endian::big);
        } else if (word == "element") {
            Element element;
            words >> element.name >> element.count;
            // a damaged count must not overflow the sum of rows
            element.count = std::clamp(element.count, 0L, kMostRows);
            header.elements.push_back(element);
        } else if (word == "property" && !header.elements.empty()) {
            Property property;
            words >> type;
            // a list: the type of its length, then that of its entries
            if (type == "list") {
                words >> type;
                property.count_size = size_of(type);
                words >> type;
            }
            property.size = size_of(type);
            header.elements.back().properties.push_back(property);
        }
    }
    return header;
}

// Rows of an element that are whole in the bytes from `at` on, which moves behind them.
long whole_rows(const Element& element, bool swapped, const std::string& bytes, std::size_t& at) {
    // an element without properties has no bytes
    if (element.properties.empty()) return element.count;
    for (long row = 0; row < element.count; ++row) {
        std::size_t end = at;
        for (const Property& property : element.properties) {
            std::size_t values = 1;
            if (property.count_size > 0) {
                if (end + property.count_size > bytes.size()) return row;
                values = 0;
                for (std::size_t k = 0; k < property.count_size; ++k) {
                    // from the most significant byte on, whatever the machine's order
                    const std::size_t byte = swapped ? k : property.count_size - 1 - k;
                    values = values << 8 | static_cast<unsigned char>(bytes[end + byte]);
                }
                end += property.count_size;
            }
            // a damaged length would overflow the product below
            if (values > bytes.size()) return row;
            end += values * property.size;
            if (end > bytes.size()) return row;
        }
        at = end;
    }
    return element.count;
}

// Lines with something on them that is no comment, and the last of them.
long count_lines(std::ifstream& in, std::string& last) {
    long count = 0;
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#') continue;
        ++count;
        last = line;
    }
    return count;
}

// "3 7 8" needs two more numbers to be a triangle.
bool lacks_corners(const std::string& face) {
    std::istringstream words(face);
    long corners = 0, number = 0, found = 0;
    words >> corners;
    while (words >> number) ++found;
    return found < corners;
}

Error refusal(const std::filesystem::path& file, long promised, long found) {
    return bad_input(file.string(),
                     fmt::format("is cut off: its header promises {} vertices and faces, {} are "
                                 "whole",
                                 promised, found),
                     "export or copy the file again");
}

void check_text(const std::filesystem::path& file, std::ifstream& in, long promised) {
    std::string last;
    const long found = count_lines(in, last);
    if (found < promised) throw refusal(file, promised, found);
    // all lines are there, but the last one may be cut within
    if (found == promised && lacks_corners(last)) throw refusal(file, promised, found - 1);
}

void check_ply(const std::filesystem::path& file, std::ifstream& in) {
    const PlyHeader header = read_header(in);
    long promised = 0, found = 0;
    for (const Element& element : header.elements) promised += element.count;
    if (header.text) {
        check_text(file, in, promised);
        return;
    }
    // Rows of lists have no fixed length, so a binary file is walked through row by row.
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::size_t at = 0;
    for (const Element& element : header.elements) {
        const long whole = whole_rows(element, header.swapped, bytes, at);
        found += whole;
        if (whole < element.count) throw refusal(file, promised, found);
    }
}

void check_off(const std::filesystem::path& file, std::ifstream& in) {
    std::string line;
    if (!std::getline(in, line) || line.find("BINARY") != std::string::npos) return;
    const std::size_t word = line.find("OFF");
    // "OFF 8 12 0" in one line, or the counts in the next one that is no comment
    std::string counts = word == std::string::npos ? line : line.substr(word + 3);
    while (counts.find_first_of("0123456789") == std::string::npos && std::getline(in, counts))
        if (counts.find('#') != std::string::npos) counts.clear();
    long vertices = 0, faces = 0;
    if (std::istringstream(counts) >> vertices >> faces)
        check_text(file, in,
                   std::clamp(vertices, 0L, kMostRows) + std::clamp(faces, 0L, kMostRows));
}

// A binary STL states the number of triangles that follow, 50 bytes each; text begins with "solid".
void check_stl_length(const std::filesystem::path& file, std::ifstream& in) {
    std::array<char, 84> head{};
    in.read(head.data(), head.size());
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file));
    // text is judged by its last line (looks_cut_off.cpp)
    if (std::string_view(head.data(), 5) == "solid") return;
    if (size < 84)
        throw bad_input(file.string(),
                        fmt::format("is cut off: an STL has a header of 84 bytes, this {}", size),
                        "export or copy the file again");
    std::int64_t promised = 0;
    for (std::size_t k = 0; k < 4; ++k)
        promised |= std::int64_t{static_cast<unsigned char>(head[80 + k])} << (8 * k);
    const std::int64_t whole = (size - 84) / 50;
    if (whole < promised)
        throw bad_input(file.string(),
                        fmt::format("is cut off: its header promises {} triangles, {} are whole",
                                    promised, whole),
                        "export or copy the file again");
}

}  // namespace

void refuse_short_file(const std::filesystem::path& file) {
    std::string kind = file.extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::ifstream in(file, std::ios::binary);
    if (!in) return;
    if (kind == ".ply") check_ply(file, in);
    if (kind == ".off") check_off(file, in);
    if (kind == ".stl") check_stl_length(file, in);
}

}  // namespace ice
