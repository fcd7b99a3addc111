// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_output.hpp"
#include "sim/page/page.hpp"

namespace degs::sim {
namespace {

constexpr const char* kMotionStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#1a1a1a;background:#fff;max-width:52rem;"
    "margin:1.5rem auto;padding:0 1rem}svg{width:100%;height:auto}table{border-collapse:collapse;"
    "margin:.8rem 0}.wide{overflow-x:auto}th,td{padding:.25rem .7rem;text-align:right;"
    "border-bottom:1px solid #ddd;white-space:nowrap}th:first-child,td:first-child{text-align:left}"
    "h1{font-size:1.4rem}h2{font-size:1.1rem}";

std::string row(const char* cell, const std::vector<std::string>& cells) {
    std::string html = "<tr>";
    for (const std::string& words : cells) {
        html += std::string("<") + cell + ">" + html_escaped(words) + "</" + cell + ">";
    }
    return html + "</tr>\n";
}

std::string html_of(const MotionTable& table) {
    std::string html =
        "<div class=\"wide\"><table><thead>" + row("th", table.headings) + "</thead><tbody>\n";
    for (const std::vector<std::string>& cells : table.rows) {
        html += row("td", cells);
    }
    return html + "</tbody></table></div>\n";
}

} // namespace

std::string motion_page(const MotionWords& words, const Motion& motion) {
    const std::string title = "Head motion · " + words.scene + " · " + size_words(words) +
                              (words.estimated ? " (estimates)" : "");
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
           "name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
           html_escaped(title) + "</title><style>" + kMotionStyle + "</style></head><body>\n<h1>" +
           html_escaped(title) + "</h1>\n" + motion_latency_svg(words, motion) +
           html_of(latency_table(motion)) + motion_refresh_svg(words, motion) +
           html_of(display_table(motion)) + "</body></html>\n";
}

} // namespace degs::sim
