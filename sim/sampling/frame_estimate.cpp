// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/frame_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"
#include "sim/sampling/amounts.hpp"
#include "sim/sampling/stopping_rule.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

std::vector<double> difference(const AcceleratorResult& after, const AcceleratorResult& earlier) {
    std::vector<double> amounts = amounts_of(after);
    const std::vector<double> subtracted = amounts_of(earlier);
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        amounts[i] -= subtracted[i];
    }
    return amounts;
}

TileWork sum_of(const std::vector<TileWork>& blocks) {
    TileWork sum = kNoWork;
    for (const TileWork& block : blocks) {
        sum += block;
    }
    return sum;
}

TileWork less(const TileWork& all, const TileWork& part) {
    return {all.tiles - part.tiles,         all.pixels - part.pixels, all.entries - part.entries,
            all.walked - part.walked,       all.rows - part.rows,     all.tasks - part.tasks,
            all.fragments - part.fragments, all.cycles - part.cycles};
}

std::uint64_t rounded(double value) {
    return static_cast<std::uint64_t>(std::llround(std::max(value, 0.0)));
}

double bytes_read(const AcceleratorResult& run) {
    double bytes = 0;
    for (const StreamUse& stream : run.streams) {
        bytes += real_of(stream.bytes_read);
    }
    return bytes;
}

/// The measures that --within can name.
double value_of(const AcceleratorResult& run, const std::string& path) {
    if (path == "timing.cycles") {
        return real_of(run.cycles);
    }
    if (path == "slots.useful") {
        return real_of(run.slots[Slot::Useful]);
    }
    if (path == "slots.utilization") {
        return ratio_of(run.slots[Slot::Useful], run.slots.total());
    }
    if (path == "dram.bytes_read") {
        return bytes_read(run);
    }
    if (path == "energy.total_nj") {
        return run.energy.total_nj();
    }
    throw std::logic_error("no sample knows the measure '" + path + "'");
}

/// Waits at a buffer include those while a group begins and ends, so their sums are too large.
bool has_interval(const std::string& path) {
    return path.compare(0, 8, "buffers.") != 0;
}

std::map<std::string, double> numbers_of(const AcceleratorResult& run) {
    std::map<std::string, double> numbers;
    const std::vector<Statistic> list = list_statistics([&run](StatsVisitor& visitor) {
        run.describe(visitor);
        visitor.section("energy", run.energy, "");
    });
    for (const Statistic& statistic : list) {
        if (statistic.section || !has_interval(statistic.path)) {
            continue;
        }
        if (const auto* whole = std::get_if<std::uint64_t>(&statistic.value)) {
            numbers[statistic.path] = real_of(*whole);
        } else if (const auto* real = std::get_if<double>(&statistic.value)) {
            numbers[statistic.path] = *real;
        }
    }
    return numbers;
}

} // namespace

FrameEstimate::FrameEstimate(const AcceleratorConfig& config, const FrameWorkload& frame,
                             const std::vector<TileWork>& blocks, double confidence)
    : config_(config), pixels_(std::uint64_t{1} * frame.camera.width * frame.camera.height),
      blocks_(blocks.size()), confidence_(confidence), regression_(blocks), totals_({}),
      rest_(sum_of(blocks)) {}

void FrameEstimate::begin(const AcceleratorResult& head) {
    totals_ = GroupTotals(amounts_of(head));
    raw_ = head;
    edges_ = {head.slots, head.slots.total()};
}

void FrameEstimate::add_block(std::size_t block, std::size_t group, const WindowPart& measured) {
    std::vector<double> values;
    values.reserve(kSlotClasses.size() + 1);
    for (const SlotClass& slot : kSlotClasses) {
        values.push_back(real_of(measured.slots[slot.slot]));
    }
    values.push_back(real_of(measured.total));
    regression_.add(block, group, std::move(values));
}

void FrameEstimate::add_group(const AcceleratorResult& earlier, const AcceleratorResult& after,
                              const TileWork& simulated) {
    totals_.add(difference(after, earlier), simulated);
    raw_ = after;
}

void FrameEstimate::end(const AcceleratorResult& earlier, const AcceleratorResult& after,
                        const WindowPart& edges, const TileWork& warm_up) {
    totals_.add_known(difference(after, earlier));
    rest_ = less(rest_, warm_up); // counted among what is known
    raw_ = after;
    edges_ = edges;
}

FrameEstimate::Slots FrameEstimate::edge_slots() const {
    Slots slots{};
    for (std::size_t i = 0; i < kTotal; ++i) {
        slots[i] = real_of(edges_.slots[kSlotClasses[i].slot]);
    }
    slots[kTotal] = real_of(edges_.total);
    return slots;
}

// What the PEs execute does not depend on the order of the tiles, so it stays as it is: the idle
// classes share what is left of the total.
FrameEstimate::Slots FrameEstimate::slots_without(std::size_t group) const {
    Slots slots = edge_slots();
    double executed = 0, idle = 0;
    for (std::size_t i = 0; i <= kTotal; ++i) {
        const double inner = group < totals_.groups() ? regression_.total_without(i, group)
                                                      : regression_.total(i).value;
        slots[i] += std::max(0.0, inner);
        if (i < kTotal) {
            (is_executed(kSlotClasses[i].slot) ? executed : idle) += slots[i];
        }
    }
    slots[kTotal] = std::max(slots[kTotal], executed);
    for (std::size_t i = 0; i < kTotal; ++i) {
        if (!is_executed(kSlotClasses[i].slot) && idle > 0) {
            slots[i] *= (slots[kTotal] - executed) / idle;
        }
    }
    return slots;
}

