// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/read_obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "common/base/error.hpp"
#include "preprocess/load/triangulate_polygon.hpp"

namespace ice {

namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view next_word(std::string_view& line) {
    const std::size_t begin = std::min(line.find_first_not_of(kBlank), line.size());
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

template <class T>
std::optional<T> to_number(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);  // from_chars takes no plus
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

class ObjReader {
public:
    explicit ObjReader(const std::filesystem::path& file) : file_(file) {}

    TriangleMesh read() {
        std::ifstream in(file_, std::ios::binary);
        if (!in) throw bad_input(file_.string(), "cannot be read", "check its permissions");
        std::string line, piece;
        while (std::getline(in, piece)) {
            ++number_;
            if (!piece.empty() && piece.back() == '\r') piece.pop_back();
            // a backslash continues the line
            if (!piece.empty() && piece.back() == '\\') {
                line += piece.substr(0, piece.size() - 1) + ' ';
                continue;
            }
            line += piece;
            read_line(std::string_view(line).substr(0, line.find('#')));
            line.clear();
        }
        return std::move(mesh_);
    }

private:
    [[noreturn]] void complain(const std::string& what, const std::string& remedy) const {
        throw bad_input(fmt::format("{}:{}", file_.string(), number_), what, remedy);
    }

    void read_line(std::string_view line) {
        const std::string_view key = next_word(line);
        if (key == "v")
            read_vertex(line);
        else if (key == "f")
            read_face(line);
        else if (key == "o" || key == "g")
            name_region(key == "o", next_word(line));
    }

    void read_vertex(std::string_view line) {
        Vec3 v;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = next_word(line);
            const auto value = to_number<double>(word);
            if (!value || !std::isfinite(*value))
                complain(fmt::format("vertex coordinate '{}' is not a finite number", word),
                         "repair or export the mesh again");
            v[k] = *value;
        }
        mesh_.vertices.push_back(v);
    }

    void read_face(std::string_view line) {
        std::vector<std::int32_t> face;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
            // vertex/texture/normal: only the vertex matters
            const auto index = to_number<std::int64_t>(word.substr(0, word.find('/')));
            const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
            // negative numbers count back from the latest vertex
            const std::int64_t vertex = !index ? -1 : *index > 0 ? *index - 1 : count + *index;
            if (!index || *index == 0 || vertex < 0 || vertex >= count)
                complain(fmt::format("face corner '{}' names no vertex; there are {} so far", word,
                                     count),
                         "export the mesh again");
            face.push_back(static_cast<std::int32_t>(vertex));
        }
        if (face.size() < 3)
            complain(fmt::format("a face has {} corners", face.size()), "export the mesh again");
        std::vector<Vec3> corners;
        for (const std::int32_t v : face)
            corners.push_back(mesh_.vertices[static_cast<std::size_t>(v)]);
        for (const auto& [a, b, c] : triangulate_polygon(corners)) {
            mesh_.triangles.push_back({face[a], face[b], face[c]});
            mesh_.region.push_back(region_);
        }
    }

    void name_region(bool object, std::string_view name) {
        if (name == "default" || name == "off") name = {};
        if (object) object_ = name;
        if (name.empty()) name = object_;
        if (name.empty()) {
            region_ = 0;
            return;
        }
        const auto next = static_cast<std::int32_t>(mesh_.region_names.size());
        const auto [known, fresh] = rows_.try_emplace(std::string(name), next);
        if (fresh) mesh_.region_names.emplace_back(name);
        region_ = known->second;
    }

    std::filesystem::path file_;
    std::int64_t number_ = 0;
    TriangleMesh mesh_;
    std::map<std::string, std::int32_t> rows_{{"hull", 0}};
    std::string object_;
    std::int32_t region_ = 0;
};

}  // namespace

TriangleMesh read_obj(const std::filesystem::path& file) { return ObjReader(file).read(); }

}  // namespace ice
