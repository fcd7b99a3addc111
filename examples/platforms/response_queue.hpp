// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include <systemc>
#include <tlm>
#include <tlm_utils/peq_with_cb_and_phase.h>

namespace degs {

/// Stands before an AT target that should not be sent END_RESP, such as gem5's bridge, which takes
/// a reference to the payload then and never gives it back. Header only.
///
/// BEGIN_RESP is answered with TLM_COMPLETED at once, whatever its date, so the target goes on to
/// its next response. Responses reach the initiator at their dates, one at a time, each after the
/// END_RESP of the one before, which ends here. So they take no time of the target, and as many
/// wait here as the initiator has transactions in flight. All other calls go through as they are.
///
/// Not modelled: a target that answers in the return of BEGIN_REQ. Its response and the END_RESP
/// go through, too.
template <unsigned int BITS = 32>
class ResponseQueue : public sc_core::sc_module,
                      public tlm::tlm_fw_transport_if<>,
                      public tlm::tlm_bw_transport_if<> {
public:
    tlm::tlm_target_socket<BITS> in;
    tlm::tlm_initiator_socket<BITS> out;

    explicit ResponseQueue(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in"), out("out"),
          phases_("phases", this, &ResponseQueue::reach) {
        in.bind(*this);
        out.bind(*this);
    }

private:
    using Payload = tlm::tlm_generic_payload;

    void b_transport(Payload& payload, sc_core::sc_time& delay) override {
        out->b_transport(payload, delay);
    }
    bool get_direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi) override {
        return out->get_direct_mem_ptr(payload, dmi);
    }
    unsigned int transport_dbg(Payload& payload) override { return out->transport_dbg(payload); }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        in->invalidate_direct_mem_ptr(first, last);
    }
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (phase == tlm::END_RESP && &payload == responding_) {
            phases_.notify(payload, phase, delay);
            return tlm::TLM_COMPLETED;
        }
        return out->nb_transport_fw(payload, phase, delay);
    }
    tlm::tlm_sync_enum nb_transport_bw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (phase != tlm::BEGIN_RESP) {
            return in->nb_transport_bw(payload, phase, delay);
        }
        payload.acquire();
        phases_.notify(payload, phase, delay);
        return tlm::TLM_COMPLETED;
    }
    // At the date of a phase.
    void reach(Payload& payload, const tlm::tlm_phase& phase) {
        if (phase == tlm::BEGIN_RESP) {
            due_.push_back(&payload);
        } else {
            responding_ = nullptr;
            payload.release();
        }
        if (responding_ == nullptr && !due_.empty()) {
            responding_ = due_.front();
            due_.pop_front();
            respond(*responding_);
        }
    }
    void respond(Payload& payload) {
        tlm::tlm_phase phase = tlm::BEGIN_RESP;
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        if (in->nb_transport_bw(payload, phase, delay) != tlm::TLM_ACCEPTED) {
            phases_.notify(payload, tlm::END_RESP, delay);
        }
    }

    tlm_utils::peq_with_cb_and_phase<ResponseQueue> phases_;
    std::deque<Payload*> due_;
    Payload* responding_ = nullptr; // the one whose response phase is not over
};

} // namespace degs
