// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Refuses a name that no picture can be written under. Is to be called before the work whose
/// picture it is.
/// @throws Error (exit code 2): a suffix other than .svg, .png, .pdf; .png or .pdf where
///         rsvg-convert (Debian: librsvg2-bin) is not installed
void check_picture_name(const std::filesystem::path& file);

/// Writes a picture in the format that the file's suffix names: SVG as it is, PNG with two pixels
/// per unit on white, and PDF by rsvg-convert.
/// @throws Error as check_picture_name(); exit code 1 when it cannot be written
void write_picture(const std::filesystem::path& file, const std::string& svg);

/// Refuses the name of a picture for a page (HTML), which would be written under it.
/// @throws Error (exit code 2)
void check_page_name(const std::filesystem::path& file);

}  // namespace ice
