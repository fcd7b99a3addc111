// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "degs/options.hpp"
#include "degs/request_info.hpp"
#include "modules/kit/memory/main_memory.hpp"
#include "platform/access_pacer.hpp"
#include "platform/at_requester.hpp"
#include "platform/burst_cutter.hpp"
#include "platform/in_flight.hpp"
#include "platform/stalled_accesses.hpp"

namespace degs {

/// Sends all streams of an accelerator through one TLM-2.0 initiator socket, for memory that
/// belongs to a platform: every access moves real bytes, and the platform arbitrates. Scattered
/// records go out as ordinary transactions at their own addresses, one per run of bytes. Every
/// transaction carries its RequestInfo. An access that the platform refuses is counted as an error
/// and then treated as done: an accelerator ends its frame and reports the error in a register, and
/// the simulation goes on. With RefusedAccess::Stall the transaction waits in stalled() instead.
class MemoryGateway : public sc_core::sc_module, public MainMemory {
public:
    using Options = AcceleratorOptions::Memory;

    tlm_utils::simple_initiator_socket<MemoryGateway> out;

    /// What is wrong with options, as a sentence without its end; empty if nothing is.
    static std::string problem(const Options& options);

    explicit MemoryGateway(const sc_core::sc_module_name& name);
    /// `clock` is that of the streams. Throws std::invalid_argument if an option is out of range.
    MemoryGateway(const sc_core::sc_module_name& name, const Options& options,
                  const ClockDomain& clock = ClockDomain(1.0));

    /// Is called with the bytes that streams of the scene read, see
    /// MemoryPort::observe_reads(). Set it before connect().
    using Observer = MemoryPort::Observer;
    void observe_scene(Observer observer) { scene_ = std::move(observer); }

    void connect(const std::vector<MemoryStream>& streams) override;
    MemoryTraffic traffic(std::size_t initiator) const override { return traffic_[initiator]; }
    double peak_gb_per_s() const override { return 0; }
    std::vector<std::string> explain() const override;

    /// The sums of the counters of all streams.
    MemoryTraffic total() const;

    /// Performs an access that belongs to no stream. It is not counted and keeps its response. Must
    /// be called from a thread, like debug().
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(tlm::tlm_generic_payload& payload) { return out->transport_dbg(payload); }

    /// The requester for AT; nullptr with LT.
    const AtRequester* requester() const { return requester_.get(); }

    /// Accesses that the platform refused since the last clear_errors().
    std::uint64_t errors() const { return errors_; }
    tlm::tlm_response_status first_error() const { return first_error_; }
    void clear_errors() {
        errors_ = 0;
        first_error_ = tlm::TLM_OK_RESPONSE;
    }

    /// Refused transactions that wait; none unless the options say so.
    StalledAccesses& stalled() { return stalled_; }

    /// Stops touching the platform's memory. Transactions that are on the bus end in their own
    /// time; every other access is answered at once, as if it had been done, until attach().
    void detach();
    void attach();
    bool detached() const { return detached_; }
    /// True if no access of a process is under way.
    bool idle() const { return under_way_ == 0; }
    /// Notified when idle() becomes true while detached.
    const sc_core::sc_event& became_idle() const { return became_idle_; }
    /// The latest date at which a transaction has ended, by its answer and its annotated delay.
    const sc_core::sc_time& last_answer() const { return last_answer_; }

private:
    using Pieces = std::vector<AccessPiece>;
    Pieces cut(const tlm::tlm_generic_payload& access) const {
        return cut_into_bursts(access, options_);
    }
    std::uint64_t bus_bytes(const tlm::tlm_generic_payload& access) const;
    bool is_one_transaction(const tlm::tlm_generic_payload& access) const;
    void serve(int port, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    void access(unsigned rank, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    std::shared_ptr<LateAnswer> start(int port, const tlm::tlm_generic_payload& payload);
    void note(tlm::tlm_response_status status);
    void end_access(const sc_core::sc_time& delay);
    tlm::tlm_sync_enum backward(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                sc_core::sc_time& delay);
    unsigned int debug_of(int port, tlm::tlm_generic_payload& payload);
    void send(unsigned rank, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    bool await_resume(const tlm::tlm_generic_payload& refused, const sc_core::sc_time& delay);
    void access_pieces(unsigned rank, tlm::tlm_generic_payload& payload, const Pieces& pieces,
                       sc_core::sc_time& delay);
    sc_core::sc_time await_room(unsigned rank, const sc_core::sc_time& date);

    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<MemoryGateway>> in_;
    Options options_;
    ClockDomain clock_;
    AccessPacer pacer_;
    InFlight in_flight_; // LT
    StalledAccesses stalled_;
    std::unique_ptr<AtRequester> requester_;
    std::vector<MemoryTraffic> traffic_;
    std::vector<bool> of_scene_;         // by stream
    std::vector<RequestStream> streams_; // likewise
    Observer scene_;
    bool detached_ = false;
    unsigned under_way_ = 0;
    sc_core::sc_event became_idle_;
    sc_core::sc_time last_answer_;
    std::uint64_t errors_ = 0;
    tlm::tlm_response_status first_error_ = tlm::TLM_OK_RESPONSE;
};

} // namespace degs
