// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_csv.hpp"

#include <fmt/compile.h>

namespace ice {

namespace {

std::string quoted(const std::string& name) {
    // as spreadsheets read it: a name with a comma or a quote in quotes, quotes in it doubled
    if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
    std::string out = "\"";
    for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace

void write_csv(const SphereSet& set, const Sink& sink) {
    std::vector<std::string> names;
    for (const std::string& name : set.mesh.region_names) names.push_back(quoted(name));
    sink("x_m,y_m,z_m,radius_m,nx,ny,nz,layer,region\n");
    write_rows(sink, set.size(), [&](fmt::memory_buffer& out, std::size_t k) {
        const Vec3& c = set.centers[k];
        const Vec3 n = set.normal(k);
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{},{},{},{},{},{},{},{},{}\n"), c.x(),
                       c.y(), c.z(), set.radii[k], n.x(), n.y(), n.z(), set.on_surface(k) ? 1 : 0,
                       names[static_cast<std::size_t>(set.region(k))]);
    });
}

}  // namespace ice
