// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <tlm>

namespace degs {

/// Joins sockets of two bus widths in bits, which TLM-2.0 does not let bind to each other. Every
/// call goes through as it is, in both directions and in no time: payloads have a length of their
/// own, and what a bus of some width costs is the business of the target. Header only.
template <unsigned int FROM, unsigned int TO>
class BusWidth : public sc_core::sc_module,
                 public tlm::tlm_fw_transport_if<>,
                 public tlm::tlm_bw_transport_if<> {
public:
    tlm::tlm_target_socket<FROM> in;
    tlm::tlm_initiator_socket<TO> out;

    explicit BusWidth(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in"), out("out") {
        in.bind(*this);
        out.bind(*this);
    }

private:
    using Payload = tlm::tlm_generic_payload;

    void b_transport(Payload& payload, sc_core::sc_time& delay) override {
        out->b_transport(payload, delay);
    }
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        return out->nb_transport_fw(payload, phase, delay);
    }
    bool get_direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi) override {
        return out->get_direct_mem_ptr(payload, dmi);
    }
    unsigned int transport_dbg(Payload& payload) override { return out->transport_dbg(payload); }
    tlm::tlm_sync_enum nb_transport_bw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        return in->nb_transport_bw(payload, phase, delay);
    }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        in->invalidate_direct_mem_ptr(first, last);
    }
};

} // namespace degs
