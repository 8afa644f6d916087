// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/read_mesh.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>

#include "common/base/error.hpp"
#include "preprocess/load/half_hull.hpp"

namespace ice {

namespace {

using Mat4 = Eigen::Matrix4d;

Mat4 to_matrix(const aiMatrix4x4& m) {
    Mat4 out;
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c) out(r, c) = static_cast<double>(m[r][c]);
    return out;
}

// Unit vector of "+x", "-y", ...
Vec3 direction(const std::string& name) {
    const double sign = name[0] == '-' ? -1.0 : 1.0;
    return sign * Vec3::Unit(name.back() - 'x');
}

// Rotation from the file's axes to the ship frame.
Mat3 orientation(const ReadOptions& o) {
    const Vec3 up = direction("+" + o.up), forward = direction(o.forward);
    if (std::abs(up.dot(forward)) > 0.5)
        throw bad_input("--forward " + o.forward, "points along the up axis " + o.up,
                        "choose --up and --forward at right angles");
    Mat3 m;
    m.row(0) = forward.transpose();
    m.row(1) = up.cross(forward).transpose();
    m.row(2) = up.transpose();
    return m;
}

// assimp keeps vertices as floats: "0.3" comes back as 0.300000012. Models are drawn in round
// numbers, so the shortest decimal that gives the same float is what the file said.
double undo_float(float x) {
    if (x == 0.0f || !std::isfinite(x)) return static_cast<double>(x);
    return std::stod(fmt::format("{}", x));
}

class Collector {
public:
    explicit Collector(const aiScene& scene) : scene_(scene) {}

    TriangleMesh collect() {
        walk(*scene_.mRootNode, Mat4::Identity());
        return std::move(out_);
    }

private:
    void walk(const aiNode& node, const Mat4& parent) {
        const Mat4 here = parent * to_matrix(node.mTransformation);
        for (unsigned k = 0; k < node.mNumMeshes; ++k)
            add(*scene_.mMeshes[node.mMeshes[k]], node, here);
        for (unsigned k = 0; k < node.mNumChildren; ++k) walk(*node.mChildren[k], here);
    }

    std::int32_t region_of(const aiMesh& mesh, const aiNode& node) {
        std::string name = mesh.mName.C_Str();
        // formats with named nodes leave the mesh unnamed; the root node carries the file's name
        if (name.empty() && &node != scene_.mRootNode) name = node.mName.C_Str();
        if (name.empty() || name == "default" || name == "defaultobject") return 0;
        const auto known = std::find(out_.region_names.begin(), out_.region_names.end(), name);
        if (known == out_.region_names.end()) {
            out_.region_names.push_back(name);
            return static_cast<std::int32_t>(out_.region_names.size()) - 1;
        }
        return static_cast<std::int32_t>(known - out_.region_names.begin());
    }

    void add(const aiMesh& mesh, const aiNode& node, const Mat4& here) {
        const auto first = static_cast<std::int32_t>(out_.vertices.size());
        const bool reflects = here.topLeftCorner<3, 3>().determinant() < 0.0;
        for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
            const aiVector3D& v = mesh.mVertices[k];
            const Eigen::Vector4d p =
                here * Eigen::Vector4d(undo_float(v.x), undo_float(v.y), undo_float(v.z), 1.0);
            out_.vertices.push_back(p.head<3>());
        }
        const std::int32_t region = region_of(mesh, node);
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const aiFace& face = mesh.mFaces[k];
            if (face.mNumIndices != 3) continue;
            std::array<std::int32_t, 3> t;
            for (std::size_t c = 0; c < 3; ++c)
                t[c] = first + static_cast<std::int32_t>(face.mIndices[c]);
            if (reflects) std::swap(t[1], t[2]);
            out_.triangles.push_back(t);
            out_.region.push_back(region);
        }
    }

    const aiScene& scene_;
    TriangleMesh out_;
};

void check_finite(const TriangleMesh& mesh, const std::filesystem::path& file) {
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
        if (!mesh.vertices[k].allFinite())
            throw bad_input(file.string(), fmt::format("vertex {} is not a finite number", k + 1),
                            "repair or export the mesh again");
}

TriangleMesh read_with_assimp(const std::filesystem::path& file) {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene =
        importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw bad_input(file.string(),
                        fmt::format("cannot be read as a mesh ({})", importer.GetErrorString()),
                        "formats are OBJ, STL, PLY, OFF, DAE, glTF and others assimp reads");
    return Collector(*scene).collect();
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
                       std::int64_t* centre_plane_dropped) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw bad_input(file.string(), "mesh file not found", "check the path");
    const Mat3 turn = options.scale * orientation(options);

    TriangleMesh mesh = read_with_assimp(file);
    check_finite(mesh, file);
    if (mesh.triangles.empty())
        throw bad_input(file.string(), "holds no triangles", "export the hull's surface as a mesh");
    for (Vec3& v : mesh.vertices) v = turn * v;
    if (options.mirror_y) {
        const std::int64_t dropped = drop_centre_plane(mesh);
        if (centre_plane_dropped != nullptr) *centre_plane_dropped = dropped;
        add_mirror_image(mesh);
    }
    return mesh;
}

}  // namespace ice
