// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/read_polygons.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/units.hpp"
#include "common/toml/input_file.hpp"

namespace ice {

namespace {

using Json = nlohmann::json;

// Bounds that refuse a file of another kind; none changes a floe.
constexpr std::uintmax_t kLargestPolygons = 64u << 20;  // [bytes]: a million corners fit
constexpr int kDeepest = 20;             // collections within collections; maps have few
constexpr std::size_t kMostQuoted = 60;  // characters of a bad row in a message

// GeoJSON nests: a collection of features, each with a geometry, which may be a collection or
// several polygons. Everything that is no polygon (points, lines, features without a geometry) is
// passed over, as maps of ice have labels and tracks beside the floes.
class GeoJsonReader {
public:
    GeoJsonReader(const std::filesystem::path& file, std::size_t& holes)
        : file_(file), holes_(holes) {}

    std::vector<NamedOutline> read(const std::string& text) {
        try {
            add(Json::parse(text));
        } catch (const Json::exception& error) {
            throw bad_input(file_.string(), fmt::format("is no GeoJSON: {}", error.what()),
                            "export the polygons as GeoJSON or CSV");
        }
        return std::move(out_);
    }

private:
    void add(const Json& node, int depth = 0) {
        // Recursion on a file that nests without an end would exhaust the stack.
        if (depth > kDeepest)
            throw bad_input(file_.string(), "nests collections too deeply", "flatten them");
        const std::string type = node.is_object() ? node.value("type", "") : "";
        if (type == "FeatureCollection") {
            for (const Json& feature : node.at("features")) {
                ++feature_;
                add(feature, depth + 1);
            }
        } else if (type == "Feature") {
            if (node.contains("geometry") && node.at("geometry").is_object())
                add(node.at("geometry"), depth + 1);
        } else if (type == "GeometryCollection") {
            for (const Json& geometry : node.at("geometries")) add(geometry, depth + 1);
        } else if (type == "MultiPolygon") {
            for (const Json& polygon : node.at("coordinates")) add_polygon(polygon);
        } else if (type == "Polygon") {
            add_polygon(node.at("coordinates"));
        }
    }

    // the first ring is the outline, the others are holes
    void add_polygon(const Json& rings) {
        if (rings.empty()) return;
        holes_ += rings.size() - 1;
        NamedOutline outline{fmt::format("feature {}", feature_), {}};
        for (const Json& point : rings.at(0))
            outline.corners.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
        out_.push_back(std::move(outline));
    }

    std::filesystem::path file_;
    std::size_t& holes_;
    std::size_t feature_ = 0;
    std::vector<NamedOutline> out_;
};

std::vector<NamedOutline> read_csv(const std::filesystem::path& file, const std::string& text) {
    std::vector<NamedOutline> out;
    std::istringstream lines(text);
    std::size_t number = 0;
    for (std::string line, id, last; std::getline(lines, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty() || line[0] == '#') continue;
        std::istringstream cells(line);
        std::string x_text, y_text;
        std::getline(cells, id, ',');
        std::getline(cells, x_text, ',');
        std::getline(cells, y_text, ',');
        const auto x = parse_quantity(x_text, Dimension::none);
        const auto y = parse_quantity(y_text, Dimension::none);
        // A first row of two words is a header; a row with one number is a fault, and so is a
        // second header.
        if (!x && !y && out.empty()) continue;  // the header
        if (!x || !y)
            throw bad_input(fmt::format("{}:{}", file.string(), number),
                            "is no row floe, x, y: '" + line.substr(0, kMostQuoted) +
                                (line.size() > kMostQuoted ? "...'" : "'"),
                            "write for instance 7, 12.5, -3");
        // Rows of one floe are adjacent: an id that comes again after another one begins another
        // outline, because one outline of both would jump.
        if (out.empty() || id != last) out.push_back({"floe " + id, {}});
        out.back().corners.emplace_back(x->value, y->value);
        last = id;
    }
    return out;
}

}  // namespace

std::vector<NamedOutline> read_polygons(const std::filesystem::path& file, std::size_t& holes) {
    const std::string text = read_input_text(file, "file of polygons", ".csv", kLargestPolygons);
    std::vector<NamedOutline> out =
        file.extension() == ".csv" ? read_csv(file, text) : GeoJsonReader(file, holes).read(text);
    if (out.empty())
        throw bad_input(file.string(), "holds no polygons",
                        "give GeoJSON polygons, or a .csv file of rows floe, x, y");
    // once for both formats: no later step compares with a number that is none
    for (const NamedOutline& polygon : out)
        for (const Vec2& p : polygon.corners)
            if (!p.allFinite())
                throw bad_input(file.string() + ": " + polygon.name, "has a NaN or infinity",
                                "remove it");
    return out;
}

}  // namespace ice
