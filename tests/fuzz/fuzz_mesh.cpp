// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh file behind a line with the ending of its name ("stl", "obj.gz"), read and cleaned up as
// spherize does.
#include "common/base/error.hpp"
#include "preprocess/clean/drop_repeats.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/orient_faces.hpp"
#include "preprocess/clean/weld.hpp"
#include "preprocess/load/half_hull.hpp"
#include "preprocess/load/looks_cut_off.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/load/refuse_short_file.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/library_faults.hpp"

using namespace ice;

namespace {

constexpr std::array<std::string_view, 11> kEndings{
    "obj", "stl", "ply", "off", "dae", "gltf", "glb", "fbx", "obj.gz", "ply.gz", "fbx.gz"};

void check_indices(const TriangleMesh& mesh) {
    if (mesh.region.size() != mesh.triangles.size())
        fuzz::report_finding("not every triangle has a region");
    for (const auto& triangle : mesh.triangles)
        for (const std::int32_t v : triangle)
            if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size())
                fuzz::report_finding("a triangle refers to a vertex that is not there");
    for (const std::int32_t r : mesh.region)
        if (r < 0 || static_cast<std::size_t>(r) >= mesh.region_names.size())
            fuzz::report_finding("a triangle refers to a region that is not there");
}

void read_and_clean(const std::filesystem::path& file) {
    refuse_short_file(file);
    ReadNotes notes;
    TriangleMesh mesh = read_mesh(file, {}, &notes);
    check_indices(mesh);
    (void)looks_cut_off(file);
    (void)looks_like_half_hull(mesh);
    weld(mesh);
    orient_faces(mesh);
    drop_repeats(mesh);
    (void)part_volumes(mesh, find_parts(mesh));
    check_indices(mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const std::string_view all(reinterpret_cast<const char*>(data), size);
    const std::string_view ending = all.substr(0, all.find('\n'));
    if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) return -1;
    const std::filesystem::path file = folder.write(
        "mesh." + std::string(ending), all.substr(std::min(all.size(), ending.size() + 1)));
    int verdict = 0;
    try {
        read_and_clean(file);
    } catch (const Error& refusal) {
        verdict = fuzz::verdict(refusal);
    }
    fuzz::check_child_faults();
    return verdict;
}