AcceleratorResult FrameEstimate::frame_of(const Slots& slots,
                                          const std::vector<double>& amounts) const {
    AcceleratorResult frame = raw_;
    const std::uint64_t pes = frame.pes;
    const Cycle blending = rounded(slots[kTotal] / real_of(pes));
    const Cycle after_last = raw_.window.empty() ? 0 : raw_.cycles - raw_.window.last - 1;
    const Cycle after_run = std::max(raw_.memory_window, raw_.cycles) - raw_.cycles;
    for (std::size_t i = 0; i < kTotal; ++i) {
        frame.slots[kSlotClasses[i].slot] = rounded(slots[i]);
    }
    const auto largest = std::max_element(kSlotClasses.begin(), kSlotClasses.end(),
                                          [&frame](const SlotClass& a, const SlotClass& b) {
                                              return frame.slots[a.slot] < frame.slots[b.slot];
                                          });
    frame.slots[largest->slot] += pes * blending - frame.slots.total(); // what rounding left
    frame.window.last = frame.window.first + blending - 1;
    frame.cycles = frame.window.first + blending + after_last;
    frame.memory_window = frame.cycles + after_run;
    frame.frames.front().finished = frame.cycles;
    // States of the banks at the end of this run, which is not the end of the frame.
    frame.dram_transfers.reset();
    frame.dram_activity.reset();
    frame = with_amounts(std::move(frame), amounts);
    if (frame.dram_energy) { // what time alone costs
        const double longer = ratio_of(frame.memory_window, raw_.memory_window);
        frame.dram_energy->refresh_nj = raw_.dram_energy->refresh_nj * longer;
        frame.dram_energy->background_nj = raw_.dram_energy->background_nj * longer;
    }
    frame.energy = energy_of(config_, frame, pixels_);
    return frame;
}

AcceleratorResult FrameEstimate::frame_without(std::size_t group) const {
    return frame_of(slots_without(group), totals_.totals(rest_, group));
}

AcceleratorResult FrameEstimate::whole_frame(std::size_t tiles) const {
    AcceleratorResult frame = frame_without(totals_.groups());
    frame.tiles = frame.tiles_listed = tiles;
    frame.left_out = {
        "The run is a sample: what it left out was counted in the sampled tiles only."};
    return frame;
}

double FrameEstimate::known_share() const {
    return ratio_of(regression_.blocks(), blocks_);
}

// Half of the interval over a value; `without` holds the value without one group at a time.
double FrameEstimate::jackknife(const std::vector<double>& without) const {
    const auto groups = static_cast<double>(without.size());
    double mean = 0;
    for (const double value : without) {
        mean += value / groups;
    }
    double squares = 0;
    for (const double value : without) {
        squares += (value - mean) * (value - mean);
    }
    return student_t(without.size() - 1, confidence_) *
           std::sqrt((1 - known_share()) * (groups - 1) / groups * squares);
}

Estimate FrameEstimate::own_total(std::size_t measure) const {
    Estimate total = regression_.total(measure, confidence_);
    const double pipeline = kPipelineError * total.value;
    total.half_width = std::hypot(total.half_width, known_share() < 1 ? pipeline : 0.0);
    return total;
}

double FrameEstimate::own_half_width(const std::string& path) const {
    const double pes = raw_.pes;
    const double cycles = own_total(kTotal).half_width / pes;
    if (path == "timing.cycles" || path == "timing.blending_cycles") {
        return cycles;
    }
    if (path == "timing.latency_ms") {
        return cycles / raw_.clock_ghz * 1e-6;
    }
    if (path == "slots.total") {
        return cycles * pes;
    }
    for (std::size_t i = 0; i < kTotal; ++i) {
        if (path == std::string("slots.") + kSlotClasses[i].name) {
            return own_total(i).half_width;
        }
    }
    return 0;
}

double FrameEstimate::relative_half_width(const std::string& path) const {
    const double value = value_of(frame_without(totals_.groups()), path);
    double half = own_half_width(path);
    if (half == 0) {
        std::vector<double> without;
        for (std::size_t g = 0; g < totals_.groups(); ++g) {
            without.push_back(value_of(frame_without(g), path));
        }
        half = jackknife(without);
    }
    return value > 0 ? half / value : half > 0 ? HUGE_VAL : 0;
}

std::vector<ReportInterval> FrameEstimate::intervals() const {
    const std::vector<Statistic> order = list_statistics([this](StatsVisitor& visitor) {
        const AcceleratorResult all = frame_without(totals_.groups());
        all.describe(visitor);
        visitor.section("energy", all.energy, "");
    });
    const std::map<std::string, double> values = numbers_of(frame_without(totals_.groups()));
    std::map<std::string, std::vector<double>> without;
    for (std::size_t g = 0; g < totals_.groups(); ++g) {
        for (const auto& [path, value] : numbers_of(frame_without(g))) {
            without[path].push_back(value);
        }
    }
    std::vector<ReportInterval> intervals;
    for (const Statistic& statistic : order) {
        const auto value = values.find(statistic.path);
        if (value == values.end() || without[statistic.path].size() != totals_.groups()) {
            continue;
        }
        const double own = own_half_width(statistic.path);
        const double half = own > 0 ? own : jackknife(without[statistic.path]);
        intervals.push_back({statistic.path, value->second - half, value->second + half});
    }
    return intervals;
}

} // namespace degs::sim
