// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

namespace degs {

/// Stands before an LT memory that serves transactions in the order of the calls, and makes that
/// order the order of their dates (kernel time plus annotated delay), however far its masters run
/// ahead of the kernel. Header only.
///
/// A master may bring an access of any date from now on, so nobody can be sure that an access is
/// the oldest before the kernel has reached its date. Each access waits until then, plus two delta
/// cycles, because an edge of an sc_clock reaches a process in the delta cycle after its date.
/// Accesses that are there by then with equal dates go on in the order of the sockets, those of one
/// socket in the order of their calls. The memory sees a delay of zero; what it annotates, and the
/// time that it waits itself, reach the master as they are. It may wait for one access while it
/// takes in others.
///
/// Debug transport passes at once. Direct memory access is refused, because it has no dates; the
/// hint that allows it is taken out of the answers.
template <unsigned int BITS = 32>
class DateSorter : public sc_core::sc_module {
public:
    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<DateSorter, BITS>> in;
    tlm_utils::simple_initiator_socket<DateSorter, BITS> out;

    DateSorter(const sc_core::sc_module_name& name, std::size_t masters)
        : sc_core::sc_module(name), in("in", masters), out("out") {
        int socket = 0;
        for (auto& each : in) {
            each.register_b_transport(this, &DateSorter::transport, socket);
            each.register_transport_dbg(this, &DateSorter::debug, socket++);
        }
    }

private:
    using Payload = tlm::tlm_generic_payload;

    /// The place of an access among those of the present date, left even by a thread that is
    /// killed.
    class Place {
    public:
        Place(DateSorter& sorter, int socket, std::uint64_t call)
            : sorter_(sorter), place_(sorter.due_.insert(std::make_pair(socket, call)).first) {}
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;
        ~Place() {
            sorter_.due_.erase(place_);
            if (!sorter_.due_.empty()) {
                sorter_.next_.notify(sc_core::SC_ZERO_TIME);
            }
        }
        bool first() const { return place_ == sorter_.due_.begin(); }

    private:
        DateSorter& sorter_;
        std::set<std::pair<int, std::uint64_t>>::iterator place_;
    };

    void transport(int socket, Payload& payload, sc_core::sc_time& delay) {
        await_turn(socket, delay);
        delay = sc_core::SC_ZERO_TIME;
        out->b_transport(payload, delay);
        payload.set_dmi_allowed(false);
    }
    void await_turn(int socket, const sc_core::sc_time& delay) {
        const std::uint64_t call = calls_++;
        if (delay > sc_core::SC_ZERO_TIME) {
            sc_core::wait(delay);
        }
        const Place place(*this, socket, call);
        sc_core::wait(sc_core::SC_ZERO_TIME);
        sc_core::wait(sc_core::SC_ZERO_TIME);
        while (!place.first()) {
            sc_core::wait(next_);
        }
    }
    unsigned int debug(int /*socket*/, Payload& payload) { return out->transport_dbg(payload); }

    std::set<std::pair<int, std::uint64_t>> due_; // socket and number of the call
    std::uint64_t calls_ = 0;
    sc_core::sc_event next_;
};

} // namespace degs
