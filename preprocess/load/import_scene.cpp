// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/import_scene.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cctype>
#include <fstream>
#include <iterator>
#include <new>
#include <sstream>
#include <string_view>

#include "common/base/error.hpp"
#include "common/base/rehearse.hpp"
#include "common/geometry/find_equal.hpp"
#include "preprocess/load/frame_of.hpp"
#include "preprocess/load/gunzip.hpp"
#include "preprocess/load/mesh_bytes.hpp"

namespace ice {

namespace {

using Mat4 = Eigen::Matrix4d;

constexpr std::array<std::string_view, 8> kFormats{"obj", "stl",  "ply", "off",
                                                   "dae", "gltf", "glb", "fbx"};
constexpr const char* kRemedy =
    "formats are OBJ, STL, PLY, OFF, DAE, glTF, FBX, each also with .gz";

// For each vertex the first one in the same place. Equal floats stay equal in any frame.
std::vector<std::int32_t> equal_places(const aiMesh& mesh) {
    const auto bits = [](float x) -> std::uint64_t {
        return std::bit_cast<std::uint32_t>(x + 0.0f);
    };
    return find_first(mesh.mNumVertices, [&](std::size_t k) -> Key {
        const aiVector3D& v = mesh.mVertices[k];
        return {bits(v.x), bits(v.y), bits(v.z)};
    });
}

// Walks the tree of nodes, since each may turn, scale or mirror the parts below it. assimp's own
// flattening would apply the root's unit and axes as well, which the command line may replace.
class Collector {
public:
    explicit Collector(const aiScene& scene) : scene_(scene), format_(format_of(scene)) {}

    TriangleMesh collect() {
        // the root of these two is assimp's own and holds the values that frame_of() reads
        const bool skip_root = format_ == "Collada" || format_ == "FBX";
        const Mat4 root =
            skip_root ? Mat4::Identity() : to_matrix(scene_.mRootNode->mTransformation);
        walk(*scene_.mRootNode, root);
        return std::move(out_);
    }

private:
    void walk(const aiNode& node, const Mat4& here) {
        for (unsigned k = 0; k < node.mNumMeshes; ++k)
            add(*scene_.mMeshes[node.mMeshes[k]], node, here);
        for (unsigned k = 0; k < node.mNumChildren; ++k)
            walk(*node.mChildren[k], here * to_matrix(node.mChildren[k]->mTransformation));
    }

    // Formats with a tree of nodes name the parts there; in the others the root node carries the
    // file's name and the mesh the group's.
    std::string part_name(const aiMesh& mesh, const aiNode& node) const {
        const std::string of_mesh = mesh.mName.C_Str(), of_node = node.mName.C_Str();
        if (!format_.empty()) return of_node.empty() ? of_mesh : of_node;
        return of_mesh.empty() && &node != scene_.mRootNode ? of_node : of_mesh;
    }

    std::int32_t region_of(const aiMesh& mesh, const aiNode& node) {
        const std::string name = part_name(mesh, node);
        // names that exporters write where the user gave none
        if (name.empty() || name == "default" || name == "defaultobject") return 0;
        const auto known = std::find(out_.region_names.begin(), out_.region_names.end(), name);
        if (known == out_.region_names.end()) {
            out_.region_names.push_back(name);
            return static_cast<std::int32_t>(out_.region_names.size()) - 1;
        }
        return static_cast<std::int32_t>(known - out_.region_names.begin());
    }

    void add(const aiMesh& mesh, const aiNode& node, const Mat4& here) {
        // a node may mirror its part: its triangles are then inside out
        const bool reflects = here.topLeftCorner<3, 3>().determinant() < 0.0;
        // Each place once: the next steps would take six times as long with a corner for each
        // triangle, as STL has them.
        const std::vector<std::int32_t> equal = equal_places(mesh);
        std::vector<std::int32_t> number(mesh.mNumVertices);
        for (std::size_t k = 0; k < number.size(); ++k) {
            if (equal[k] != static_cast<std::int32_t>(k)) {
                number[k] = number[static_cast<std::size_t>(equal[k])];
                continue;
            }
            const aiVector3D& v = mesh.mVertices[k];
            const Eigen::Vector4d p =
                here * Eigen::Vector4d(undo_float(v.x), undo_float(v.y), undo_float(v.z), 1.0);
            number[k] = static_cast<std::int32_t>(out_.vertices.size());
            out_.vertices.push_back(p.head<3>());
        }
        const std::int32_t region = region_of(mesh, node);
        out_.triangles.reserve(out_.triangles.size() + mesh.mNumFaces);
        out_.region.reserve(out_.region.size() + mesh.mNumFaces);
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const aiFace& face = mesh.mFaces[k];
            if (face.mNumIndices != 3) continue;
            std::array<std::int32_t, 3> t;
            for (std::size_t c = 0; c < 3; ++c) t[c] = number[face.mIndices[c]];
            if (reflects) std::swap(t[1], t[2]);
            out_.triangles.push_back(t);
            out_.region.push_back(region);
        }
    }

