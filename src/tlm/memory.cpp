// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "base/ratio.hpp"
#include "tlm/scattered_records.hpp"

namespace degs {
namespace {

/// Kernel time units, as the fractional time of the bus counts them.
double units_of(const sc_core::sc_time& time) {
    return time / sc_core::sc_time::from_value(1);
}

} // namespace

void Memory::Config::describe(ConfigVisitor& visitor) {
    visitor.real("bandwidth_gb_per_s", bandwidth_gb_per_s, 0.01, 1e5,
                 "1e9 bytes/s; 204.8 is the paper's main setting");
    visitor.real("latency_ns", latency_ns, 0.0, 1e6,
                 "ns; request to data without the transfer; 100: the order of a loaded LPDDR5 "
                 "controller [assumed]");
    visitor.integer("access_bytes", access_bytes, 1, 4096,
                    "bytes; access granularity, a partial access costs a whole one");
}

Memory::Memory(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               std::size_t initiators)
    : sc_core::sc_module(name), in("in", initiators), config_(config),
      half_cycle_(sc_core::sc_time::from_value(time.clock.period().value() / 2)),
      activations_(time.activations), units_per_ns_(units_of(sc_core::sc_time(1, sc_core::SC_NS))),
      stats_(initiators) {
    int initiator = 0;
    for (auto& socket : in) {
        socket.register_b_transport(this, &Memory::transport, initiator);
        socket.register_transport_dbg(this, &Memory::debug, initiator);
        ++initiator;
    }
}

Memory::Stats Memory::total() const {
    Stats sum;
    for (const Stats& s : stats_) {
        sum.reads += s.reads;
        sum.writes += s.writes;
        sum.bytes_read += s.bytes_read;
        sum.bytes_written += s.bytes_written;
        sum.busy_ns += s.busy_ns;
        sum.last_answer = std::max(sum.last_answer, s.last_answer);
        sum.waited_ns += s.waited_ns;
    }
    return sum;
}

// Half a cycle after a date every request of that date has been made (see Process), so whoever
// wakes first then may serve all of them in order.
void Memory::transport(int initiator, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    if (!payload.is_read() && !payload.is_write()) {
        payload.set_response_status(tlm::TLM_COMMAND_ERROR_RESPONSE);
        return;
    }
    if (payload.get_data_length() == 0 || payload.get_byte_enable_ptr() != nullptr ||
        payload.get_streaming_width() < payload.get_data_length()) {
        payload.set_response_status(payload.get_byte_enable_ptr() != nullptr
                                        ? tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE
                                        : tlm::TLM_BURST_ERROR_RESPONSE);
        return;
    }
    Request request;
    request.date = sc_core::sc_time_stamp() + delay;
    request.initiator = initiator;
    request.sequence = sequence_++;
    request.payload = &payload;
    pending_.push_back(&request);
    sc_core::wait(delay + half_cycle_);
    count_activation(activations_);
    if (!request.served) {
        serve_until(request.date);
    }
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    delay = request.done > now ? request.done - now : sc_core::SC_ZERO_TIME;
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void Memory::serve_until(const sc_core::sc_time& date) {
    const auto due = std::partition(pending_.begin(), pending_.end(),
                                    [&date](const Request* r) { return r->date > date; });
    std::sort(due, pending_.end(), [](const Request* a, const Request* b) {
        return std::tie(a->date, a->initiator, a->sequence) <
               std::tie(b->date, b->initiator, b->sequence);
    });
    for (auto r = due; r != pending_.end(); ++r) {
        serve(**r);
    }
    pending_.erase(due, pending_.end());
}

void Memory::serve(Request& request) {
    tlm::tlm_generic_payload& payload = *request.payload;
    const std::uint64_t granule = config_.access_bytes;
    const std::uint64_t first = payload.get_address() / granule;
    const std::uint64_t last = (payload.get_address() + payload.get_data_length() - 1) / granule;
    const std::uint64_t bytes = (last - first + 1) * granule;
    const double transfer_ns = rate_of(bytes, config_.bandwidth_gb_per_s);
    const double asked = units_of(request.date);
    const double start = std::max(bus_free_, asked);
    bus_free_ = start + transfer_ns * units_per_ns_;
    // Rounded up to the kernel's resolution, but not because of the rounding of a double: a whole
    // cycle may hang on it.
    constexpr double kRounding = 1e-3;
    request.done = sc_core::sc_time::from_value(
        std::llround(std::ceil(bus_free_ + config_.latency_ns * units_per_ns_ - kRounding)));
    request.served = true;
    Stats& stats = stats_[request.initiator];
    (payload.is_read() ? stats.reads : stats.writes)++;
    (payload.is_read() ? stats.bytes_read : stats.bytes_written) += bytes;
    stats.busy_ns += transfer_ns;
    stats.last_answer = std::max(stats.last_answer, request.done);
    stats.waited_ns += (start - asked) / units_per_ns_;
    if (payload.get_extension<TimingOnly>() == nullptr) {
        copy(payload);
    }
}

void Memory::copy(const tlm::tlm_generic_payload& payload) {
    for_each_run(payload, [&](std::uint64_t address, unsigned char* data, std::uint64_t bytes) {
        copy_run(payload.is_write(), address, data, bytes);
    });
}

void Memory::copy_run(bool write, std::uint64_t address, unsigned char* data, std::uint64_t bytes) {
    for (std::uint64_t left = bytes; left != 0;) {
        const std::uint64_t offset = address % kPageBytes;
        const std::uint64_t piece = std::min(left, kPageBytes - offset);
        if (write) {
            std::memcpy(pages_[address / kPageBytes].data() + offset, data, piece);
        } else if (const auto page = pages_.find(address / kPageBytes); page != pages_.end()) {
            std::memcpy(data, page->second.data() + offset, piece);
        } else {
            std::memset(data, 0, piece);
        }
        data += piece;
        address += piece;
        left -= piece;
    }
}

unsigned int Memory::debug(int /*initiator*/, tlm::tlm_generic_payload& payload) {
    if (!payload.is_read() && !payload.is_write()) {
        return 0;
    }
    copy(payload);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    return payload.get_data_length();
}

} // namespace degs
