// SPDX-License-Identifier: Apache-2.0
// The results of degs soc, as JSON and as words.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "config/config_document.hpp"
#include "sim/report/report.hpp"
#include "sim/report/terminal.hpp"
#include "sim/soc/soc_study.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// The drawn views of the frame without load, the levels of an image one behind the other.
nlohmann::ordered_json views_json(const SocResult& result) {
    nlohmann::ordered_json views = nlohmann::ordered_json::array();
    std::size_t level = 0;
    for (const degs_drawn_view& view : result.points.front().frame.views) {
        level = views.empty() || views.back()["image"] != view.entry ? 0 : level + 1;
        views.push_back({{"image", view.entry},
                         {"scale", view.scale},
                         {"rectangle", view.shown},
                         {"width", view.width},
                         {"height", view.height},
                         {"finished_cycles", view.cycles},
                         {"fragments", view.fragments},
                         {"psnr_db", result.images[view.entry].psnr_db},
                         {"crc32", result.images[view.entry].crc32s[level]}});
    }
    return views;
}

/// "2 × 1280×720", and how many views draw them if they are others.
std::string frame_words(const SocRequest& request, const View& view, const SocResult& result) {
    const std::size_t images = std::max<std::size_t>(1, request.images.size());
    const std::size_t views = result.points.front().frame.views.size();
    return (images > 1 ? std::to_string(images) + " × " : "") + size_words(view.camera) +
           (views > images ? " in " + std::to_string(views) + " views" : "");
}

} // namespace

nlohmann::ordered_json soc_json(const SocRequest& request, const View& view,
                                const SocResult& result) {
    nlohmann::ordered_json json;
    json["schema"] = {{"name", "degs-soc"}, {"version", 1}};
    json["tool"] = tool_json();
    json["scene"] = {{"name", view.scene.name}, {"gaussians", view.scene.cloud.size()}};
    json["camera"] = camera_json(view.camera);
    json["config"] = resolved(request.config);
    json["memory"] = {{"name", request.memory.name},
                      {"peak_gb_per_s", request.memory.peak_gb_per_s()}};
    json["cpu"] = {
        {"cores", request.cores},
        {"pattern", request.pattern == CpuTraffic::Pattern::Stream ? "stream" : "random"},
        {"reads_per_write", request.reads_per_write}};
    json["display"] = {{"refresh_hz", request.refresh_hz},
                       {"rows", result.display.rows},
                       {"underruns", result.display.underruns}};
    json["psnr_db"] = result.psnr_db;
    if (result.points.front().frame.views.size() > 1) {
        json["views"] = views_json(result);
    }
    json["points"] = nlohmann::ordered_json::array();
    for (const SocPoint& p : result.points) {
        json["points"].push_back({{"offered_gb_per_s", p.offered_gb_per_s},
                                  {"cpu_gb_per_s", p.cpu_gb_per_s},
                                  {"display_gb_per_s", p.display_gb_per_s},
                                  {"display_rows", p.display_rows},
                                  {"late_rows", p.late_rows},
                                  {"accelerator_gb_per_s", p.accelerator_gb_per_s},
                                  {"latency_ns", p.frame.latency_ns},
                                  {"cycles", p.frame.cycles},
                                  {"bytes_read", p.frame.bytes_read},
                                  {"bytes_written", p.frame.bytes_written},
                                  {"fragments", p.frame.fragments},
                                  {"energy_nj", p.frame.energy_nj}});
    }
    json["warnings"] = view.scene.notes;
    for (const std::string& sentence : result.warnings) {
        json["warnings"].push_back(sentence);
    }
    json["host"] = {{"wall_s", result.wall_s}};
    return json;
}

std::string soc_words(const SocRequest& request, const View& view, const SocResult& result) {
    TextTable table({"CPU asks GB/s", "gets", "display", "late rows", "accelerator GB/s",
                     "frame ms", "slower"});
    const double alone = result.points.front().frame.latency_ns;
    for (const SocPoint& p : result.points) {
        table.add({decimal_text(p.offered_gb_per_s), three_digits(p.cpu_gb_per_s),
                   three_digits(p.display_gb_per_s), grouped(p.late_rows),
                   three_digits(p.accelerator_gb_per_s), three_digits(p.frame.latency_ns / 1e6),
                   three_digits(p.frame.latency_ns / alone) + "x"});
    }
    const std::string heading = request.config.accelerator().name + " · " + view.scene.name +
                                " · " + frame_words(request, view, result) + " · " +
                                request.memory.name + ", " +
                                three_decimals(request.memory.peak_gb_per_s()) + " GB/s · " +
                                std::to_string(request.cores) + " cores";
    return visible(heading) + "\n" + table.text() + "pixels  the same under every load · " +
           three_digits(result.psnr_db) + " dB against double precision, 8 bits per channel\n" +
           "display " + grouped(result.display.rows) + " rows, " +
           grouped(result.display.underruns) + " late · host " + three_digits(result.wall_s) +
           " s\n";
}

} // namespace degs::sim
