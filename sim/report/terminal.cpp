// SPDX-License-Identifier: Apache-2.0
#include "sim/report/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/ratio.hpp"
#include "base/visible_text.hpp"
#include "config/config_words.hpp"
#include "modules/kit/accelerator/waiting_causes.hpp"
#include "sim/report/foveation_words.hpp"
#include "sim/report/losses.hpp"
#include "sim/report/view_words.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

constexpr const char* kDot = " · ";

/// Enough digits to show its distance from 1: 0.99999873 -> "0.9999987".
std::string similarity(double ssim) {
    if (std::isnan(ssim)) {
        return "nan"; // without the sign that printf gives some of them
    }
    const double gap = std::abs(1.0 - ssim);
    const int decimals = gap > 0 ? static_cast<int>(2 - std::floor(std::log10(gap))) : 3;
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", std::clamp(decimals, 3, 6), ssim);
    return text;
}

std::string scene_line(const RunResult& result) {
    const auto& first = result.workload.reference;
    // The first view of a foveated frame is not a whole image.
    const bool reference = first && !result.foveation;
    const std::uint64_t fragments = reference ? first->fragments : result.accelerator.fragments();
    // The reference shows the first frame, and the accelerator counts those of all frames.
    const AcceleratorResult& run = result.accelerator;
    const std::size_t frames = reference           ? 1
                               : run.views.empty() ? run.frames.size()
                                                   : run.views.size();
    const std::uint64_t pixels = result.foveation
                                     ? drawn_pixels(result) * run.frames.size()
                                     : result.camera.pixels() * std::max<std::size_t>(frames, 1);
    const std::uint64_t visible = result.workload.visible; // in the first frame alone
    return scene_words(result.scene) + kDot + grouped(visible) + " visible" +
           (result.foveation ? " in the fovea" : "") + kDot + scaled(fragments) + " fragments " +
           (frames > 1
                ? "in " + std::to_string(frames) + (run.views.empty() ? " frames " : " views ")
                : "") +
           "(" + three_digits(ratio_of(fragments, pixels)) + " per pixel" +
           (frames <= 1 && visible > 0
                ? ", " + three_digits(ratio_of(fragments, visible)) + " per visible splat"
                : "") +
           ")";
}

std::string design_line(const RunResult& result) {
    const AcceleratorResult& run = result.accelerator;
    const cost::BillOfMaterials bill = result.config.accelerator().bill();
    return run.name + kDot + std::to_string(run.pes) + " PEs" + kDot +
           three_digits(ratio_of(bill.sram_bytes(), 1024)) + " KB of SRAM" + kDot +
           three_digits(bill.area_mm2()) + " mm²";
}

std::string frame_line(const RunResult& result) {
    const AcceleratorResult& run = result.accelerator;
    const Cycle latency = run.frames.empty() ? 0 : run.frames.front().finished;
    const double ms = rate_of(latency, run.clock_ghz) * 1e-6;
    const std::optional<double> steady = steady_fps(run);
    const std::size_t images = images_of(result);
    return (images > 1 ? std::to_string(images) + " × " : "") + size_words(result.camera) + kDot +
           three_digits(ms) + " ms" + kDot + (ms > 0 ? three_digits(1e3 / ms) : "-") + " fps" +
           kDot +
           (steady ? three_digits(*steady) + " fps over " + std::to_string(run.frames.size()) +
                         " frames" + kDot
                   : "") +
           "blending " + scaled(run.window.cycles()) + " of " + scaled(run.cycles) + " cycles at " +
           config_words::number(run.clock_ghz) + " GHz";
}

std::string slots_line(const AcceleratorResult& run) {
    const SlotAccount& s = run.slots;
    const std::uint64_t total = s.total();
    if (total == 0) {
        return "none, there was nothing to blend";
    }
    std::string line;
    for (const SlotClass& slot : kSlotClasses) {
        if (s[slot.slot] == 0 && !line.empty()) {
            continue; // what did not occur is not worth its room
        }
        line += (line.empty() ? "" : "  ") + std::string(slot.name) + " " +
                percent(ratio_of(s[slot.slot], total)) + (line.empty() ? " %" : "");
    }
    return line + (run.hazards == 0 ? "" : "  HAZARDS " + grouped(run.hazards));
}

