// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "preprocess/field/make_field.hpp"

namespace ice {

namespace {

constexpr double kLongSide = 1600.0;  // pixels of the longer side

}  // namespace

std::string field_svg(const FieldPlan& plan) {
    Rectangle box = plan.area;
    for (const auto* floes : {&plan.loose, &plan.fixed})
        for (const Outline& floe : *floes)
            for (const Vec2& corner : floe) box.extend(corner);
    const Vec2 size = box.sizes();
    const double scale = kLongSide / size.maxCoeff();
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#20466b\"/>\n",
        scale * size.x(), scale * size.y());
    const auto draw = [&](const std::vector<Outline>& floes, const char* fill) {
        out += fmt::format("<g fill=\"{}\" stroke=\"#54738f\" stroke-width=\"0.5\">\n", fill);
        for (const Outline& floe : floes) {
            out += "<path d=\"";
            // y to port is up in the picture
            for (std::size_t k = 0; k < floe.size(); ++k)
                out += fmt::format("{}{:.2f} {:.2f}", k == 0 ? "M" : "L",
                                   scale * (floe[k].x() - box.min().x()),
                                   scale * (box.max().y() - floe[k].y()));
            out += "Z\"/>\n";
        }
        out += "</g>\n";
    };
    draw(plan.loose, "#eef4f8");
    draw(plan.fixed, "#a9bccb");
    return out + "</svg>\n";
}

}  // namespace ice
