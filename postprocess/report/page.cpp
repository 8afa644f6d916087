// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/page.hpp"

#include "common/base/version.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; color: #1d2730; background: #fff;
       font: 16px/1.5 system-ui, 'Segoe UI', Helvetica, Arial, sans-serif; }
header { background: #0b3c5d; color: #fff; padding: 1.4rem 0 1.2rem; }
header h1 { margin: 0 0 .3rem; font-size: 1.6rem; line-height: 1.25; }
header p { margin: .2rem 0 0; color: #dce8f0; }
main, .inner { max-width: 1200px; margin: 0 auto; padding: 0 1rem; }
section { margin: 2rem 0; }
h2 { font-size: 1.2rem; margin: 0 0 .4rem; padding-bottom: .25rem;
     border-bottom: 2px solid #0b3c5d; }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem; }
section > p { margin: .3rem 0 .8rem; color: #45535f; max-width: 60rem; }
.status { display: inline-block; padding: .05rem .6rem; border-radius: 1rem; font-weight: 600;
          font-size: .9rem; background: #d7f0e3; color: #0b5135; }
.status.bad { background: #fde3d3; color: #7a2e00; }
.cards { display: grid; gap: .8rem; margin: 1.4rem 0 0;
         grid-template-columns: repeat(auto-fit, minmax(10.5rem, 1fr)); }
.card { border: 1px solid #cfd8df; border-radius: .4rem; padding: .6rem .8rem; }
.card b { display: block; font-size: 1.35rem; line-height: 1.3; color: #0b3c5d; }
.card span { font-size: .85rem; color: #45535f; }
.warnings { border-left: .3rem solid #d55e00; background: #fff5ee; padding: .6rem 1rem; }
.warnings ul { margin: .2rem 0; padding-left: 1.2rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; min-width: 24rem; }
th, td { padding: .3rem .7rem; border-bottom: 1px solid #dde3e8; text-align: right;
         white-space: nowrap; }
th { color: #45535f; font-weight: 600; font-size: .9rem; }
th:first-child, td:first-child { text-align: left; }
table.facts td { text-align: left; white-space: normal; vertical-align: top;
                 overflow-wrap: anywhere; }
table.facts td:first-child { white-space: nowrap; color: #45535f; }
.figures { display: grid; gap: .8rem; align-items: start;
           grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)); }
.figures svg { width: 100%; height: auto; max-width: 46rem; }
.opening svg { width: 100%; height: auto; max-width: 66rem; }
.legend { overflow-x: auto; }
.legend svg { width: auto; }
details { margin: .6rem 0; }
summary { cursor: pointer; font-weight: 600; }
pre { background: #f4f7f9; padding: .8rem; overflow-x: auto; font-size: .85rem; line-height: 1.4; }
footer { border-top: 1px solid #cfd8df; margin-top: 2rem; padding: 1rem 0 2rem; color: #5b6a76;
         font-size: .85rem; }
@media print { section { break-inside: avoid; } header { print-color-adjust: exact; } }
)";

}  // namespace

std::string make_page(const std::string& title, const std::string& body) {
    std::string out =
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
        "<meta charset=\"utf-8\" />\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>";
    out += escape(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body;
    out += "<footer><div class=\"inner\">Made by icepost " + escape(version()) + " (" +
           escape(git_commit()) +
           "). Forces are those of the ice on the ship; x forward, y to port, "
           "z up.</div></footer>\n</body>\n</html>\n";
    return out;
}

std::string section(const std::string& id, const std::string& heading, const std::string& intro,
                    const std::string& body) {
    std::string out = "<section id=\"" + escape(id) + "\">\n<h2>" + escape(heading) + "</h2>\n";
    if (!intro.empty()) out += "<p>" + escape(intro) + "</p>\n";
    return out + body + "</section>\n";
}

std::string table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows) {
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

std::string figures(const std::vector<std::string>& svgs) {
    std::string out = "<div class=\"figures\">\n";
    for (const std::string& svg : svgs) out += "<div>" + svg + "</div>\n";
    return out + "</div>\n";
}

}  // namespace ice::report
