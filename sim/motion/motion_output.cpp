// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_output.hpp"

#include <nlohmann/json.hpp>

#include "sim/report/report.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

nlohmann::ordered_json display_json(const DisplayResult& display) {
    return {{"hz", display.hz},
            {"frames", display.frames},
            {"missed", display.missed},
            {"refreshes", display.refreshes},
            {"repeated", display.repeated},
            {"motion_to_photon_mean_ms", display.photon_mean_ms},
            {"motion_to_photon_p95_ms", display.photon_p95_ms},
            {"motion_to_photon_worst_ms", display.photon_worst_ms}};
}

nlohmann::ordered_json design_json(const DesignMotion& design) {
    nlohmann::ordered_json json{{"name", design.name}, {"latency_ms", nullptr}};
    if (design.ranks) {
        const LatencyRanks& ranks = *design.ranks;
        json["latency_ms"] = {{"p50", ranks.p50},
                              {"p95", ranks.p95},
                              {"p99", ranks.p99},
                              {"worst", ranks.worst},
                              {"worst_frame", ranks.worst_frame}};
    }
    if (const std::optional<double> bytes = mean_of_frames(design.bytes)) {
        json["bytes_per_frame"] = *bytes;
    }
    json["displays"] = nlohmann::ordered_json::array();
    for (const DisplayResult& display : design.displays) {
        json["displays"].push_back(display_json(display));
    }
    return json;
}

std::string text_of(const MotionTable& table) {
    TextTable text(table.headings);
    for (const std::vector<std::string>& row : table.rows) {
        text.add(row);
    }
    return text.text();
}

} // namespace

std::string size_words(const MotionWords& words) {
    return (words.eyes_m ? "2 × " : "") + words.size;
}

nlohmann::ordered_json motion_json(const MotionWords& words, const Motion& motion) {
    nlohmann::ordered_json json;
    json["schema"] = {{"name", "degs-motion"}, {"version", 1}};
    json["tool"] = tool_json();
    json["scene"] = words.scene;
    json["size"] = words.size;
    if (words.eyes_m) {
        json["eyes_m"] = *words.eyes_m;
    }
    json["fidelity"] = words.estimated ? "analytic" : "exact";
    json["frames"] = motion.times_s.size();
    json["designs"] = nlohmann::ordered_json::array();
    for (const DesignMotion& design : motion.designs) {
        json["designs"].push_back(design_json(design));
    }
    return json;
}

std::string motion_csv(const Motion& motion) {
    std::string text = "frame,time_s";
    for (const DesignMotion& design : motion.designs) {
        text += "," + design.name + ".latency_ms";
    }
    text += "\n";
    for (std::size_t frame = 0; frame < motion.times_s.size(); ++frame) {
        text += std::to_string(frame) + "," + decimal_of(motion.times_s[frame]);
        for (const DesignMotion& design : motion.designs) {
            text += "," + (design.ms[frame] ? decimal_of(*design.ms[frame]) : "");
        }
        text += "\n";
    }
    return text;
}

MotionTable latency_table(const Motion& motion) {
    MotionTable table{{"latency, ms", "P50", "P95", "P99", "worst", "in frame", "MB per frame"},
                      {}};
    for (const DesignMotion& design : motion.designs) {
        if (design.ranks) {
            const LatencyRanks& ranks = *design.ranks;
            const std::optional<double> bytes = mean_of_frames(design.bytes);
            table.rows.push_back({design.name, three_digits(ranks.p50), three_digits(ranks.p95),
                                  three_digits(ranks.p99), three_digits(ranks.worst),
                                  std::to_string(ranks.worst_frame),
                                  bytes ? three_digits(*bytes * 1e-6) : ""});
        }
    }
    return table;
}

MotionTable display_table(const Motion& motion) {
    MotionTable table{
        {"display", "design", "in time", "new images", "motion to photon, ms", "P95", "worst"}, {}};
    for (std::size_t rate = 0; rate < motion.rates_hz.size(); ++rate) {
        for (const DesignMotion& design : motion.designs) {
            if (!design.displays.empty()) {
                const DisplayResult& display = design.displays[rate];
                table.rows.push_back(
                    {decimal_text(display.hz) + " Hz", design.name,
                     std::to_string(display.frames - display.missed) + " of " +
                         std::to_string(display.frames),
                     percent(display.new_images()) + " %", three_digits(display.photon_mean_ms),
                     three_digits(display.photon_p95_ms), three_digits(display.photon_worst_ms)});
            }
        }
    }
    return table;
}

std::string motion_text(const MotionWords& words, const Motion& motion) {
    return words.scene + " · " + size_words(words) + " · " + std::to_string(motion.times_s.size()) +
           (motion.times_s.size() == 1 ? " frame" : " frames") +
           (words.estimated ? " · estimated" : "") + "\n" + text_of(latency_table(motion)) + "\n" +
           text_of(display_table(motion));
}

} // namespace degs::sim
