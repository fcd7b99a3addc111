// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/issue_bank.hpp"

#include "modules/degs/scheduler/bank_cycles.hpp"
#include "tlm/has_process.hpp"

namespace degs {
namespace {

// Every cut writes a segment, and every issue reads one.
IssueBank::Config within_ports(IssueBank::Config config) {
    config.segments_per_cycle = config.segment_ports.of(config.segments_per_cycle);
    config.issue_width = config.segment_ports.of(config.issue_width);
    return config;
}

} // namespace

IssueBank::IssueBank(const sc_core::sc_module_name& name, const Config& config,
                     const Timebase& time, const RenderJob& job, PackingUnit& packing, int index,
                     std::size_t inputs, int contexts)
    : sc_core::sc_module(name), in("in", inputs * config.streams), terminated("terminated"),
      context_free("context_free", config.streams), config_(within_ports(config)), job_(job),
      index_(index), packing_(packing), contexts_(contexts), streams_(config.streams),
      spans_per_cycle_(config.spans_per_cycle == 0 ? config_.segments_per_cycle
                                                   : config.spans_per_cycle),
      self_(time), segmenter_(job.tile_size, config.segment_length, index, config.banks),
      features_(config.feature_entries, config.open_splats, config.streams, config.fill),
      tiles_(job, config.granted ? config.streams : 0),
      width_cause_(config_.issue_width < config.issue_width ? Slot::Ports : Slot::Starved) {
    for (BankStream& stream : streams_) {
        stream.index = &stream - streams_.data();
        stream.next = &streams_[(stream.index + 1) % streams_.size()];
        stream.inputs.resize(inputs);
        stream.startable = contexts;
    }
    DEGS_HAS_PROCESS(IssueBank);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

IssueBank::~IssueBank() = default;

void IssueBank::end_of_elaboration() {
    std::size_t port = 0;
    for (BankStream& stream : streams_) {
        for (BankStream::Input& input : stream.inputs) {
            input.ring = &in[port++].ring();
            input.ring->connect_reader(self_);
        }
        stream.contexts_freed = &context_free[stream.index].ring();
        stream.contexts_freed->connect_reader(self_);
    }
    terminations_ = &terminated.ring();
    terminations_->connect_reader(self_);
    packing_.out->connect_writer(self_);
}

void IssueBank::start_of_simulation() {
    if (log_ != nullptr) {
        start_log();
    }
    if (spans_ != nullptr) {
        const auto& replays = spans_->hand_over(self_);
        for (std::size_t stream = 0; stream < replays.size(); ++stream) {
            streams_[stream].inputs.front().spans = replays[stream].get();
        }
    }
    cycles_ = std::make_unique<BankCycles>(BankCycles::Parts{
        *this, config_, job_, packing_, *terminations_, streams_, segmenter_, features_, tiles_,
        self_, stats_, contexts_, config_.tiles_of(contexts_), spans_per_cycle_, width_cause_,
        trace_, tile_log_ ? &*tile_log_ : nullptr});
}

void IssueBank::count_totals() {
    if (cycles_ != nullptr) { // the simulation has started
        cycles_->count_totals();
    }
}

void IssueBank::run() {
    cycles_->run();
}

} // namespace degs
