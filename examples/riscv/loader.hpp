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

    /// `views`: what the firmware renders. Throws std::runtime_error if it takes no more.
    Loader(const sc_core::sc_module_name& name, const degs::MemoryScene& scene,
           const std::vector<degs::MemoryScene::View>& views);
    std::uint64_t bytes() const { return memory_.size(); } ///< of the memory that is used

private:
    void start_of_simulation() override;
    std::uint32_t add(const std::vector<unsigned char>& bytes);

    std::vector<unsigned char> memory_; // from BOOT_TABLE on
};