std::string stages_line(const AcceleratorResult& run) {
    std::string line;
    for (const StageUse& stage : run.stages) {
        line += (line.empty() ? "" : kDot) + stage.name + " " + percent(stage.busy, 0) + " %";
    }
    return line + "   limited by: " + limiting_stage(run);
}

std::string memory_line(const AcceleratorResult& run) {
    std::uint64_t read = 0;
    std::uint64_t written = 0;
    for (const StreamUse& stream : run.streams) {
        read += stream.bytes_read;
        written += stream.bytes_written;
    }
    if (run.memory_gb_per_s <= 0) {
        return "unlimited: the array alone";
    }
    return scaled_bytes(read) + " read, " + scaled_bytes(written) + " written" + kDot +
           percent(run.memory_utilization, 0) + " % of " + three_decimals(run.memory_gb_per_s) +
           " GB/s" +
           (run.row_hit_rate ? kDot + ("row hits " + percent(*run.row_hit_rate, 0) + " %") : "");
}

/// Bytes of cells that were never filled, in all rings of the buffer.
std::uint64_t unused_bytes(const BufferUse& buffer) {
    return buffer.depth == 0 || buffer.bytes <= 0
               ? 0
               : static_cast<std::uint64_t>(buffer.bytes) * (buffer.depth - buffer.high_water) /
                     buffer.depth;
}

