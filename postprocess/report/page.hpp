// SPDX-License-Identifier: GPL-3.0-or-later
/// HTML pieces of the report. Every tag is closed, so the page is also valid XML.
#pragma once

#include <string>
#include <vector>

namespace ice::report {

/// The parts filled into the page that web/ builds; texts are HTML unless said otherwise.
struct PageParts {
    std::string title;         ///< plain text
    std::string header;        ///< above everything
    std::string summary;       ///< before the 3D playback
    std::string body;          ///< behind it
    std::string meta, arrays;  ///< of the viewer (viewer_data.hpp)
};

/// The whole page: one file that loads nothing from elsewhere. Without script it keeps all its
/// tables and drawings.
std::string make_page(const PageParts& parts);

/// Beginning of another page up to <body>, in the style of the report. @param title plain text
std::string open_page(const std::string& title);

/// Its end from </main> on: origin, and the script of the buttons that save charts and tables.
std::string close_page();

/// <section> with a heading. @param id for links, unique on the page; @param intro plain text, may
/// be empty; @param body HTML
std::string section(const std::string& id, const std::string& heading, const std::string& intro,
                    const std::string& body);

/// A table; the first column holds names, the others numbers (right-aligned). Cells are plain text.
std::string table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows);

/// Two columns of names and values, plain text; no rows give an empty table.
std::string facts(const std::vector<std::pair<std::string, std::string>>& rows);

/// A drawing that the page's script replaces by its chart of the same id.
std::string chart_holder(const std::string& id, const std::string& svg);

/// Pictures side by side where the window is wide enough, else below each other.
std::string figures(const std::vector<std::string>& svgs);

}  // namespace ice::report
