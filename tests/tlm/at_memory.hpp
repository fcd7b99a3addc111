// SPDX-License-Identifier: Apache-2.0
// A memory of somebody else that knows the four phases only, and complains of every initiator that
// breaks the base protocol.
#pragma once

#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>
#include <tlm_utils/peq_with_get.h>

#include "tlm/has_process.hpp"
#include "tlm/urgent.hpp"

namespace degs::test {

/// How a transaction ends. `Four`: END_REQ, later BEGIN_RESP. `RequestAtOnce`: END_REQ is what
/// BEGIN_REQ returns. `NoEndReq`: BEGIN_RESP ends the request, too. `AnswerAtOnce`: BEGIN_RESP
/// is what BEGIN_REQ returns, if no other answer is in flight. `Completed`: TLM_COMPLETED.
/// `Mixed`: all of them in turn.
enum class Ending { Four, RequestAtOnce, NoEndReq, AnswerAtOnce, Completed, Mixed };

inline std::string ending_name(const ::testing::TestParamInfo<Ending>& ending) {
    constexpr const char* kNames[] = {"Four",         "RequestAtOnce", "NoEndReq",
                                      "AnswerAtOnce", "Completed",     "Mixed"};
    return kNames[static_cast<std::size_t>(ending.param)];
}

/// Unlimited bandwidth: every transaction is answered `latency` after its BEGIN_REQ.
class AtMemory : public sc_core::sc_module, public tlm::tlm_fw_transport_if<> {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm::tlm_target_socket<> in;
    std::vector<unsigned char> bytes;
    Ending ending = Ending::Four;
    sc_core::sc_time latency{50, sc_core::SC_NS};
    sc_core::sc_time accept = sc_core::SC_ZERO_TIME; ///< BEGIN_REQ to END_REQ
    std::uint64_t refused_from = ~std::uint64_t{0};  ///< accesses that reach this address fail
    bool has_debug = true;
    bool out_of_order = false; ///< latencies of one to four times `latency`, in turn
    bool aligned_only =
        false; ///< complains of accesses that are not naturally aligned powers of two
    unsigned under_way = 0, most_under_way = 0;
    std::uint64_t requests = 0, longest = 0, urgent = 0;

    AtMemory(const sc_core::sc_module_name& name, std::size_t size)
        : sc_core::sc_module(name), in("in"), bytes(size, 0xA5), accepted_("accepted"),
          answers_("answers") {
        in.bind(*this);
        DEGS_HAS_PROCESS(AtMemory);
        SC_METHOD(end_requests);
        sensitive << accepted_.get_event();
        dont_initialize();
        SC_METHOD(begin_responses);
        sensitive << answers_.get_event() << response_over_;
        dont_initialize();
    }

