// SPDX-License-Identifier: GPL-3.0-or-later
/// Closed meshes made in code.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "common/geometry/triangle_mesh.hpp"
#include "tests/support/make_sphere_sets.hpp"

namespace ice::test {

/// A sphere of latitude bands, poles on z; symmetric about y = 0.
inline TriangleMesh make_globe(double radius, int bands) {
    TriangleMesh mesh;
    const int around = 2 * bands;
    mesh.vertices.emplace_back(0, 0, radius);
    for (int i = 1; i < bands; ++i)
        for (int j = 0; j < around; ++j) {
            const double a = std::numbers::pi * i / bands, b = 2 * std::numbers::pi * j / around;
            mesh.vertices.push_back(
                radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
        }
    mesh.vertices.emplace_back(0, 0, -radius);
    const auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
    const int south = static_cast<int>(mesh.vertices.size()) - 1;
    for (int j = 0; j < around; ++j) {
        mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (int i = 1; i + 1 < bands; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
        mesh.triangles.push_back({at(bands - 1, j), south, at(bands - 1, j + 1)});
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

/// A curved hull: parabolic waterlines and sections, L x B x T, flat deck at z = 0.1 T. Symmetric.
inline TriangleMesh make_wigley(double length, double breadth, double draught, int stations,
                                int levels) {
    TriangleMesh mesh;
    const auto half = [&](double x, double z) {
        const double along = 2 * x / length, down = z / draught;
        return 0.5 * breadth * (1 - along * along) * (1 - down * down);
    };
    // rows from the keel to the deck, starboard and port; stem, stern and keel are shared points
    std::vector<std::vector<std::int32_t>> port(static_cast<std::size_t>(levels) + 1),
        starboard = port;
    const auto add = [&](double x, double y, double z) {
        mesh.vertices.emplace_back(x, y, z);
        return static_cast<std::int32_t>(mesh.vertices.size()) - 1;
    };
    for (int k = 0; k <= levels; ++k)
        for (int i = 0; i <= stations; ++i) {
            const double x = length * (static_cast<double>(i) / stations - 0.5);
            const double z = -draught * (1.0 - static_cast<double>(k) / levels);
            const bool shared = i == 0 || i == stations || k == 0;
            const double y = shared ? 0.0 : half(x, z);
            const auto kk = static_cast<std::size_t>(k);
            port[kk].push_back(add(x, y, z));
            starboard[kk].push_back(shared ? port[kk].back() : add(x, -y, z));
        }
    const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}})
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(levels); ++k)
        for (std::size_t i = 0; i < static_cast<std::size_t>(stations); ++i) {
            const std::int32_t a = port[k][i], b = port[k + 1][i], c = port[k + 1][i + 1],
                               d = port[k][i + 1];
            const std::int32_t sb = starboard[k + 1][i], sc = starboard[k + 1][i + 1];
            const std::int32_t sa = starboard[k][i], sd = starboard[k][i + 1];
            // where keel and stern meet, three corners are shared: the other diagonal keeps both
            // sides' triangles apart
            if (k == 0 && i + 1 == static_cast<std::size_t>(stations)) {
                quad(b, c, d, a);
                quad(sd, sc, sb, sa);
            } else {
                quad(a, b, c, d);
                quad(sa, sd, sc, sb);
            }
        }
    const auto& p = port.back();
    const auto& s = starboard.back();
    for (std::size_t i = 0; i < static_cast<std::size_t>(stations); ++i)
        quad(p[i], s[i], s[i + 1], p[i + 1]);
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

/// Writes a mesh as OBJ, one group per region that is used.
inline void write_obj(const std::filesystem::path& file, const TriangleMesh& mesh) {
    std::ofstream out(file);
    out.precision(17);
    for (const Vec3& v : mesh.vertices)
        out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
        out << "g " << mesh.region_names[r] << '\n';
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (mesh.region[t] == static_cast<std::int32_t>(r))
                out << "f " << mesh.triangles[t][0] + 1 << ' ' << mesh.triangles[t][1] + 1 << ' '
                    << mesh.triangles[t][2] + 1 << '\n';
    }
}

}  // namespace ice::test
