// SPDX-License-Identifier: Apache-2.0
// A target that keeps to the protocol of gem5's TlmToGem5Bridge and of the memory system behind it.
#pragma once

#include <cstring>
#include <deque>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>
#include <tlm_utils/peq_with_cb_and_phase.h>

namespace degs::test {

/// In timing mode (AT): a request goes to a port that is busy now and then, and END_REQ is sent
/// when the port has taken it. A response waits until the one before has ended, by END_RESP or by
/// what BEGIN_RESP returns. Every phase that comes in takes a reference to the payload; that of
/// BEGIN_REQ is given back after BEGIN_RESP, that of END_RESP never. Byte enables are refused. In
/// atomic mode (LT): byte enables are not looked at. In both an error is a command error, and an
/// access must not cross a line of a cache.
class Gem5Bridge : public sc_core::sc_module, public tlm::tlm_fw_transport_if<> {
public:
    using Payload = tlm::tlm_generic_payload;
    static constexpr std::uint64_t kLine = 64;
    tlm::tlm_target_socket<> in;
    std::vector<unsigned char> bytes;
    sc_core::sc_time latency{50, sc_core::SC_NS};
    sc_core::sc_time response_delay = sc_core::SC_ZERO_TIME; ///< annotated at BEGIN_RESP
    bool gives_back = false;                                 ///< the reference of END_RESP, too
    std::uint64_t refused_from = ~std::uint64_t{0}; ///< accesses that reach this address fail
    std::uint64_t requests = 0, kept = 0;           ///< `kept`: references of END_RESP
    std::set<const Payload*> payloads;              ///< all that ever came in

    Gem5Bridge(const sc_core::sc_module_name& name, std::size_t size)
        : sc_core::sc_module(name), in("in"), bytes(size, 0xA5),
          phases_("phases", this, &Gem5Bridge::reach), port_("port", this, &Gem5Bridge::proceed) {
        in.bind(*this);
    }

    void b_transport(Payload& payload, sc_core::sc_time& delay) override {
        move(payload);
        delay += latency;
    }
    bool get_direct_mem_ptr(Payload& /*payload*/, tlm::tlm_dmi& /*dmi*/) override { return false; }
    unsigned int transport_dbg(Payload& payload) override {
        copy(payload);
        return payload.get_data_length();
    }
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (payload.get_byte_enable_ptr() != nullptr) {
            payload.set_response_status(tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
            return tlm::TLM_COMPLETED;
        }
        EXPECT_GE(payload.get_streaming_width(), payload.get_data_length());
        payload.acquire();
        phases_.notify(payload, phase, delay);
        return tlm::TLM_ACCEPTED;
    }

private:
    // A phase of the initiator, at its date.
    void reach(Payload& payload, const tlm::tlm_phase& phase) {
        if (phase == tlm::END_RESP) {
            EXPECT_TRUE(responding_);
            responding_ = false;
            gives_back ? payload.release() : void(++kept);
            respond();
            return;
        }
        EXPECT_FALSE(requesting_) << "BEGIN_REQ before the END_REQ of the last one";
        payloads.insert(&payload);
        requesting_ = true;
        const bool busy = ++requests % 3 == 0;
        port_.notify(payload, tlm::END_REQ,
                     busy ? sc_core::sc_time(5, sc_core::SC_NS) : sc_core::SC_ZERO_TIME);
    }
    // What the port does with a request: takes it, or answers it.
    void proceed(Payload& payload, const tlm::tlm_phase& phase) {
        if (phase == tlm::END_REQ) {
            requesting_ = false;
            port_.notify(payload, tlm::BEGIN_RESP, latency);
            EXPECT_EQ(send(payload, phase, sc_core::SC_ZERO_TIME), tlm::TLM_ACCEPTED);
        } else {
            due_.push_back(&payload);
            respond();
        }
    }
    void respond() {
        while (!responding_ && !due_.empty()) {
            Payload& payload = *due_.front();
            due_.pop_front();
            move(payload);
            responding_ = send(payload, tlm::BEGIN_RESP, response_delay) == tlm::TLM_ACCEPTED;
            payload.release();
        }
    }
    tlm::tlm_sync_enum send(Payload& payload, tlm::tlm_phase phase, sc_core::sc_time delay) {
        return in->nb_transport_bw(payload, phase, delay);
    }
    void move(Payload& payload) {
        const std::uint64_t end = payload.get_address() + payload.get_data_length();
        EXPECT_LE(payload.get_address() % kLine + payload.get_data_length(), kLine);
        const bool good = end <= bytes.size() && end <= refused_from;
        payload.set_response_status(good ? tlm::TLM_OK_RESPONSE : tlm::TLM_COMMAND_ERROR_RESPONSE);
        if (good) {
            copy(payload);
        }
    }
    void copy(Payload& payload) {
        unsigned char* const here = bytes.data() + payload.get_address();
        const bool read = payload.is_read();
        std::memcpy(read ? payload.get_data_ptr() : here, read ? here : payload.get_data_ptr(),
                    payload.get_data_length());
    }

    tlm_utils::peq_with_cb_and_phase<Gem5Bridge> phases_, port_;
    std::deque<Payload*> due_;
    bool requesting_ = false;
    bool responding_ = false;
};

} // namespace degs::test