    void b_transport(Payload& payload, sc_core::sc_time& /*delay*/) override {
        ADD_FAILURE() << "this memory has no b_transport()";
        payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
    }
    bool get_direct_mem_ptr(Payload& /*payload*/, tlm::tlm_dmi& /*dmi*/) override { return false; }
    unsigned int transport_dbg(Payload& payload) override {
        return has_debug && move(payload) ? payload.get_data_length() : 0;
    }
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        EXPECT_EQ(delay, sc_core::SC_ZERO_TIME);
        if (phase == tlm::BEGIN_REQ) {
            return begin_request(payload, phase, delay);
        }
        EXPECT_EQ(phase, tlm::END_RESP);
        EXPECT_EQ(&payload, responding_) << "END_RESP without BEGIN_RESP";
        EXPECT_EQ(sc_core::sc_time_stamp(), responding_date_);
        responding_ = nullptr;
        leave(payload);
        response_over_.notify(sc_core::SC_ZERO_TIME);
        return tlm::TLM_COMPLETED;
    }

private:
    tlm::tlm_sync_enum begin_request(Payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay) {
        EXPECT_EQ(requesting_, nullptr) << "BEGIN_REQ before the END_REQ of the last one";
        EXPECT_TRUE(payload.has_mm());
        EXPECT_EQ(payload.get_ref_count(), 1) << "the initiator's";
        EXPECT_FALSE(payload.is_dmi_allowed());
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_INCOMPLETE_RESPONSE);
        EXPECT_EQ(payload.get_streaming_width(), payload.get_data_length());
        const std::uint64_t length = payload.get_data_length();
        EXPECT_TRUE(!aligned_only ||
                    ((length & (length - 1)) == 0 && payload.get_address() % length == 0))
            << length << " bytes at " << payload.get_address();
        longest = std::max<std::uint64_t>(longest, payload.get_data_length());
        most_under_way = std::max(most_under_way, ++under_way);
        payload.acquire();
        const Ending how =
            ending == Ending::Mixed ? static_cast<Ending>(requests % 5) : ending; // Four..Completed
        const sc_core::sc_time here =
            latency * (out_of_order ? 4.0 - static_cast<double>(requests % 4) : 1.0);
        ++requests;
        urgent += payload.get_extension<Urgent>() != nullptr ? 1 : 0;
        if (how == Ending::Completed) {
            move(payload);
            leave(payload);
            delay = here;
            return tlm::TLM_COMPLETED;
        }
        if (how == Ending::AnswerAtOnce && responding_ == nullptr) {
            move(payload);
            respond(payload, here);
            phase = tlm::BEGIN_RESP;
            delay = here;
            return tlm::TLM_UPDATED;
        }
        answers_.notify(payload, here);
        if (how == Ending::RequestAtOnce) {
            phase = tlm::END_REQ;
            delay = accept;
            return tlm::TLM_UPDATED;
        }
        requesting_ = &payload;
        if (how != Ending::NoEndReq) {
            accepted_.notify(payload, accept);
        }
        return tlm::TLM_ACCEPTED;
    }
    void end_requests() {
        while (Payload* const payload = accepted_.get_next_transaction()) {
            if (requesting_ == payload) {
                requesting_ = nullptr;
                send(*payload, tlm::END_REQ);
            }
        }
    }
    void begin_responses() {
        while (Payload* const payload = answers_.get_next_transaction()) {
            due_.push_back(payload);
        }
        if (responding_ != nullptr || due_.empty()) {
            return;
        }
        Payload& payload = *due_.front();
        due_.pop_front();
        requesting_ = requesting_ == &payload ? nullptr : requesting_;
        move(payload);
        respond(payload, sc_core::SC_ZERO_TIME);
        send(payload, tlm::BEGIN_RESP);
    }
    void respond(Payload& payload, const sc_core::sc_time& delay) {
        responding_ = &payload;
        responding_date_ = sc_core::sc_time_stamp() + delay;
    }
    void send(Payload& payload, tlm::tlm_phase phase) {
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        EXPECT_EQ(in->nb_transport_bw(payload, phase, delay), tlm::TLM_ACCEPTED);
    }
    void leave(Payload& payload) {
        --under_way;
        payload.release();
    }
    bool move(Payload& payload) {
        const std::uint64_t end = payload.get_address() + payload.get_data_length();
        const bool good = end <= bytes.size() && end <= refused_from;
        payload.set_response_status(good ? tlm::TLM_OK_RESPONSE : tlm::TLM_ADDRESS_ERROR_RESPONSE);
        payload.set_dmi_allowed(good); // which initiators take back before the next request
        if (good) {
            unsigned char* const here = bytes.data() + payload.get_address();
            const unsigned char* const enables = payload.get_byte_enable_ptr();
            for (unsigned int i = 0; i < payload.get_data_length(); ++i) {
                if (enables == nullptr || enables[i % payload.get_byte_enable_length()] != 0) {
                    (payload.is_read() ? payload.get_data_ptr()[i] : here[i]) =
                        payload.is_read() ? here[i] : payload.get_data_ptr()[i];
                }
            }
        }
        return good;
    }

    tlm_utils::peq_with_get<Payload> accepted_, answers_;
    sc_core::sc_event response_over_;
    Payload* requesting_ = nullptr;
    Payload* responding_ = nullptr;
    sc_core::sc_time responding_date_;
    std::deque<Payload*> due_;
};

} // namespace degs::test
