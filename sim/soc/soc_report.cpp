// SPDX-License-Identifier: Apache-2.0
// The results of degs soc, as JSON and as words.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/ratio.hpp"
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
    for (const degs_drawn_view& view : result.points.front().frames.front().views) {
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
    const std::size_t views = result.points.front().frames.front().views.size();
    return (images > 1 ? std::to_string(images) + " × " : "") + size_words(view.camera) +
           (views > images ? " in " + std::to_string(views) + " views" : "");
}

/// Mean of a counter over the frames of a point.
double mean_over(const SocPoint& point, std::uint64_t SocFrame::*counter) {
    std::uint64_t sum = 0;
    for (const SocFrame& frame : point.frames) {
        sum += frame.*counter;
    }
    return mean_of(static_cast<double>(sum), point.frames.size());
}

double longest_ns(const SocPoint& point) {
    double longest = 0;
    for (const SocFrame& frame : point.frames) {
        longest = std::max(longest, frame.latency_ns);
    }
    return longest;
}

/// The accelerators beside the measured one.
nlohmann::ordered_json others_json(const SocRequest& request) {
    nlohmann::ordered_json others = nlohmann::ordered_json::array();
    for (std::size_t i = 1; i < request.accelerators.size(); ++i) {
        const SocAccelerator& other = request.accelerators[i];
        others.push_back({{"name", other.config.accelerator().name},
                          {"qos", other.qos},
                          {"config", resolved(other.config)}});
    }
    return others;
}

nlohmann::ordered_json point_json(const SocRequest& request, const SocPoint& p) {
    nlohmann::ordered_json json{{"offered_gb_per_s", p.offered_gb_per_s},
                                {"cpu_gb_per_s", p.cpu_gb_per_s},
                                {"display_gb_per_s", p.display_gb_per_s},
                                {"display_rows", p.display_rows},
                                {"late_rows", p.late_rows},
                                {"accelerator_gb_per_s", p.accelerator_gb_per_s},
                                {"latency_ns", p.latency_ns()},
                                {"longest_latency_ns", longest_ns(p)},
                                {"late_frames", p.late_frames(request.deadline_ms)},
                                {"cycles", mean_over(p, &SocFrame::cycles)},
                                {"bytes_read", mean_over(p, &SocFrame::bytes_read)},
                                {"bytes_written", mean_over(p, &SocFrame::bytes_written)},
                                {"fragments", mean_over(p, &SocFrame::fragments)},
                                {"energy_nj", mean_over(p, &SocFrame::energy_nj)},
                                {"frames", nlohmann::ordered_json::array()}};
    for (const SocFrame& frame : p.frames) {
        json["frames"].push_back({{"latency_ns", frame.latency_ns}, {"cycles", frame.cycles}});
    }
    if (!p.others.empty()) {
        json["others_per_s"] = p.rate_per_s;
        json["others"] = nlohmann::ordered_json::array();
    }
    for (const SocPoint::Other& other : p.others) {
        const Competitor::Counts& counts = other.counts;
        json["others"].push_back({{"gb_per_s", other.gb_per_s},
                                  {"frames", counts.frames},
                                  {"late_frames", counts.late},
                                  {"latency_ns", mean_of(counts.latency_ns, counts.frames)}});
    }
    return json;
}

/// False if nobody asked for traffic of the cores, but for another accelerator.
bool shows_cores(const SocRequest& request) {
    return request.accelerators.size() == 1 ||
           std::any_of(request.loads.begin(), request.loads.end(),
                       [](double load) { return load > 0; });
}

/// Cells on the traffic of the cores.
std::vector<std::string> core_cells(const SocRequest& request, const SocPoint& p) {
    if (!shows_cores(request)) {
        return {"", ""};
    }
    return {decimal_text(p.offered_gb_per_s), three_digits(p.cpu_gb_per_s)};
}

/// Cells on the other accelerators together; empty if there are none.
std::vector<std::string> other_cells(const SocPoint& p) {
    if (p.others.empty()) {
        return {"", "", "", ""};
    }
    double gb_per_s = 0;
    Competitor::Counts counts;
    for (const SocPoint::Other& other : p.others) {
        gb_per_s += other.gb_per_s;
        counts.frames += other.counts.frames;
        counts.late += other.counts.late;
        counts.latency_ns += other.counts.latency_ns;
    }
    const double ms = mean_of(counts.latency_ns, counts.frames) / 1e6;
    return {decimal_text(p.rate_per_s), three_digits(gb_per_s),
            counts.frames == 0 ? "" : three_digits(ms),
            grouped(counts.late) + " of " + grouped(counts.frames)};
}

