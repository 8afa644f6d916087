// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/page.hpp"

#include <utility>

#include "common/base/error.hpp"
#include "common/base/version.hpp"
#include "postprocess/report/page_template.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;

namespace {

// a piece of the report's page that other pages share: its style, its buttons
std::string template_piece(const char* opening, const char* closing) {
    const std::string_view page = page_template();
    // an empty piece where the template has changed: the page then lacks its style, not its
    // content
    const auto begin = page.find(opening), end = page.find(closing, begin);
    return begin == std::string_view::npos || end == std::string_view::npos
               ? ""
               : std::string(page.substr(begin, end - begin)) + closing + "\n";
}

}  // namespace

std::string make_page(const PageParts& parts) {
    const std::string footer =
        "Made by icepost " + escape(version()) + " (" + escape(git_commit()) +
        "). Forces are those of the ice on the ship; x forward, y to port, z up. The viewer uses "
        "three.js and uPlot (MIT licence, in this page's source).";
    std::string page(page_template());
    // from the end to the beginning: a text that was filled in is not searched again
    const std::pair<const char*, std::string> fillings[] = {
        {"@DATA@", parts.arrays},        {"@META@", parts.meta},       {"@FOOTER@", footer},
        {"@BODY@", parts.body},          {"@SUMMARY@", parts.summary}, {"@HEADER@", parts.header},
        {"@TITLE@", escape(parts.title)}};
    std::size_t behind = page.size();
    for (const auto& [marker, text] : fillings) {
        const std::size_t at = page.rfind(marker, behind);
        if (at == std::string::npos)
            throw run_failed("report_template.html", std::string("has no marker ") + marker,
                             "this is a fault of the program: please report it");
        page.replace(at, std::string(marker).size(), text);
        behind = at;
    }
    return page;
}

std::string open_page(const std::string& title) {
    return "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
           "<meta charset=\"utf-8\" />\n<meta name=\"viewport\" content=\"width=device-width, "
           "initial-scale=1\" />\n<title>" +
           escape(title) + "</title>\n" + template_piece("<style>", "</style>") +
           "</head>\n<body>\n";
}

std::string close_page() {
    return "<footer><div class=\"inner\">Made by icepost " + escape(version()) + " (" +
           escape(git_commit()) + "). Forces are those of the ice on the ship.</div></footer>\n" +
           template_piece("<script id=\"tools\">", "</script>") + "</body>\n</html>\n";
}

std::string section(const std::string& id, const std::string& heading, const std::string& intro,
                    const std::string& body) {
    std::string out = "<section id=\"" + escape(id) + "\">\n<h2>" + escape(heading) + "</h2>\n";
    if (!intro.empty()) out += "<p>" + escape(intro) + "</p>\n";
    return out + body + "</section>\n";
}

std::string table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows) {
    // wide tables scroll inside their own box, not with the page
    std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string& cell : header) out += "<th scope=\"col\">" + escape(cell) + "</th>";
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : rows) {
        out += "<tr>";
        for (const std::string& cell : row) out += "<td>" + escape(cell) + "</td>";
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string out = "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
    for (const auto& [name, value] : rows)
        out += "<tr><td>" + escape(name) + "</td><td>" + escape(value) + "</td></tr>\n";
    return out + "</tbody></table></div>\n";
}

std::string chart_holder(const std::string& id, const std::string& svg) {
    return "<div data-chart=\"" + escape(id) + "\">" + svg + "</div>";
}

std::string figures(const std::vector<std::string>& svgs) {
    std::string out = "<div class=\"figures\">\n";
    for (const std::string& svg : svgs) out += "<div>" + svg + "</div>\n";
    return out + "</div>\n";
}

}  // namespace ice::report