    const aiScene& scene_;
    const std::string format_;
    TriangleMesh out_;
};

// "stl" of "hull.STL" and "hull.stl.gz"; one of the formats that spherize reads.
std::string format_name(const std::filesystem::path& file) {
    const std::filesystem::path inner = is_gzip_name(file) ? file.stem() : file;
    std::string name = inner.extension().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!name.empty()) name.erase(0, 1);
    // "hull.gz" has lost its ending; the bytes of most formats do not show their kind
    if (name.empty() && is_gzip_name(file))
        throw bad_input(file.string(), "does not say the format inside",
                        "name it like hull.stl.gz");
    if (name.empty())
        throw bad_input(file.string(), "does not say its format", "name it like hull.stl");
    if (std::find(kFormats.begin(), kFormats.end(), name) == kFormats.end())
        throw bad_input(file.string(), "is of a format that is not read (." + name + ")", kRemedy);
    return name;
}

// assimp 5.2.5 reads on for ever in a PLY file that ends within its header.
void check_ply_header(const std::filesystem::path& file, std::string_view head) {
    if (!head.starts_with("ply")) return;
    if (head.find("\nend_header") == std::string_view::npos &&
        head.find("\rend_header") == std::string_view::npos)
        throw bad_input(file.string(), "cannot be read as a mesh (its PLY header has no end)",
                        "copy or export it again");
}

// assimp reads fifty formats; only the documented ones are accepted.
void keep_formats(Assimp::Importer& importer) {
    for (std::size_t k = importer.GetImporterCount(); k-- > 0;) {
        std::istringstream extensions(importer.GetImporterInfo(k)->mFileExtensions);
        const bool known = std::any_of(
            std::istream_iterator<std::string>(extensions), {}, [](const std::string& name) {
                return std::find(kFormats.begin(), kFormats.end(), name) != kFormats.end();
            });
        if (known) continue;
        Assimp::BaseImporter* const loader = importer.GetImporter(k);
        importer.UnregisterLoader(loader);
        delete loader;  // it is ours from then on
    }
}

// A mesh may have parts in files beside it (glTF's buffers), but none elsewhere.
class FilesBeside : public Assimp::DefaultIOSystem {
public:
    explicit FilesBeside(const std::filesystem::path& mesh)
        : folder_(std::filesystem::canonical(mesh).parent_path()) {}

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        std::error_code error;
        const auto path = std::filesystem::weakly_canonical(file, error);
        const auto [end, unused] =
            std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
        if (error || end != folder_.end() || *mode != 'r') return nullptr;
        return DefaultIOSystem::Open(file, mode);
    }

private:
    std::filesystem::path folder_;
};

std::string first_bytes(const std::filesystem::path& file) {
    // a header of a megabyte: real ones have some hundred bytes
    std::string head(1 << 20, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

// Remains of a damaged file, over which assimp's own steps would abort the program.
void check_faces(const std::filesystem::path& file, const aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const aiFace& face = mesh.mFaces[k];
            // all faces before the first is used: assimp's steps index without a test
            bool good = face.mNumIndices > 0;
            for (unsigned c = 0; c < face.mNumIndices; ++c)
                good = good && face.mIndices[c] < mesh.mNumVertices;
            if (!good)
                throw bad_input(file.string(),
                                fmt::format("face {} refers to no vertex or to one that is not "
                                            "there",
                                            k + 1),
                                "the file is cut short or damaged: copy or export it again");
        }
    }
}

// @param bytes  of an unpacked file; empty to read the file itself
const aiScene* read_scene(Assimp::Importer& importer, const std::filesystem::path& file,
                          const std::vector<char>& bytes) {
    const std::string format = format_name(file);
    keep_formats(importer);
    importer.SetIOHandler(new FilesBeside(file));  // which owns it
    if (is_gzip_name(file)) {
        check_ply_header(file, {bytes.data(), bytes.size()});
        return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
    }
    check_ply_header(file, first_bytes(file));
    return importer.ReadFile(file.string(), 0);
}

ImportedMesh import_once(const std::filesystem::path& file, const std::vector<char>& bytes) {
    Assimp::Importer importer;
    // a file of joints without surfaces would get surfaces for display
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // First without post-processing: triangulation of a damaged face would abort the program.
    const aiScene* scene = read_scene(importer, file, bytes);
    if (scene != nullptr) {
        check_faces(file, *scene);
        scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
    }
    // assimp catches exceptions that are not its own
    if (scene == nullptr && std::string_view(importer.GetErrorString()).ends_with("bad_alloc"))
        throw std::bad_alloc();
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw bad_input(file.string(),
                        fmt::format("cannot be read as a mesh ({})", importer.GetErrorString()),
                        "the file is damaged, or of another format than its name says: export it "
                        "again");
    return {Collector(*scene).collect(), frame_of(*scene)};
}

}  // namespace

ImportedMesh import_scene(const std::filesystem::path& file) {
    const std::vector<char> bytes = is_gzip_name(file) ? gunzip(file) : std::vector<char>();
    const std::uint64_t size = bytes.size() + std::filesystem::file_size(file);
    return from_bytes(read_in_child(file, ReadBounds::for_size(size),
                                    [&] { return to_bytes(import_once(file, bytes)); }));
}

}  // namespace ice