/// "degs-64 (QoS 12) beside gbu-64 (QoS 0)"
std::string names(const SocRequest& request) {
    const auto name = [&request](const SocAccelerator& accelerator) {
        const std::string& own = accelerator.config.accelerator().name;
        return request.accelerators.size() == 1 && accelerator.qos == 0
                   ? own
                   : own + " (QoS " + std::to_string(accelerator.qos) + ")";
    };
    std::string words = name(request.accelerators.front());
    for (std::size_t i = 1; i < request.accelerators.size(); ++i) {
        words += (i == 1 ? " beside " : ", ") + name(request.accelerators[i]);
    }
    return words;
}

} // namespace

nlohmann::ordered_json soc_json(const SocRequest& request, const View& view,
                                const SocResult& result) {
    nlohmann::ordered_json json;
    json["schema"] = {{"name", "degs-soc"}, {"version", 1}};
    json["tool"] = tool_json();
    json["scene"] = {{"name", view.scene.name}, {"gaussians", view.scene.cloud.size()}};
    json["camera"] = camera_json(view.camera);
    json["config"] = resolved(request.config());
    json["qos"] = request.accelerators.front().qos;
    json["others"] = others_json(request);
    json["deadline_ms"] = request.deadline_ms > 0 ? nlohmann::ordered_json(request.deadline_ms)
                                                  : nlohmann::ordered_json();
    json["memory"] = {{"name", request.memory.name},
                      {"peak_gb_per_s", request.memory.peak_gb_per_s()}};
    json["cpu"] = {
        {"cores", request.cores},
        {"pattern", request.pattern == CpuTraffic::Pattern::Stream ? "stream" : "random"},
        {"reads_per_write", request.reads_per_write},
        {"qos", request.cores_qos}};
    json["display"] = {{"refresh_hz", request.refresh_hz},
                       {"qos", request.display_qos},
                       {"rows", result.display.rows},
                       {"underruns", result.display.underruns}};
    json["psnr_db"] = result.psnr_db;
    if (result.points.front().frames.front().views.size() > 1) {
        json["views"] = views_json(result);
    }
    json["points"] = nlohmann::ordered_json::array();
    for (const SocPoint& p : result.points) {
        json["points"].push_back(point_json(request, p));
    }
    json["warnings"] = view.scene.notes;
    for (const std::string& sentence : result.warnings) {
        json["warnings"].push_back(sentence);
    }
    json["host"] = {{"wall_s", result.wall_s}};
    return json;
}

std::string soc_words(const SocRequest& request, const View& view, const SocResult& result) {
    TextTable table({"CPU asks GB/s", "gets", "others ask 1/s", "get GB/s", "take ms", "late",
                     "display", "late rows", "accelerator GB/s", "frame ms", "slower",
                     "late frames"});
    const double alone = result.points.front().latency_ns();
    const bool many = request.frames > 1 && request.deadline_ms > 0;
    for (const SocPoint& p : result.points) {
        std::vector<std::string> cells = core_cells(request, p);
        const std::vector<std::string> others = other_cells(p);
        cells.insert(cells.end(), others.begin(), others.end());
        const std::string late = grouped(p.late_frames(request.deadline_ms));
        const bool display = request.refresh_hz > 0;
        cells.insert(cells.end(),
                     {display ? three_digits(p.display_gb_per_s) : "",
                      display ? grouped(p.late_rows) : "", three_digits(p.accelerator_gb_per_s),
                      three_digits(p.latency_ns() / 1e6),
                      three_digits(p.latency_ns() / alone) + "x",
                      many ? late + " of " + grouped(p.frames.size()) : ""});
        table.add(cells);
    }
    const std::string heading =
        names(request) + " · " + view.scene.name + " · " + frame_words(request, view, result) +
        " · " + request.memory.name + ", " + three_decimals(request.memory.peak_gb_per_s()) +
        " GB/s" + (shows_cores(request) ? " · " + std::to_string(request.cores) + " cores" : "") +
        (many ? " · deadline " + three_digits(request.deadline_ms) + " ms" : "");
    return visible(heading) + "\n" + table.text() + "pixels  the same under every load · " +
           three_digits(result.psnr_db) + " dB against double precision, 8 bits per channel\n" +
           (request.refresh_hz > 0 ? "display " + grouped(result.display.rows) + " rows, " +
                                         grouped(result.display.underruns) + " late · "
                                   : "") +
           "host " + three_digits(result.wall_s) + " s\n";
}

} // namespace degs::sim