/// "; never filled: 28.3 KB of packing_buffer", the most first; empty if all cells were filled.
std::string unused_words(const AcceleratorResult& run) {
    std::vector<std::pair<std::uint64_t, std::string>> unused;
    for (const BufferUse& buffer : run.buffers) {
        if (const std::uint64_t bytes = unused_bytes(buffer); bytes > 0) {
            unused.emplace_back(bytes, buffer.name);
        }
    }
    std::stable_sort(unused.begin(), unused.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string words;
    for (const auto& [bytes, name] : unused) {
        words += (words.empty() ? "; never filled: " : ", ") + three_digits(ratio_of(bytes, 1024)) +
                 " KB of " + name;
    }
    return words;
}

/// The buffers that came nearest to their capacity, and what of all was never filled; empty if the
/// design reports none with cells.
std::string buffers_line(const AcceleratorResult& run) {
    constexpr std::size_t kMostBuffers = 4;
    std::vector<const BufferUse*> buffers;
    for (const BufferUse& buffer : run.buffers) {
        if (buffer.depth != 0) {
            buffers.push_back(&buffer);
        }
    }
    std::stable_sort(buffers.begin(), buffers.end(), [](const BufferUse* a, const BufferUse* b) {
        return ratio_of(a->high_water, a->depth) > ratio_of(b->high_water, b->depth);
    });
    buffers.resize(std::min(buffers.size(), kMostBuffers));
    std::string line;
    for (const BufferUse* buffer : buffers) {
        line += (line.empty() ? "fullest " : kDot) + buffer->name + " " +
                grouped(buffer->high_water) + " of " + grouped(buffer->depth);
    }
    return line.empty() ? line : line + " cells" + unused_words(run);
}

/// Per frame, with the blocks that take the most.
std::string energy_line(const AcceleratorResult& run) {
    const cost::RunEnergy& energy = run.energy;
    constexpr double kMjPerNj = 1e-6;
    constexpr std::size_t kMostShares = 3;
    std::vector<std::pair<double, std::string>> shares;
    for (const cost::BlockEnergy& block : energy.blocks()) {
        shares.emplace_back(block.dynamic_nj + block.leakage_nj, block.name);
    }
    shares.emplace_back(energy.dram_nj().value_or(0), "memory");
    std::stable_sort(shares.begin(), shares.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string line = three_digits(energy.nj_per_frame().value_or(0) * kMjPerNj) +
                       " mJ per frame" + kDot + three_digits(energy.nj_per_pixel().value_or(0)) +
                       " nJ per pixel" + kDot + three_digits(energy.average_power_w().value_or(0)) +
                       " W";
    for (std::size_t i = 0; energy.total_nj() > 0 && i < kMostShares; ++i) {
        line +=
            kDot + shares[i].second + " " + percent(shares[i].first / energy.total_nj(), 0) + " %";
    }
    return line;
}

/// The tiles that a sampled run simulated, and the interval that they gave.
std::string sample_line(const SamplingFacts& sampling) {
    const ReportInterval* const interval = sampling.interval_of(sampling.request.measure);
    const std::string bounds =
        interval == nullptr ? ""
                            : " (" + scaled(interval->low) + " – " + scaled(interval->high) + ")";
    return grouped(sampling.measured) + " of " + grouped(sampling.tiles) + " tiles (" +
           percent(ratio_of(sampling.measured, sampling.tiles)) + " %)" + kDot +
           sampling.request.measure + " ±" + three_digits(100 * sampling.reached) +
           " % at 95 % confidence" + bounds;
}

std::string image_line(const RunResult& result, const std::string& image_path) {
    if (result.sampling) {
        return "the simulated tiles, the others hatched" + std::string(kDot) + image_path;
    }
    if (!result.error) {
        return "not compared (--no-reference)" + std::string(kDot) + image_path;
    }
    const ImageError& error = *result.error;
    const std::string psnr = error.max_abs_error == 0
                                 ? "identical to"
                                 : three_digits(error.psnr_db) + " dB, SSIM " +
                                       similarity(error.ssim) + ", largest error " +
                                       three_digits(error.max_abs_error) + " against";
    const std::uint64_t hazards = result.accelerator.hazards;
    return psnr + " double precision" +
           (hazards == 0 ? "" : ", wrong because of " + grouped(hazards) + " hazards") + kDot +
           image_path;
}

std::string host_line(const RunResult& result) {
    const HostFacts& host = result.host;
    std::string line = "simulation " + three_digits(host.sim_s) + " s";
    if (host.render_s && *host.render_s > 0) {
        line += ", " + three_digits(host.sim_s / *host.render_s) + "× of rendering it";
    }
    if (host.sim_s > 0) {
        line += kDot + scaled(rate_of(result.accelerator.fragments(), host.sim_s)) + " fragments/s";
    }
    return line + kDot + scaled_bytes(host.peak_rss_bytes) + kDot + three_digits(host.wall_s) +
           " s in all";
}

} // namespace

std::string layout(const Block& block) {
    std::size_t width = 0;
    for (const auto& [name, text] : block) {
        width = std::max(width, name.size());
    }
    std::string lines;
    for (const auto& [name, text] : block) {
        std::string line = name;
        line.append(width + 2 - name.size(), ' ').append(visible(text));
        lines += folded(line, output_columns(), width + 2) + "\n";
    }
    return lines;
}

std::string scene_words(const SceneFacts& scene) {
    std::string words = scene.name + kDot + count_words(scene.gaussians, "Gaussian", "Gaussians") +
                        ", SH " + std::to_string(scene.sh_degree);
    if (scene.dropped.total() != 0) {
        words += " (" + grouped(scene.dropped.total()) + " dropped)";
    }
    return words;
}

std::string size_words(const Camera& camera) {
    return std::to_string(camera.width) + "×" + std::to_string(camera.height);
}

std::string summary(const RunResult& result, const std::string& image_path) {
    const AcceleratorResult& run = result.accelerator;
    Block block{{"scene", scene_line(result)},
                {"design", design_line(result)},
                {"frame", frame_line(result)},
                {"slots", slots_line(run)},
                {"losses", losses_line(result)},
                {"stages", stages_line(run)},
                {"memory", memory_line(run)},
                {"energy", energy_line(run)},
                {"image", image_line(result, image_path)}};
    if (const std::string buffers = buffers_line(run); !buffers.empty()) {
        block.insert(std::find_if(block.begin(), block.end(),
                                  [](const auto& line) { return line.first == "memory"; }),
                     {"buffers", buffers}); // behind the stages
    }
    if (!result.views.empty()) {
        block.push_back({"views", views_words(result)});
    }
    if (result.foveation) {
        block.push_back({"foveation", foveation_words(result)});
    }
    if (result.changes) {
        block.push_back({"changes", changes_words(*result.changes)});
    }
    if (result.sampling) {
        block.push_back({"sample", sample_line(*result.sampling)});
    }
    block.push_back({"host", host_line(result)});
    return layout(block);
}

} // namespace degs::sim
