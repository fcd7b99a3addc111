// SPDX-License-Identifier: Apache-2.0
// The most common model of a shared memory: annotated LT, busy until the transfer before is over.
#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "tlm/has_process.hpp"

namespace degs::test {

/// Serves transactions in the order of the calls, whatever their annotated dates; never waits.
class BusyMemory : public sc_core::sc_module {
public:
    static constexpr double kBytesPerNs = 204.8, kLatencyNs = 50;
    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<BusyMemory>> in;
    std::vector<unsigned char> bytes;
    sc_core::sc_time most_ahead; ///< largest annotation that came in
    std::function<void()> on_access;

    BusyMemory(const sc_core::sc_module_name& name, std::size_t size, std::size_t initiators)
        : sc_core::sc_module(name), in("in", initiators), bytes(size, 0xA5) {
        int tag = 0;
        for (auto& socket : in) {
            socket.register_b_transport(this, &BusyMemory::transport, tag);
            socket.register_transport_dbg(this, &BusyMemory::debug, tag++);
        }
    }

private:
    unsigned int debug(int /*tag*/, tlm::tlm_generic_payload& payload) {
        unsigned char* const here = bytes.data() + payload.get_address();
        const bool read = payload.is_read();
        std::memcpy(read ? payload.get_data_ptr() : here, read ? here : payload.get_data_ptr(),
                    payload.get_data_length());
        return payload.get_data_length();
    }
    void transport(int tag, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
        if (on_access) {
            on_access();
        }
        most_ahead = std::max(most_ahead, delay);
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        busy_until_ = std::max(busy_until_, now + delay) +
                      sc_core::sc_time(payload.get_data_length() / kBytesPerNs, sc_core::SC_NS);
        delay = busy_until_ + sc_core::sc_time(kLatencyNs, sc_core::SC_NS) - now;
        debug(tag, payload);
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
    sc_core::sc_time busy_until_;
};

/// A processor that reads `lines` lines of 64 B, one every `period_ns`, and waits for each; from
/// the start of the simulation on, or from `begin`.
class LineReader : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<LineReader> out;
    std::vector<double> latencies; ///< ns, in order

    LineReader(const sc_core::sc_module_name& name, int lines, double period_ns = 100,
               const sc_core::sc_event* begin = nullptr)
        : sc_core::sc_module(name), out("out"), lines_(lines), period_(period_ns, sc_core::SC_NS),
          begin_(begin) {
        DEGS_HAS_PROCESS(LineReader);
        SC_THREAD(run);
    }
    double worst() const {
        return latencies.empty() ? 0 : *std::max_element(latencies.begin(), latencies.end());
    }

private:
    void run() {
        if (begin_ != nullptr) {
            sc_core::wait(*begin_);
        }
        const sc_core::sc_time zero = sc_core::sc_time_stamp();
        for (int line = 1; line <= lines_; ++line) {
            const sc_core::sc_time due = zero + line * period_;
            if (due > sc_core::sc_time_stamp()) {
                sc_core::wait(due - sc_core::sc_time_stamp());
            }
            unsigned char data[64];
            tlm::tlm_generic_payload payload;
            payload.set_command(tlm::TLM_READ_COMMAND);
            payload.set_address(0);
            payload.set_data_ptr(data);
            payload.set_data_length(sizeof data);
            payload.set_streaming_width(sizeof data);
            const sc_core::sc_time begin = sc_core::sc_time_stamp();
            sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
            out->b_transport(payload, delay);
            sc_core::wait(delay);
            latencies.push_back((sc_core::sc_time_stamp() - begin) /
                                sc_core::sc_time(1, sc_core::SC_NS));
        }
    }
    int lines_;
    sc_core::sc_time period_;
    const sc_core::sc_event* begin_;
};

} // namespace degs::test
