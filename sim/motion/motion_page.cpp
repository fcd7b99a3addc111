// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_output.hpp"
#include "sim/page/page.hpp"
#include "sim/text/words.hpp"

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

std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows) {
    std::string html = "<div class=\"wide\"><table><thead>" + row("th", head) + "</thead><tbody>\n";
    for (const auto& cells : rows) {
        html += row("td", cells);
    }
    return html + "</tbody></table></div>\n";
}

std::string latencies(const Motion& motion) {
    std::vector<std::vector<std::string>> rows;
    for (const DesignMotion& design : motion.designs) {
        if (design.ranks) {
            const LatencyRanks& ranks = *design.ranks;
            rows.push_back({design.name, three_digits(ranks.p50), three_digits(ranks.p95),
                            three_digits(ranks.p99), three_digits(ranks.worst),
                            std::to_string(ranks.worst_frame)});
        }
    }
    return table({"design", "half of the frames, ms", "95 %", "99 %", "all", "slowest frame"},
                 rows);
}

std::string displays(const Motion& motion) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t rate = 0; rate < motion.rates_hz.size(); ++rate) {
        for (const DesignMotion& design : motion.designs) {
            if (!design.displays.empty()) {
                const DisplayResult& display = design.displays[rate];
                rows.push_back(
                    {decimal_text(display.hz) + " Hz", design.name,
                     std::to_string(display.missed) + " of " + std::to_string(display.frames),
                     std::to_string(display.repeated) + " of " + std::to_string(display.refreshes),
                     three_digits(display.photon_mean_ms), three_digits(display.photon_worst_ms)});
            }
        }
    }
    return table({"display", "design", "frames too late", "refreshes without a new image",
                  "motion to photon, ms", "at worst"},
                 rows);
}

} // namespace

std::string motion_page(const MotionWords& words, const Motion& motion) {
    const std::string title = "Head motion · " + words.scene + " · " + words.size +
                              (words.estimated ? " (estimates)" : "");
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
           "name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
           html_escaped(title) + "</title><style>" + kMotionStyle + "</style></head><body>\n<h1>" +
           html_escaped(title) + "</h1>\n" + motion_latency_svg(words, motion) + latencies(motion) +
           motion_refresh_svg(words, motion) + displays(motion) + "</body></html>\n";
}

} // namespace degs::sim
