// SPDX-License-Identifier: GPL-3.0-or-later
// A field specification, one override and a file of polygons, with zero bytes between them.
#include "common/base/error.hpp"
#include "preprocess/field/field_spec.hpp"
#include "preprocess/field/read_polygons.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace ice;

namespace {

void try_polygons(const std::filesystem::path& file) {
    try {
        std::size_t holes = 0;
        read_polygons(file, holes);
    } catch (const Error&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const auto [text, change, polygons] = fuzz::split<3>(data, size);
    if (!polygons.empty()) {
        try_polygons(folder.write("floes.geojson", polygons));
        try_polygons(folder.write("floes.csv", polygons));
    }
    try {
        std::vector<std::string> overrides;
        if (!change.empty()) overrides.emplace_back(change);
        read_field_spec(folder.write("floes.toml", text), overrides);
    } catch (const Error&) {
    }
    return 0;
}
