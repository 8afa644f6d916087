// SPDX-License-Identifier: GPL-3.0-or-later
/// HTML pieces of the report. Every tag is closed, so the page is also valid XML.
#pragma once

#include <string>
#include <vector>

namespace ice::report {

/// The whole page: one file, no script, nothing loaded from elsewhere.
/// @param title plain text; @param body HTML
std::string make_page(const std::string& title, const std::string& body);

/// <section> with a heading. @param id for links; @param intro plain text, may be empty
std::string section(const std::string& id, const std::string& heading, const std::string& intro,
                    const std::string& body);

/// A table; the first column holds names, the others numbers (right-aligned). Cells are plain text.
std::string table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows);

/// Two columns of names and values.
std::string facts(const std::vector<std::pair<std::string, std::string>>& rows);

/// Pictures side by side where the window is wide enough, else below each other.
std::string figures(const std::vector<std::string>& svgs);

}  // namespace ice::report
