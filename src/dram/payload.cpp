// SPDX-License-Identifier: Apache-2.0
// The data of requests and their counters; the other half of lpddr5.cpp.
#include <limits>

#include "dram/lpddr5.hpp"
#include "tlm/scattered_records.hpp"

namespace degs::dram {
namespace {

/// Calls visit(offset, bytes) for every run of enabled bytes among those of the data array from
/// `begin` to `end`. The enables of a payload repeat.
template <class Visit>
void each_enabled(const tlm::tlm_generic_payload& payload, std::uint64_t begin, std::uint64_t end,
                  const Visit& visit) {
    const unsigned char* const enables = payload.get_byte_enable_ptr();
    const auto enabled = [&](std::uint64_t at) {
        return enables[at % payload.get_byte_enable_length()] != TLM_BYTE_DISABLED;
    };
    for (std::uint64_t at = begin; at != end;) {
        std::uint64_t next = at + 1;
        while (next != end && enabled(next) == enabled(at)) {
            ++next;
        }
        if (enabled(at)) {
            visit(at, next - at);
        }
        at = next;
    }
}

} // namespace

tlm::tlm_response_status Lpddr5::check(const Payload& payload) const {
    if (!payload.is_read() && !payload.is_write()) {
        return tlm::TLM_COMMAND_ERROR_RESPONSE;
    }
    if (payload.get_byte_enable_ptr() != nullptr && payload.get_byte_enable_length() == 0) {
        return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
    }
    if (payload.get_data_length() == 0 ||
        payload.get_streaming_width() < payload.get_data_length()) {
        return tlm::TLM_BURST_ERROR_RESPONSE;
    }
    const std::uint64_t capacity = channels_.mapping().capacity();
    bool inside = true;
    for_each_run(payload, [&](std::uint64_t address, const unsigned char*, std::uint64_t bytes) {
        inside = inside && address < capacity && bytes <= capacity - address;
    });
    return inside ? tlm::TLM_OK_RESPONSE : tlm::TLM_ADDRESS_ERROR_RESPONSE;
}

// The bytes that are not enabled stay as they are, in the memory and in the payload.
void Lpddr5::copy(const Payload& payload) {
    const auto move = [&](std::uint64_t address, unsigned char* data, std::uint64_t bytes) {
        if (payload.is_write()) {
            storage_.write(address, data, bytes);
        } else {
            storage_.read(address, data, bytes);
        }
    };
    for_each_run(payload, [&](std::uint64_t address, unsigned char* data, std::uint64_t bytes) {
        if (payload.get_byte_enable_ptr() == nullptr) {
            move(address, data, bytes);
            return;
        }
        const std::uint64_t begin = data - payload.get_data_ptr();
        each_enabled(payload, begin, begin + bytes, [&](std::uint64_t at, std::uint64_t count) {
            move(address + at - begin, payload.get_data_ptr() + at, count);
        });
    });
}

void Lpddr5::count(std::uint32_t socket, const Payload& payload, const sc_core::sc_time& date,
                   const sc_core::sc_time& done) {
    Stats& stats = stats_[socket];
    const std::uint64_t burst = config_.timing.burst_bytes();
    std::uint64_t bytes = 0;
    for_each_run(payload, [&](std::uint64_t address, const unsigned char*, std::uint64_t run) {
        bytes += ((address + run + burst - 1) / burst - address / burst) * burst;
    });
    const double ns = (done - date).to_seconds() * 1e9;
    if (payload.is_read()) {
        ++stats.reads;
        stats.bytes_read += bytes;
        stats.read_latency.add(ns);
    } else {
        ++stats.writes;
        stats.bytes_written += bytes;
        stats.write_latency.add(ns);
    }
    stats.last_answer = std::max(stats.last_answer, done);
}

// Accesses through the pointer bypass banks and buses; the reported latencies are those of a row
// hit.
bool Lpddr5::direct_memory(int /*socket*/, Payload& payload, tlm::tlm_dmi& dmi) {
    const std::uint64_t address = payload.get_address();
    if (!config_.dmi || address >= channels_.mapping().capacity()) {
        dmi.set_start_address(0);
        dmi.set_end_address(std::numeric_limits<sc_dt::uint64>::max());
        return false;
    }
    const std::uint64_t start = address / SparseStorage::kPageBytes * SparseStorage::kPageBytes;
    dmi.set_dmi_ptr(storage_.page(address));
    dmi.set_start_address(start);
    dmi.set_end_address(start + SparseStorage::kPageBytes - 1);
    dmi.set_read_latency(
        sc_core::sc_time::from_value((config_.timing.read_latency() + extra_) * ck_));
    dmi.set_write_latency(sc_core::sc_time::from_value((1 + extra_) * ck_));
    dmi.allow_read_write();
    return true;
}

unsigned int Lpddr5::debug(int /*socket*/, Payload& payload) {
    const std::uint64_t capacity = channels_.mapping().capacity();
    if ((!payload.is_read() && !payload.is_write()) || payload.get_address() >= capacity) {
        return 0;
    }
    const auto bytes = static_cast<unsigned int>(
        std::min<std::uint64_t>(payload.get_data_length(), capacity - payload.get_address()));
    if (payload.is_write()) {
        storage_.write(payload.get_address(), payload.get_data_ptr(), bytes);
    } else {
        storage_.read(payload.get_address(), payload.get_data_ptr(), bytes);
    }
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    return bytes;
}

Lpddr5::Stats Lpddr5::total() const {
    Stats sum;
    for (const Stats& each : stats_) {
        sum.reads += each.reads;
        sum.writes += each.writes;
        sum.bytes_read += each.bytes_read;
        sum.bytes_written += each.bytes_written;
        sum.read_latency.add(each.read_latency);
        sum.write_latency.add(each.write_latency);
        sum.last_answer = std::max(sum.last_answer, each.last_answer);
    }
    return sum;
}

Ck Lpddr5::settle(std::uint64_t date) {
    if (date == 0) {
        return 0;
    }
    advance(date - 1);
    const Ck known = (date - 1) / ck_;
    channels_.settle(known);
    plan_answers();
    schedule();
    return known + 1;
}

Channel::Stats Lpddr5::commands(const sc_core::sc_time& until) {
    settle(until.value());
    Channel::Stats sum;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        sum.add(channels_[c].stats());
    }
    return sum;
}

TransferAccount Lpddr5::transfers(const sc_core::sc_time& until) {
    const Channel::Stats stats = commands(until);
    const std::uint64_t burst = config_.timing.burst_bytes();
    TransferAccount bytes;
    bytes.on_bus = burst * stats.column_commands();
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        bytes.queued += burst * channels_[c].bursts_left();
    }
    bytes.merged = burst * stats.merged_bursts;
    bytes.forwarded = burst * stats.forwarded_bursts;
    return bytes;
}

Activity Lpddr5::activity(const sc_core::sc_time& until) {
    Activity activity;
    activity.all = commands(until);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        activity.channel_bytes.push_back(config_.timing.burst_bytes() *
                                         channels_[c].stats().column_commands());
    }
    return activity;
}

Energy Lpddr5::energy(const sc_core::sc_time& until) {
    const Ck elapsed = settle(until.value());
    Energy sum;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        sum.add(config_.energy, config_.timing, channels_[c], elapsed);
    }
    return sum;
}

void Lpddr5::observe(const std::function<void(unsigned, const Issued&)>& observer) {
    for (unsigned c = 0; c < channels_.size(); ++c) {
        channels_[c].observe([observer, c](const Issued& issued) { observer(c, issued); });
    }
}

} // namespace degs::dram
