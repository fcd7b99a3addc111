// SPDX-License-Identifier: Apache-2.0
// AT and LT initiators for the LPDDR5 module; the AT one checks the base protocol.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "degs/request_info.hpp"
#include "dram/lpddr5.hpp"
#include "tests/dram/fixture.hpp"
#include "tests/tlm/memory_fixture.hpp"
#include "tlm/has_process.hpp"

namespace degs::test {

/// Sends a list of requests by the four-phase protocol, each not before its date, and expects what
/// the protocol promises: END_REQ before the next BEGIN_REQ, one BEGIN_RESP at a time, one answer.
class AtInitiator : public sc_core::sc_module, tlm::tlm_mm_interface {
public:
    enum class Ending { Completed, Updated, Accepted }; ///< how BEGIN_RESP is answered
    struct Request {
        std::uint64_t date_ps = 0;
        std::uint64_t address = 0;
        unsigned bytes = 64;
        bool write = false;
        std::uint64_t annotated_ps = 0; ///< BEGIN_REQ is sent that much before the date
        // Filled in:
        std::uint64_t begun_ps = 0, accepted_ps = 0, answered_ps = 0;
        int answers = 0;
        std::vector<unsigned char> data;
    };
    tlm_utils::simple_initiator_socket<AtInitiator> out;
    std::vector<Request> requests;
    unsigned qos = 0; ///< of all requests
    Ending ending = Ending::Completed;
    std::uint64_t response_ps = 0; ///< BEGIN_RESP to END_RESP
    int outstanding_most = 0;

    explicit AtInitiator(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), out("out") {
        DEGS_HAS_PROCESS(AtInitiator);
        out.register_nb_transport_bw(this, &AtInitiator::backward);
        SC_THREAD(send);
        SC_METHOD(end_response);
        sensitive << response_event_;
        dont_initialize();
    }

private:
    static std::uint64_t now() { return sc_core::sc_time_stamp().value(); }

    void send() {
        for (std::size_t i = 0; i < requests.size(); ++i) {
            Request& request = requests[i];
            const std::uint64_t start = request.date_ps - request.annotated_ps;
            if (start > now()) {
                sc_core::wait(sc_core::sc_time::from_value(start - now()));
            }
            auto* payload = new tlm::tlm_generic_payload(this);
            payload->acquire();
            auto* info = new RequestInfo; // which goes with the payload
            info->qos = qos;
            payload->set_extension(info);
            request.data.resize(request.bytes);
            Initiator::fill(*payload,
                            request.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND,
                            request.address, request.data.data(), request.bytes);
            tlm::tlm_phase phase = tlm::BEGIN_REQ;
            sc_core::sc_time delay = sc_core::sc_time::from_value(request.annotated_ps);
            request.begun_ps = now() + request.annotated_ps;
            of_[payload] = i;
            requesting_ = payload;
            outstanding_most = std::max(outstanding_most, ++outstanding_);
            const auto answer = out->nb_transport_fw(*payload, phase, delay);
            if (answer == tlm::TLM_UPDATED) {
                ASSERT_EQ(phase, tlm::END_REQ);
                end_request(now() + delay.value());
            } else {
                ASSERT_EQ(answer, tlm::TLM_ACCEPTED);
            }
            while (requesting_ != nullptr) {
                sc_core::wait(request_event_);
            }
        }
    }
    void end_request(std::uint64_t date) {
        ASSERT_NE(requesting_, nullptr) << "END_REQ without a request";
        requests[of_[requesting_]].accepted_ps = date;
        requesting_ = nullptr;
        request_event_.notify(sc_core::SC_ZERO_TIME);
    }
    tlm::tlm_sync_enum backward(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                sc_core::sc_time& delay) {
        if (phase == tlm::END_REQ) {
            EXPECT_EQ(requesting_, &payload);
            end_request(now() + delay.value());
            return tlm::TLM_ACCEPTED;
        }
        EXPECT_EQ(phase, tlm::BEGIN_RESP);
        EXPECT_EQ(responding_, nullptr) << "BEGIN_RESP before the END_RESP of the last one";
        EXPECT_NE(requesting_, &payload) << "BEGIN_RESP before END_REQ";
        EXPECT_GE(now() + delay.value(), resume_ps_);
        Request& request = requests[of_.at(&payload)];
        EXPECT_EQ(++request.answers, 1);
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_OK_RESPONSE);
        request.answered_ps = now() + delay.value();
        --outstanding_;
        resume_ps_ = now() + response_ps;
        if (ending == Ending::Completed) {
            resume_ps_ = now();
            payload.release();
            return tlm::TLM_COMPLETED;
        }
        if (ending == Ending::Updated) {
            phase = tlm::END_RESP;
            delay = sc_core::sc_time::from_value(response_ps);
            payload.release();
            return tlm::TLM_UPDATED;
        }
        responding_ = &payload;
        response_event_.notify(sc_core::sc_time::from_value(response_ps));
        return tlm::TLM_ACCEPTED;
    }
    void end_response() {
        tlm::tlm_generic_payload* payload = std::exchange(responding_, nullptr);
        tlm::tlm_phase phase = tlm::END_RESP;
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        out->nb_transport_fw(*payload, phase, delay);
        payload->release();
    }
    void free(tlm::tlm_generic_payload* payload) override {
        of_.erase(payload);
        delete payload;
    }

    std::map<tlm::tlm_generic_payload*, std::size_t> of_;
    tlm::tlm_generic_payload* requesting_ = nullptr;
    tlm::tlm_generic_payload* responding_ = nullptr;
    std::uint64_t resume_ps_ = 0;
    int outstanding_ = 0;
    sc_core::sc_event request_event_, response_event_;
};

/// A memory with AT initiators, then LT ones.
struct Lpddr5Bench {
    dram::Lpddr5 memory;
    std::vector<std::unique_ptr<AtInitiator>> at;
    std::vector<std::unique_ptr<Initiator>> lt;
    Lpddr5Bench(const dram::Config& config, std::size_t at_count, std::size_t lt_count,
                const Timebase& time = {})
        : memory("memory", config, time, at_count + lt_count) {
        for (std::size_t i = 0; i < at_count; ++i) {
            at.push_back(std::make_unique<AtInitiator>(("at" + std::to_string(i)).c_str()));
            at.back()->out.bind(memory.in[i]);
        }
        for (std::size_t i = 0; i < lt_count; ++i) {
            lt.push_back(std::make_unique<Initiator>(("lt" + std::to_string(i)).c_str()));
            lt.back()->out.bind(memory.in[at_count + i]);
        }
    }
};

} // namespace degs::test
