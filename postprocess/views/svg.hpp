// SPDX-License-Identifier: GPL-3.0-or-later
/// Small pieces of SVG text.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ice::views {

using Vec2 = Eigen::Vector2d;

/// Text with &, <, >, " made safe for HTML and SVG; control characters and bytes that are no UTF-8
/// become '?'.
std::string escape(const std::string& text);

/// A coordinate in pixels with at most one decimal, "12.3", "-4", "0"; NaN gives "0".
std::string pixels(double value);

/// `d` of a path through points in pixels (relative steps of 0.1 px, so that it stays short).
/// @param closed adds the way back to the first point
/// Fewer than 2 points give "".
std::string path_data(const std::vector<Vec2>& points, bool closed);

/// A <text> element at a place [px]; `text` is escaped here. @param anchor start | middle | end;
/// @param more further attributes
std::string text_element(double x, double y, const std::string& text, const std::string& anchor,
                         const std::string& more = "");

/// Width of a text of 13 px in the widest of the fonts a browser may take [px]: never too small.
double text_width(const std::string& text);

/// A <line> element between two places [px]. @param more further attributes
std::string line_element(double x1, double y1, double x2, double y2, const std::string& more);

/// Opening <svg> of a size [px] with a viewBox, a title for screen readers and the common font.
std::string svg_open(double width, double height, const std::string& title);

/// A number for people: 4 significant digits, no exponent between 1e-4 and 1e7, no zeros at its
/// end, "n/a" for NaN, "inf" and "-inf".
std::string readable(double value);

/// Colour "#rrggbb" from base colour times brightness [-] in [0, 1.3], each channel cut at 255.
std::string shade(const Eigen::Vector3i& rgb, double brightness);

}  // namespace ice::views
