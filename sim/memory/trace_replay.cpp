// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/trace_replay.hpp"

#include <algorithm>

#include "base/ratio.hpp"
#include "sim/process/stopwatch.hpp"
#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kMostAhead = 1U << 16U; // accesses that are read ahead of the memory
constexpr int kReplayedBytes = 64;            // bytes

} // namespace

TraceReplay::TraceReplay(const sc_core::sc_module_name& name, dram::Lpddr5& memory,
                         const dram::Config& config, TraceReader& trace, double clock_ghz)
    : sc_core::sc_module(name), out("out", config.channels), memory_(&memory), trace_(&trace),
      clock_(clock_ghz), window_(traffic_window(config, kReplayedBytes)),
      has_next_(trace.next(next_)), lines_(config.channels) {
    for (int channel = 0; channel < config.channels; ++channel) {
        out[channel].register_nb_transport_bw(this, &TraceReplay::backward, channel);
        out[channel].bind(memory.in[channel]);
    }
    DEGS_HAS_PROCESS(TraceReplay);
    SC_METHOD(feed);
    sensitive << feed_event_;
    dont_initialize();
}

TrafficResult TraceReplay::run(std::uint64_t accesses, Progress& progress) {
    const Stopwatch host;
    const sc_core::sc_time slice(10, sc_core::SC_US);
    const sc_core::sc_time start = clock_.at(next_.cycle);
    feed_event_.notify(trace_->dated() ? start : sc_core::SC_ZERO_TIME);
    do {
        sc_core::sc_start(slice);
        progress.done(ratio_of(answered_, accesses));
    } while (sc_core::sc_pending_activity());

    TrafficResult result;
    result.host_s = host.seconds();
    result.host_requests = result.requests = answered_;
    result.seconds = (last_answer_ - start).to_seconds();
    const dram::Lpddr5::Stats moved = memory_->total();
    result.bytes = moved.bytes_read + moved.bytes_written;
    result.reads = reads_;
    result.writes = writes_;
    result.commands = memory_->commands(last_answer_);
    result.commands.subtract(before_->commands);
    result.energy = memory_->energy(last_answer_) - before_->energy;
    return result;
}

/// Reads on as far as the dates, and the room for what waits, allow.
void TraceReplay::feed() {
    if (!before_) {
        before_ = {memory_->commands(), memory_->energy()};
    }
    while (has_next_ && waiting_ < kMostAhead) {
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        const sc_core::sc_time date = trace_->dated() ? clock_.at(next_.cycle) : now;
        if (date > now) {
            feed_event_.notify(date - now);
            return;
        }
        const std::size_t line = memory_->channels().mapping().place(next_.address).channel;
        lines_[line].waiting.push_back({next_, date});
        ++waiting_;
        has_next_ = trace_->next(next_);
        send_all(line);
    }
    full_ = has_next_;
}

void TraceReplay::send_all(std::size_t line) {
    Line& own = lines_[line];
    while (!own.requesting && !own.waiting.empty() &&
           (trace_->dated() || own.under_way < window_)) {
        send(line);
    }
}

void TraceReplay::send(std::size_t line) {
    Line& own = lines_[line];
    const Waiting first = own.waiting.front();
    own.waiting.pop_front();
    --waiting_;
    const sc_core::sc_time date = trace_->dated() ? first.date : sc_core::sc_time_stamp();
    tlm::tlm_generic_payload& payload = payloads_.acquire(date);
    set_access(payload, first.access.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND,
               first.access.address, no_data_.data(), first.access.bytes);
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const auto answer = out[line]->nb_transport_fw(payload, phase, delay);
    own.requesting = answer == tlm::TLM_ACCEPTED;
    ++own.under_way;
}

tlm::tlm_sync_enum TraceReplay::backward(int line, tlm::tlm_generic_payload& payload,
                                         tlm::tlm_phase& phase, sc_core::sc_time& /*delay*/) {
    const bool response = phase == tlm::BEGIN_RESP;
    if (response) {
        --lines_[line].under_way;
        answered(payload);
        payload.release();
    } else {
        lines_[line].requesting = false;
    }
    send_all(line);
    if (full_ && waiting_ < kMostAhead) {
        full_ = false;
        feed_event_.notify(sc_core::SC_ZERO_TIME);
    }
    return response ? tlm::TLM_COMPLETED : tlm::TLM_ACCEPTED;
}

void TraceReplay::answered(const tlm::tlm_generic_payload& payload) {
    ++answered_;
    last_answer_ = sc_core::sc_time_stamp();
    const double ns = (last_answer_ - TrafficPayloads::date_of(payload)).to_seconds() * 1e9;
    (payload.is_read() ? reads_ : writes_).add(ns);
}

} // namespace degs::sim
