// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <degs/scene.hpp>
#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>

/// Puts a scene into memory before the simulation begins, and tells the firmware where it is: the
/// work of a boot loader, in no time.
class Loader : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<Loader> out{"out"};

    /// `cameras`: positions in the views of the scene. Throws std::runtime_error if there is no
    /// such view, or the firmware takes no more.
    Loader(const sc_core::sc_module_name& name, const degs::MemoryScene& scene,
           const std::vector<std::size_t>& cameras);
    std::uint64_t bytes() const { return memory_.size(); } ///< of the memory that is used

private:
    void start_of_simulation() override;
    std::uint32_t add(const std::vector<unsigned char>& bytes);

    std::vector<unsigned char> memory_; // from BOOT_TABLE on
};
