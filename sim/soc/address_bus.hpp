// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

namespace degs::sim {

/// Routes LT and debug transactions of N initiators by address to windows. A window is a target
/// with a socket of its own for every initiator (a memory that arbitrates by itself) or one for
/// all. The target sees addresses relative to its window; an access that no window holds as a whole
/// is an address error. Not modelled: time. The bus has no latency and no limit of bandwidth, so
/// all waiting happens in the target.
class AddressBus : public sc_core::sc_module {
public:
    struct Window {
        std::uint64_t begin = 0, bytes = 0;
        bool per_initiator = false; ///< a socket for each initiator
    };

    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<AddressBus>> in;
    sc_core::sc_vector<tlm_utils::simple_initiator_socket<AddressBus>> out;

    AddressBus(const sc_core::sc_module_name& name, std::size_t initiators,
               const std::vector<Window>& windows);

    /// Index into `out` of the socket for an initiator's transactions to a window; initiator 0
    /// if the window has only one.
    std::size_t socket_of(std::size_t window, std::size_t initiator = 0) const {
        return first_[window] + (windows_[window].per_initiator ? initiator : 0);
    }

private:
    void transport(int initiator, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(int initiator, tlm::tlm_generic_payload& payload);
    const Window* window_of(const tlm::tlm_generic_payload& payload) const;

    std::vector<Window> windows_;
    std::vector<std::size_t> first_; // socket of each window
};

} // namespace degs::sim
