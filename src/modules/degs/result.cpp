// SPDX-License-Identifier: Apache-2.0
// The counters of DeGS in the terms that all accelerators share.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/grouped_number.hpp"
#include "modules/degs/engine.hpp"
#include "modules/degs/span_engine/span_replay.hpp"

namespace degs {
namespace {

/// Whether a rate of the Issue Banks limits them if they use this part of it.
bool is_full(double part) {
    return part > 0.75;
}

/// Keys that limited nothing, out of those of the rates at which Issue Banks take and issue
/// segments.
std::vector<std::string> idle_packing_keys(double intake, double issue) {
    const std::string takes = "scheduler.segments_per_cycle", issues = "scheduler.issue_width";
    std::vector<std::string> idle;
    if (!is_full(intake)) {
        idle.push_back(takes);
    }
    if (!is_full(issue)) {
        idle.push_back(issues);
    }
    if (idle.size() == 2) {
        idle.push_back(issues + " and " + takes);
    }
    return idle;
}

} // namespace

/// PE-cycles of the whole array: executed tasks, idle slots between packets, and what a slice
/// missed of the window before its first and after its last packet.
void Degs::collect_slots(AcceleratorResult& result) const {
    for (const auto& slice : blocks_.slices) {
        result.slots += slice->stats().slots;
        result.window.include(slice->stats().window);
        result.hazards += slice->stats().hazards;
    }
    const std::uint64_t width = config_.array.pes_per_bank;
    for (std::size_t b = 0; b < blocks_.slices.size(); ++b) {
        result.slots += blocks_.packing[b]->idle();
        const ActiveWindow& own = blocks_.slices[b]->stats().window;
        if (own.empty()) {
            result.slots[Slot::Drain] += result.window.cycles() * width;
        } else {
            result.slots[Slot::Starved] += (own.first - result.window.first) * width;
            result.slots[Slot::Drain] += (result.window.last - own.last) * width;
        }
    }
}

void Degs::collect_stages(AcceleratorResult& result) const {
    front_end_->collect(result);
    add_stage(result, kFetching, blocks_.fetchers.size(),
              sum_of(blocks_.fetchers, &SplatFetcher::Stats::busy),
              Counters().add(blocks_.fetchers));
    if (supply_) {
        Counters counters;
        supply_->stats().describe(counters);
        add_stage(result, {"splat_supply", "Splat Supply, busy when its bus carries a record."}, 1,
                  supply_->stats().bus_busy, std::move(counters));
    }
    add_stage(result, {"slicing", "Gaussian Slicing Units, without their waiting."},
              config_.clusters * config_.slicing.count,
              sum_of(blocks_.slicing, &GaussianSlicingUnit::Stats::busy),
              Counters().add(blocks_.slicing));
    add_stage(result, {"span", "Span Units, without their waiting."},
              config_.clusters * config_.span.count, sum_of(blocks_.spans, &SpanStage::Stats::busy),
              Counters().add(blocks_.spans));
    add_stage(result, {"packing", "Issue Banks with their Packing Units, busy when they issue."},
              blocks_.banks.size(), sum_of(blocks_.banks, &IssueBank::Stats::busy),
              Counters().add(blocks_.banks).add(blocks_.packing));
    add_stage(result, {"blending", "Array slices, busy when they execute a packet.", true},
              blocks_.slices.size(), sum_of(blocks_.slices, &ArraySlice::Stats::packets),
              Counters().add(blocks_.slices));
}

RingUse Degs::span_buffer() const {
    RingUse use = use_of(blocks_.span_buffer);
    for (const auto& stage : blocks_.spans) {
        for (const auto& spans : stage->replays()) {
            use += use_of(spans->lane_counts(), 0);
        }
    }
    return use;
}

RingUse Degs::crossbar() const {
    RingUse use = use_of(blocks_.crossbar);
    for (const auto& stage : blocks_.spans) {
        for (const auto& spans : stage->replays()) {
            use += use_of(spans->counts(), 0);
        }
    }
    return use;
}

RingUse Degs::packing_buffer() const {
    RingUse use = use_of(blocks_.packing_buffer);
    for (const auto& unit : blocks_.packing) {
        const PassedPackets& passed = unit->passed();
        use.items += passed.items();
        use.empty_cycles += passed.empty_cycles();
        use.occupied_cycles += passed.occupied_cycles();
        use.high_water = std::max(use.high_water, passed.high_water());
    }
    return use;
}

void Degs::collect_buffers(AcceleratorResult& result) const {
    const DegsConfig& c = config_;
    const std::int64_t many = c.clusters;
    add_buffer(result, {"gaussian_buffer", "Chunks of splats, once for each Slicing Unit."},
               many * c.gaussian_buffer.bytes, c.gaussian_chunks(), gaussian_buffer());
    add_buffer(result, {"span_buffer", "Rows of splats on their way to the Span Units."},
               many * c.span_buffer.bytes, c.span_lane_depth(), span_buffer());
    add_buffer(result, {"crossbar", "Span Vectors; Table I of the paper does not count them."}, 0,
               c.crossbar_cells(), crossbar());
    // More cells than the buffer has packets: the pipeline and ends of tiles, see connect_slice().
    const std::uint64_t packing_cells = blocks_.packing_buffer.front()->depth();
    add_buffer(result,
               {"packing_buffer",
                "Packets that wait or are in the pipeline, and at least four cells for "
                "ends of tiles."},
               many * c.packing.bytes, packing_cells, packing_buffer());
    Counters& feature = add_buffer(result, {"feature_buffer", "Parameters of splats in the banks."},
                                   many * c.feature_buffer.bytes)
                            .counters;
    feature.count("banks", blocks_.banks.size(), "banks", "Parts of it, one for each Issue Bank.");
    feature.count("entries_per_bank", c.feature_entries(), "splats", "Splats that one part holds.");
    for (const auto& bank : blocks_.banks) {
        bank->features().stats().describe(feature);
    }
    add_pixel_buffer(result, many * c.pixel_buffer.bytes, c.tile_contexts(), blocks_.pixel_buffers);
}

void Degs::collect_laws(AcceleratorResult& result) const {
    using B = IssueBank::Stats;
    const std::uint64_t in = sum_of(blocks_.banks, &B::tasks_in);
    const std::uint64_t issued = sum_of(blocks_.banks, &B::tasks_issued);
    const std::uint64_t dropped = sum_of(blocks_.banks, &B::tasks_dropped);
    const std::uint64_t packed = sum_of(blocks_.packing, &PackingUnit::Stats::tasks);
    const SlotAccount& s = result.slots;
    result.waited_s = functional_ ? functional_->waited_s() : 0;
    if (functional_ && functional_->fragments() != s[Slot::Useful]) {
        throw std::logic_error("the model is broken, pixels updated = useful tasks executed: " +
                               std::to_string(functional_->fragments()) + " is not " +
                               std::to_string(s[Slot::Useful]));
    }
    result.conservation.insert(
        result.conservation.end(),
        {
            {"tasks solved = tasks into the banks", sum_of(blocks_.spans, &SpanStage::Stats::tasks),
             in},
            {"tasks into the banks = issued + dropped", in, issued + dropped},
            {"tasks issued = packed", issued, packed},
            {"tasks packed = executed", packed,
             s[Slot::Useful] + s[Slot::Boundary] + s[Slot::Terminated]},
            {"packets packed = executed", sum_of(blocks_.packing, &PackingUnit::Stats::packets),
             sum_of(blocks_.slices, &ArraySlice::Stats::packets)},
        });
}

void Degs::collect_supply_laws(AcceleratorResult& result) const {
    if (!supply_) {
        return;
    }
    const SplatSupply::Stats& stats = supply_->stats();
    const RecordSharing::Stats& records = stats.records;
    result.conservation.insert(
        result.conservation.end(),
        {
            {"splat records fetched = asked of the supply",
             sum_of(blocks_.fetchers, &SplatFetcher::Stats::records), records.requested},
            {"splat records asked of the supply = read + captured + found in its cache",
             records.requested, records.read + records.captured + records.hits},
            {"splat records asked of the supply = delivered", records.requested, stats.delivered},
        });
}

void Degs::explain(AcceleratorResult& result) const {
    auto& out = result.left_out;
    explain_tiles(result, sum_of(blocks_.fetchers, &SplatFetcher::Stats::records_cancelled));
    out.push_back(grouped(sum_of(blocks_.slicing, &GaussianSlicingUnit::Stats::splats_cancelled)) +
                  " splats of cancelled tiles had been fetched and were not sliced.");
    out.push_back(grouped(sum_of(blocks_.banks, &IssueBank::Stats::tasks_dropped)) +
                  " tasks of ended pixels were dropped by the Issue Banks and cost no PE slot.");
    out.push_back(grouped(sum_of(blocks_.spans, &SpanStage::Stats::empty_rows)) +
                  " rows of splats cover no pixel of their tile: they cost a Span Unit cycle and "
                  "nothing after it.");
    explain_ports(result);
}

void Degs::explain_ports(AcceleratorResult& result) const {
    if (!config_.ports_limited()) {
        result.left_out.emplace_back(
            "Every SRAM had as many ports as anybody wanted (the keys `ports`).");
        return;
    }
    using G = GaussianSlicingUnit::Stats;
    std::uint64_t fills = 0;
    for (const auto& bank : blocks_.banks) {
        fills += bank->features().stats().fill_waits;
    }
    result.left_out.push_back("Taken SRAM ports left " + grouped(result.slots[Slot::Ports]) +
                              " PE-cycles without a task. Slicing Units waited " +
                              grouped(sum_of(blocks_.slicing, &G::splat_port_waits)) +
                              " cycles for the Gaussian Buffer and " +
                              grouped(sum_of(blocks_.slicing, &G::row_port_waits)) +
                              " for the Span Buffer, lanes of the Span Buffer " +
                              grouped(sum_of(blocks_.spans, &SpanStage::Stats::row_port_waits)) +
                              " for Span Units, and Issue Banks " + grouped(fills) +
                              " for entries of the Feature Buffer that were being written.");
}

void Degs::collect(AcceleratorResult& result) const {
    for (const auto& bank : blocks_.banks) {
        bank->count_totals();
    }
    collect_frames(result, job_, blocks_.pixel_buffers, frame_ends_.background());
    result.tiles = finished_tiles();
    result.tiles_cancelled = sum_of(blocks_.monitors, &TileMonitor::Stats::tiles_cancelled);
    collect_slots(result);
    collect_stages(result);
    collect_buffers(result);
    collect_activity(result);
    streams_.collect(result);
    result.waits.splats = ratio_of(gaussian_buffer().late_cycles, blocks_.slicing.size());
    collect_laws(result);
    collect_supply_laws(result);
    collect_idle_keys(result);
    explain(result);
}

void Degs::collect_idle_keys(AcceleratorResult& result) const {
    std::uint64_t high_water = 0, waits = 0, entries = 0;
    for (const auto& bank : blocks_.banks) {
        high_water = std::max(high_water, bank->stats().queue_high_water);
        waits += bank->features().stats().waits;
        entries += bank->features().stats().entries;
    }
    const double share = entries == 0 ? 0 : ratio_of(waits, entries);
    for (std::string& key : config_.idle_window_keys(high_water, share)) {
        result.idle_keys.push_back(std::move(key));
    }
    collect_idle_streams(result);
}

/// Collects keys that limited nothing among the Issue Banks' rates and the number of tile streams.
void Degs::collect_idle_streams(AcceleratorResult& result) const {
    using B = IssueBank::Stats;
    const double issued = real_of(sum_of(blocks_.banks, &B::segments_issued));
    const double taken = issued + real_of(sum_of(blocks_.banks, &B::segments_dropped));
    const double cycles = real_of(result.window.cycles()) * real_of(blocks_.banks.size());
    const double issuing = real_of(sum_of(blocks_.banks, &B::busy));
    const auto use_of_rate = [](double segments, double time, int rate) {
        return time > 0 ? segments / time / rate : 0;
    };
    const double intake = use_of_rate(taken, cycles, config_.scheduler.segments_per_cycle);
    const double issue = use_of_rate(issued, issuing, config_.scheduler.issue_width);
    for (std::string& key : idle_packing_keys(intake, issue)) {
        result.idle_keys.push_back(std::move(key));
    }
    constexpr double kBusy = 0.6; // another stream would wait for its tiles
    const bool few_tiles_come =
        std::any_of(result.stages.begin(), result.stages.end(), [&](const StageUse& stage) {
            return (stage.name == "sorting" || stage.name == "fetching") &&
                   stage.busy_cycles > kBusy * stage.units * real_of(result.window.cycles());
        });
    constexpr std::uint64_t kFewTiles = 24; // of a cluster: streams would wait for the longest
    const bool few_tiles = job_.tiles.size() < kFewTiles * config_.clusters * result.frames.size();
    if (few_tiles || few_tiles_come || is_full(intake)) {
        result.idle_keys.emplace_back("slicing.interleave");
    }
}

} // namespace degs
