// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ice::views {

namespace {

// length of the UTF-8 sequence that begins at text[k], or 0 where it is none
std::size_t utf8_length(const std::string& text, std::size_t k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const std::size_t length = byte < 0x80                   ? 1
                               : byte >= 0xc2 && byte < 0xe0 ? 2
                               : byte >= 0xe0 && byte < 0xf0 ? 3
                               : byte >= 0xf0 && byte < 0xf5 ? 4
                                                             : 0;
    if (length == 0 || k + length > text.size()) return 0;
    for (std::size_t j = 1; j < length; ++j)
        if ((static_cast<unsigned char>(text[k + j]) & 0xc0) != 0x80) return 0;
    return length;
}

// tenths of a pixel as text: 123 -> "12.3", 120 -> "12"
std::string tenths(long value) {
    if (value % 10 == 0) return std::to_string(value / 10);
    const long size = std::labs(value);
    std::string text = value < 0 ? "-" : "";
    if (size >= 10) text += std::to_string(size / 10);
    return text + "." + std::to_string(size % 10);
}

long to_tenths(double value) {
    if (!std::isfinite(value)) return 0;
    // Tenths of a pixel: finer numbers only make files longer. A million pixels either way is
    // beyond any page, and keeps the number within a long.
    return std::lround(std::clamp(value, -1e6, 1e6) * 10.0);
}

}  // namespace

// Names come from case files and may hold any byte. XML 1.0 has no control characters, and one
// broken UTF-8 sequence makes a browser refuse the whole picture: both become question marks.
std::string escape(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t length = utf8_length(text, k);
        const char c = text[k];
        const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
        if (length == 0 || control)
            out += '?';
        else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += text.substr(k, length);
        // a broken sequence costs one byte, so that the text after it stays
        k += std::max<std::size_t>(1, length);
    }
    return out;
}

std::string pixels(double value) { return tenths(to_tenths(value)); }

std::string path_data(const std::vector<Vec2>& points, bool closed) {
    if (points.size() < 2) return "";
    // steps between rounded points, so that rounding does not add up along the path
    long x = to_tenths(points[0].x()), y = to_tenths(points[0].y());
    std::string out = "M" + tenths(x) + " " + tenths(y) + "l";
    bool first = true;
    for (std::size_t k = 1; k < points.size(); ++k) {
        const long next_x = to_tenths(points[k].x()), next_y = to_tenths(points[k].y());
        const std::string dx = tenths(next_x - x), dy = tenths(next_y - y);
        // a minus sign separates numbers by itself
        if (!first && dx[0] != '-') out += ' ';
        out += dx;
        if (dy[0] != '-') out += ' ';
        out += dy;
        x = next_x;
        y = next_y;
        first = false;
    }
    return closed ? out + "z" : out;
}

std::string text_element(double x, double y, const std::string& text, const std::string& anchor,
                         const std::string& more) {
    return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n", pixels(x),
                       pixels(y), anchor, more.empty() ? "" : " ", more, escape(text));
}

double text_width(const std::string& text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // bytes that go on are none
    });
    // 8 px per letter at 13 px: wide rather than narrow, since the browser's font is not known and
    // labels must not collide
    return 8.0 * static_cast<double>(letters);
}

std::string line_element(double x1, double y1, double x2, double y2, const std::string& more) {
    return fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", pixels(x1),
                       pixels(y1), pixels(x2), pixels(y2), more);
}

std::string svg_open(double width, double height, const std::string& title) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" role=\"img\" font-family=\"system-ui,'Segoe UI',Helvetica,Arial,"
        "sans-serif\" font-size=\"13\" fill=\"#222\">\n<title>{2}</title>\n",
        pixels(width), pixels(height), escape(title));
}

std::string readable(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "n/a" : value > 0 ? "inf" : "-inf";
    const double size = std::abs(value);
    if (size == 0.0) return "0";
    if (size < 1e-4 || size >= 1e7) return fmt::format("{:.3e}", value);
    // digits before the point: four digits in all, and zeros at the end are cut
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    std::string text = fmt::format("{:.{}f}", value, std::clamp(4 - before, 0, 7));
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text;
}

std::string shade(const Eigen::Vector3i& rgb, double brightness) {
    const auto channel = [&](int k) {
        return std::clamp(static_cast<int>(std::lround(rgb[k] * brightness)), 0, 255);
    };
    return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

}  // namespace ice::views
