// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/memory_traffic.hpp"

#include <algorithm>
#include <cmath>

#include "sim/process/stopwatch.hpp"
#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {

int traffic_window(const dram::Config& config, int request_bytes) {
    const dram::Timing& timing = config.timing;
    const int extra = static_cast<int>(std::ceil(config.controller_latency_ns / timing.ck_ns()));
    const int bytes_per_ck = static_cast<int>(timing.burst_bytes()) / timing.burst();
    constexpr int kAccess = dram::kAccessBytes;
    const int access_ck = std::min(request_bytes + bytes_per_ck - 1, kAccess) / bytes_per_ck;
    const int latency = static_cast<int>(timing.read_latency()) + extra;
    const int accesses = config.controller.read_queue + (latency + access_ck - 1) / access_ck;
    const int per_request = (request_bytes + kAccess - 1) / kAccess;
    return (accesses + per_request - 1) / per_request + 1;
}

MemoryTraffic::MemoryTraffic(const sc_core::sc_module_name& name, dram::Lpddr5& memory,
                             const dram::Config& config, const TrafficShape& shape)
    : sc_core::sc_module(name), out("out", config.channels), memory_(&memory), shape_(shape),
      peak_gb_per_s_(config.peak_gb_per_s()), window_(traffic_window(config, shape.request_bytes)),
      dealer_(shape, memory.channels().mapping(), config.channels), lines_(config.channels),
      no_data_(shape.request_bytes) {
    for (int channel = 0; channel < config.channels; ++channel) {
        out[channel].register_nb_transport_bw(this, &MemoryTraffic::backward, channel);
        out[channel].bind(memory.in[channel]);
    }
    DEGS_HAS_PROCESS(MemoryTraffic);
    SC_METHOD(begin);
    sensitive << begin_event_;
    dont_initialize();
    SC_METHOD(arrive);
    sensitive << arrive_event_;
    dont_initialize();
    SC_METHOD(watch);
    sensitive << watch_event_;
    dont_initialize();
}

TrafficResult MemoryTraffic::measure(std::uint64_t requests, double offered) {
    const Stopwatch host;
    const std::uint64_t before = answered_;
    const std::uint64_t warm_up = std::max<std::uint64_t>(requests / 5, 64 * lines_.size());
    first_ = before + warm_up;
    last_ = first_ + requests;
    offered_ = offered;
    reads_ = writes_ = LatencyHistogram();
    start_.reset();
    end_.reset();
    sending_ = true;
    begin_event_.notify(sc_core::SC_ZERO_TIME);
    sc_core::sc_start();

    TrafficResult result;
    result.offered = offered;
    result.host_s = host.seconds();
    result.host_requests = answered_ - before;
    result.seconds = (end_->time - start_->time).to_seconds();
    result.requests = end_->requests - start_->requests;
    result.bytes = result.requests * shape_.request_bytes;
    result.reads = reads_;
    result.writes = writes_;
    result.commands = end_->commands;
    result.commands.subtract(start_->commands);
    result.energy = end_->energy - start_->energy;
    return result;
}

void MemoryTraffic::begin() {
    if (offered_ > 0) {
        next_arrival_ = sc_core::sc_time_stamp();
        arrive();
        return;
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        send_all(i);
    }
}

void MemoryTraffic::arrive() {
    if (!sending_) {
        return;
    }
    const TrafficItem item = dealer_.draw();
    const unsigned line = dealer_.channel_of(item);
    lines_[line].arrived.emplace_back(item, sc_core::sc_time_stamp());
    send_all(line);
    const double mean_ns = shape_.request_bytes / (offered_ * peak_gb_per_s_);
    const double u = (static_cast<double>(random_() >> 11U) + 1) * 0x1p-53; // 0 < u <= 1
    next_arrival_ += sc_core::sc_time(-std::log(u) * mean_ns, sc_core::SC_NS);
    arrive_event_.notify(next_arrival_ - sc_core::sc_time_stamp());
}

void MemoryTraffic::send_all(std::size_t line) {
    while (!lines_[line].requesting && send(line)) {
    }
}

/// False if there is nothing to send.
bool MemoryTraffic::send(std::size_t line) {
    TrafficItem item;
    sc_core::sc_time date = sc_core::sc_time_stamp();
    auto& arrived = lines_[line].arrived;
    if (offered_ > 0) {
        if (arrived.empty()) {
            return false;
        }
        std::tie(item, date) = arrived.front();
        arrived.pop_front();
    } else if (!sending_ || lines_[line].under_way >= window_ || !dealer_.next_of(line, item)) {
        return false;
    }
    tlm::tlm_generic_payload& payload = payloads_.acquire(date);
    set_access(payload, item.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND, item.address,
               no_data_.data(), shape_.request_bytes);
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const auto answer = out[line]->nb_transport_fw(payload, phase, delay);
    lines_[line].requesting = answer == tlm::TLM_ACCEPTED;
    ++lines_[line].under_way;
    return true;
}

tlm::tlm_sync_enum MemoryTraffic::backward(int line, tlm::tlm_generic_payload& payload,
                                           tlm::tlm_phase& phase, sc_core::sc_time& /*delay*/) {
    const std::size_t own = line;
    const bool response = phase == tlm::BEGIN_RESP;
    if (response) {
        --lines_[own].under_way;
        answered(payload);
        payload.release();
    } else {
        lines_[own].requesting = false;
    }
    send_all(own);
    return response ? tlm::TLM_COMPLETED : tlm::TLM_ACCEPTED;
}

void MemoryTraffic::answered(const tlm::tlm_generic_payload& payload) {
    ++answered_;
    const sc_core::sc_time made = TrafficPayloads::date_of(payload);
    if (start_ && !end_ && made >= start_->time) {
        const double ns = (sc_core::sc_time_stamp() - made).to_seconds() * 1e9;
        (payload.is_read() ? reads_ : writes_).add(ns);
    }
    if (answered_ == first_ || answered_ == last_) {
        watch_event_.notify(sc_core::SC_ZERO_TIME);
    }
}

// The memory's statistics must not be read within its own calls.
void MemoryTraffic::watch() {
    (start_ ? end_ : start_) = snapshot();
    sending_ = !end_;
}

MemoryTraffic::Snapshot MemoryTraffic::snapshot() {
    return {sc_core::sc_time_stamp(), answered_, memory_->commands(), memory_->energy()};
}

} // namespace degs::sim
