// SPDX-License-Identifier: Apache-2.0
// What leaves the memory socket of an accelerator, transaction by transaction.
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>

#include "degs/request_info.hpp"

namespace degs::test {

struct SeenTransaction {
    std::uint64_t address = 0, bytes = 0;
    bool write = false;
    RequestStream stream = RequestStream::Other;
    std::uint32_t qos = 0;
    std::uint64_t end() const { return address + bytes; }
};

/// Passes every call on as it is, in both directions, and records the transactions. Keeps those of
/// the four phases for as long as it may, and looks at their extension once more then.
class TransactionRecorder : public sc_core::sc_module,
                            public tlm::tlm_fw_transport_if<>,
                            public tlm::tlm_bw_transport_if<> {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm::tlm_target_socket<> in;
    tlm::tlm_initiator_socket<> out;
    std::vector<SeenTransaction> seen;

    explicit TransactionRecorder(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in"), out("out") {
        in.bind(*this);
        out.bind(*this);
    }

private:
    void record(const Payload& payload) {
        const auto* const info = payload.get_extension<RequestInfo>();
        ASSERT_NE(info, nullptr);
        seen.push_back({payload.get_address(), payload.get_data_length(), payload.is_write(),
                        info->stream, info->qos});
    }
    void b_transport(Payload& payload, sc_core::sc_time& delay) override {
        record(payload);
        const std::size_t index = seen.size() - 1;
        out->b_transport(payload, delay);
        expect(payload, seen[index]);
    }
    static void expect(const Payload& payload, const SeenTransaction& transaction) {
        const auto* const info = payload.get_extension<RequestInfo>();
        ASSERT_NE(info, nullptr);
        EXPECT_EQ(info->stream, transaction.stream);
        EXPECT_EQ(info->qos, transaction.qos);
    }
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (phase != tlm::BEGIN_REQ) {
            return out->nb_transport_fw(payload, phase, delay);
        }
        record(payload);
        const std::size_t index = seen.size() - 1;
        const tlm::tlm_sync_enum answer = out->nb_transport_fw(payload, phase, delay);
        payload.acquire();
        held_.emplace_back(&payload, index);
        if (held_.size() > kHeld) { // answered by now, and sent away by its initiator
            expect(*held_.front().first, seen[held_.front().second]);
            held_.front().first->release();
            held_.pop_front();
        }
        return answer;
    }
    tlm::tlm_sync_enum nb_transport_bw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        return in->nb_transport_bw(payload, phase, delay);
    }
    bool get_direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi) override {
        return out->get_direct_mem_ptr(payload, dmi);
    }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        in->invalidate_direct_mem_ptr(first, last);
    }
    unsigned int transport_dbg(Payload& payload) override { return out->transport_dbg(payload); }

    static constexpr std::size_t kHeld = 500;
    std::deque<std::pair<Payload*, std::size_t>> held_; // and their places in `seen`
};

} // namespace degs::test
