// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/frame_of.hpp"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <array>
#include <charconv>
#include <cmath>

namespace ice {

double undo_float(float x) {
    if (x == 0.0f || !std::isfinite(x)) return static_cast<double>(x);
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
    double value = 0.0;
    std::from_chars(text.data(), end, value);
    return value;
}

Eigen::Matrix4d to_matrix(const aiMatrix4x4& m) {
    Eigen::Matrix4d out;
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c) out(r, c) = undo_float(m[r][c]);
    return out;
}

std::string format_of(const aiScene& scene) {
    aiString name;
    if (scene.mMetaData == nullptr || !scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, name))
        return {};
    const std::string text = name.C_Str();
    for (const char* known : {"glTF", "Collada", "FBX"})
        if (text.find(known) != std::string::npos) return known;
    return {};
}

namespace {

// The root is the file's unit times the rotation that takes its up axis to y: the second row is
// that axis, as long as the unit.
FileFrame collada_frame(const aiScene& scene) {
    FileFrame frame;
    const Vec3 up = to_matrix(scene.mRootNode->mTransformation).row(1).head<3>().transpose();
    int axis = 0;
    const double unit = up.cwiseAbs().maxCoeff(&axis);
    if (unit > 0.0) frame.metres = unit;
    frame.up = Direction{axis, up[axis] >= 0.0};
    return frame;
}

std::optional<Direction> fbx_axis(const aiMetadata& data, const std::string& name) {
    int axis = 0, sign = 1;
    if (!data.Get(name, axis) || axis < 0 || axis > 2) return std::nullopt;
    data.Get(name + "Sign", sign);
    return Direction{axis, sign >= 0};
}

FileFrame fbx_frame(const aiMetadata& data) {
    FileFrame frame;
    float single = 0.0f;
    double centimetres = 0.0;
    // a float in assimp 5.2, which requires the exact type
    if (data.Get("UnitScaleFactor", single))
        centimetres = undo_float(single);
    else
        data.Get("UnitScaleFactor", centimetres);
    if (centimetres > 0.0 && std::isfinite(centimetres)) frame.metres = centimetres / 100.0;
    frame.up = fbx_axis(data, "UpAxis");
    frame.front = fbx_axis(data, "FrontAxis");
    const auto right = fbx_axis(data, "CoordAxis");
    if (frame.up && frame.front && right)
        frame.left_handed =
            right->vector().cross(frame.up->vector()).dot(frame.front->vector()) < -0.5;
    return frame;
}

}  // namespace

FileFrame frame_of(const aiScene& scene) {
    const std::string format = format_of(scene);
    FileFrame frame;
    if (format == "Collada") frame = collada_frame(scene);
    if (format == "FBX") frame = fbx_frame(*scene.mMetaData);
    if (format == "glTF") {
        // by its definition: metres, y up, the front along z
        frame.metres = 1.0;
        frame.up = Direction{1, true};
        frame.front = Direction{2, true};
    }
    frame.format = format;
    return frame;
}

}  // namespace ice
