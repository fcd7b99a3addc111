// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <systemc>
#include <tlm>

namespace degs {

namespace dram {
class Lpddr5;
}

/// A main memory at bank level, as docs/lpddr5.md and docs/memories.md describe it, for LT and AT
/// initiators of 32-bit sockets at once. It serves accesses in the order of their dates (kernel
/// time plus annotated delay), so the accelerator may annotate them: MemoryOptions::pacing =
/// Annotated. Contents are 0 at first and moved by debug transport, too, as far as the memory
/// reaches. Byte enables say which bytes of an access move; whole bursts go over the bus. Direct
/// memory access is refused unless the configuration allows it.
class Lpddr5 : public sc_core::sc_module {
public:
    /// `file`: a configuration as configs/memory has them; empty: LPDDR5-6400 of 256 bit. Throws
    /// InputError, one sentence that names the file and the line, if something in it is wrong.
    /// `initiators`: number of sockets, 1 to 1024; another one is an InputError, too, and so is a
    /// time resolution of the kernel that is too coarse for the memory's clock. Dates are the same
    /// with all others.
    Lpddr5(const sc_core::sc_module_name& name, const std::string& file, std::size_t initiators);
    ~Lpddr5() override;

    /// The socket of one initiator, from 0 on; addresses begin at 0. These functions throw
    /// std::out_of_range, one sentence, if there is no such initiator.
    tlm::tlm_target_socket<>& in(std::size_t initiator);

    std::uint64_t capacity() const; ///< bytes
    double peak_gb_per_s() const;   ///< 1e9 B/s

    /// A number that the memory has counted since the start of the simulation.
    struct Statistic {
        std::string name; ///< "commands.act1"; those that `degs memory` measures have its names
        std::string unit, meaning;
        double value = 0; ///< counts are whole numbers
    };
    /// All of the memory, and those of one initiator, whose requests count when they are answered.
    std::vector<Statistic> statistics();
    std::vector<Statistic> statistics(std::size_t initiator) const;
    /// One of them. Throws InputError, one sentence with the nearest name, if there is none.
    double statistic(const std::string& name);
    double statistic(const std::string& name, std::size_t initiator) const;

private:
    std::size_t checked(std::size_t initiator) const;

    std::unique_ptr<dram::Lpddr5> model_;
    double peak_gb_per_s_ = 0;
};

} // namespace degs
