// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "tlm/memory_port.hpp"

namespace degs {

/// All streams of an accelerator through one TLM-2.0 initiator socket, for memory that belongs to a
/// platform: every access moves real bytes, and the platform arbitrates. An access that the
/// platform refuses is remembered and then counts as done: an accelerator ends its frame and says
/// so in a register, it does not end the simulation.
class MemoryGateway : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<MemoryGateway> out;

    explicit MemoryGateway(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), out("out"), in_("in") {}

    /// Called with what is read of the scene, see MemoryPort::observe_reads(). Before connect().
    using Observer = MemoryPort::Observer;
    void observe_scene(Observer observer) { scene_ = std::move(observer); }

    /// Binds the ports of an accelerator; once, during elaboration. `streams`: their names.
    void connect(const std::vector<MemoryPort*>& ports, const std::vector<const char*>& streams);

    /// A part of memory that belongs to the accelerator.
    struct Region {
        std::uint64_t begin = 0, bytes = 0;
    };
    /// An access that starts in a region and is longer than what is left of it goes on at the
    /// region's start: blocks fetch scattered records as one run of as many bytes, which may be
    /// longer than a small array, and must not touch what is not theirs. At any time.
    void set_regions(std::vector<Region> regions) { regions_ = std::move(regions); }

    struct Stats {
        std::uint64_t reads = 0, writes = 0;
        std::uint64_t bytes_read = 0, bytes_written = 0;
    };
    /// Of one port, in the order of connect().
    const Stats& stats(std::size_t port) const { return stats_[port]; }

    Stats total() const;

    /// Accesses that the platform refused since the last clear_errors().
    std::uint64_t errors() const { return errors_; }
    tlm::tlm_response_status first_error() const { return first_error_; }
    void clear_errors() {
        errors_ = 0;
        first_error_ = tlm::TLM_OK_RESPONSE;
    }

private:
    void transport(int port, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(int port, tlm::tlm_generic_payload& payload);
    std::uint64_t piece_at(std::uint64_t address, std::uint64_t bytes) const;
    std::uint64_t start_of(std::uint64_t address) const;
    void fold(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);

    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<MemoryGateway>> in_;
    std::vector<Stats> stats_;
    Observer scene_;
    std::vector<Region> regions_;
    std::uint64_t errors_ = 0;
    tlm::tlm_response_status first_error_ = tlm::TLM_OK_RESPONSE;
};

} // namespace degs
