// SPDX-License-Identifier: GPL-3.0-or-later
// The field from above as a drawing: floes and unbroken ice on water, axes in metres, and a key to
// the colours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "preprocess/field/make_field.hpp"

namespace ice {

namespace {

constexpr double kLongSide = 1600.0;  // [px] of the longer side of the field
constexpr double kLeft = 90.0, kRight = 30.0, kTop = 60.0, kBottom = 130.0;  // margins [px]
constexpr int kTicks = 14;  // count, about, along the longer side

// The field's rectangle on the page: x to the right, y to port up.
struct Page {
    Rectangle box;
    double scale;  // [px/m]
    double x(double metres) const { return kLeft + scale * (metres - box.min().x()); }
    double y(double metres) const { return kTop + scale * (box.max().y() - metres); }
    double right() const { return x(box.max().x()); }
    double bottom() const { return y(box.min().y()); }
};

// 1, 2 or 5 times a power of ten, at or above `raw`
double round_step(double raw) {
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

std::string svg_text(double x, double y, const char* anchor, const std::string& words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
                       anchor, words);
}

std::string draw_axes(const Page& page, double step) {
    std::string out = fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#222\"/>\n",
        kLeft, kTop, page.right() - kLeft, page.bottom() - kTop);
    const auto tick = [](double x1, double y1, double x2, double y2) {
        return fmt::format(
            "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#222\"/>\n", x1,
            y1, x2, y2);
    };
    const auto ticks = [&](double low, double high, const auto& draw) {
        // ticks are whole multiples of the step; + 0.0 turns -0 into 0
        for (double k = std::ceil(low / step - 1e-6); k <= high / step + 1e-6; k += 1.0)
            out += draw(k * step + 0.0, fmt::format("{:g}", k * step + 0.0));
    };
    ticks(page.box.min().x(), page.box.max().x(), [&](double v, const std::string& label) {
        return tick(page.x(v), page.bottom(), page.x(v), page.bottom() + 6.0) +
               svg_text(page.x(v), page.bottom() + 26.0, "middle", label);
    });
    ticks(page.box.min().y(), page.box.max().y(), [&](double v, const std::string& label) {
        return tick(kLeft - 6.0, page.y(v), kLeft, page.y(v)) +
               svg_text(kLeft - 10.0, page.y(v) + 6.0, "end", label);
    });
    const double middle = 0.5 * (kTop + page.bottom());
    out += svg_text(0.5 * (kLeft + page.right()), page.bottom() + 52.0, "middle",
                    "x [m], the ship's way \u2192");
    return out + fmt::format(
                     "<text x=\"24\" y=\"{0:.1f}\" text-anchor=\"middle\" "
                     "transform=\"rotate(-90 24 {0:.1f})\">y [m], to port</text>\n",
                     middle);
}

// the key to the colours, and a bar as long as a step between ticks
std::string draw_key(const Page& page, const FieldPlan& plan, double step) {
    const double y = page.bottom() + 90.0;
    double x = kLeft;
    std::string out;
    const auto add = [&](const char* fill, const std::string& words) {
        out += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"28\" height=\"18\" fill=\"{}\" "
            "stroke=\"#54738f\"/>\n",
            x, y - 14.0, fill);
        out += svg_text(x + 38.0, y, "start", words);
        // 11 px per letter at this size, wide rather than narrow: the browser's font is not known
        x += 60.0 + 11.0 * static_cast<double>(words.size());
    };
    add("#eef4f8", fmt::format("{} loose floes", plan.loose.size()));
    if (!plan.fixed.empty()) add("#a9bccb", "unbroken ice");
    add("#20466b", "open water");
    out += fmt::format(
        "<polyline points=\"{0:.1f},{1:.1f} {0:.1f},{2:.1f} {3:.1f},{2:.1f} {3:.1f},{1:.1f}\" "
        "fill=\"none\" "
        "stroke=\"#222\" stroke-width=\"2\"/>\n",
        x, y - 12.0, y - 2.0, x + page.scale * step);
    return out + svg_text(x + page.scale * step + 10.0, y, "start", fmt::format("{:g} m", step));
}

}  // namespace

std::string field_svg(const FieldPlan& plan) {
    // the page shows all ice, also edges beyond the field's area
    Rectangle box = plan.area;
    for (const auto* floes : {&plan.loose, &plan.fixed})
        for (const Outline& floe : *floes)
            for (const Vec2& corner : floe) box.extend(corner);
    const Vec2 size = box.sizes();
    const Page page{box, kLongSide / size.maxCoeff()};
    const double step = round_step(size.maxCoeff() / kTicks);
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"system-ui,'Segoe UI',Helvetica,Arial,"
        "sans-serif\" font-size=\"20\" fill=\"#222\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        std::max(page.right() + kRight, 900.0), page.bottom() + kBottom);
    out +=
        svg_text(kLeft, 36.0, "start",
                 fmt::format("Ice field from above, {:.4g} m \u00d7 {:.4g} m", size.x(), size.y()));
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#20466b\"/>\n",
        kLeft, kTop, page.right() - kLeft, page.bottom() - kTop);
    const auto draw = [&](const std::vector<Outline>& floes, const char* fill) {
        out += fmt::format("<g fill=\"{}\" stroke=\"#54738f\" stroke-width=\"0.5\">\n", fill);
        for (const Outline& floe : floes) {
            out += "<path d=\"";
            for (std::size_t k = 0; k < floe.size(); ++k)
                out += fmt::format("{}{:.2f} {:.2f}", k == 0 ? "M" : "L", page.x(floe[k].x()),
                                   page.y(floe[k].y()));
            out += "Z\"/>\n";
        }
        out += "</g>\n";
    };
    // loose floes light, unbroken ice darker
    draw(plan.loose, "#eef4f8");
    draw(plan.fixed, "#a9bccb");
    return out + draw_axes(page, step) + draw_key(page, plan, step) + "</svg>\n";
}

}  // namespace ice
