// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "tlm/memory.hpp"
#include "tlm/memory_request.hpp"
#include "tlm/process.hpp"
#include "tlm/scattered_records.hpp"
#include "tlm/urgent.hpp"

namespace degs {

/// With this extension a port says that it does not need the date of an answer at once. A target
/// that cannot know it may return from b_transport() before, with an answer that will come; it then
/// has copied what it writes, and reports what it reads and errors itself.
struct MayAnswerLate : tlm::tlm_extension<MayAnswerLate> {
    std::shared_ptr<LateAnswer> answer; ///< the target's; null: answered as usual
    tlm_extension_base* clone() const override { return new MayAnswerLate; }
    void copy_from(const tlm_extension_base&) override {}
};

/// Connects one stream to memory: a TLM-2.0 initiator socket that a dated process uses, with any LT
/// target. All accesses of the port share one payload, because b_transport() returns before the
/// next access begins.
class MemoryPort : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<MemoryPort> out;

    MemoryPort(const sc_core::sc_module_name& name, const Timebase& time)
        : sc_core::sc_module(name), out("out"), clock_(&time.clock) {}

    /// Lets the memory answer late, see MayAnswerLate; before the simulation starts.
    void accept_late_answers() { accepts_late_ = true; }

    /// Marks all reads as Urgent; before the simulation starts.
    void make_urgent() { is_urgent_ = true; }

    /// Reads or writes `bytes` whose values the model does not keep. The access leaves at the local
    /// date of the process, which does not move. Returns when the transfer is complete.
    Completion read(Process& process, std::uint64_t address, std::uint64_t bytes) {
        return access(process, tlm::TLM_READ_COMMAND, address, nullptr, bytes);
    }
    Completion write(Process& process, std::uint64_t address, std::uint64_t bytes) {
        return access(process, tlm::TLM_WRITE_COMMAND, address, nullptr, bytes);
    }
    /// Reads or writes scattered records, in one request. `run` is the address at which as many
    /// bytes begin for a memory that takes them as one run.
    Completion read(Process& process, const ScatteredRecords& records) {
        return access(process, tlm::TLM_READ_COMMAND, records.base, nullptr, records.total_bytes(),
                      &records);
    }
    Completion write(Process& process, std::uint64_t run, const ScatteredRecords& records) {
        return access(process, tlm::TLM_WRITE_COMMAND, run, nullptr, records.total_bytes(),
                      &records);
    }
    /// Writes real bytes.
    Completion write(Process& process, std::uint64_t address,
                     const std::vector<unsigned char>& data) {
        return access(process, tlm::TLM_WRITE_COMMAND, address,
                      const_cast<unsigned char*>(data.data()), data.size());
    }

    /// Is called with the bytes of every read, run by run, which then really come from the memory.
    /// It is for memories that hold the data, and must be set before the simulation starts.
    using Observer =
        std::function<void(std::uint64_t address, const unsigned char* data, std::uint64_t bytes)>;
    void observe_reads(Observer observer) { observer_ = std::move(observer); }

    /// Is called after every access with the dates of its request and of its completion.
    using Watcher = std::function<void(Cycle asked, Cycle complete)>;
    void watch(Watcher watcher) { watcher_ = std::move(watcher); }

    /// Tells `listener`, which must outlive the simulation, of every request as it leaves, run by
    /// run; this port is its initiator of that number. Before the simulation starts.
    void tell(RequestListener& listener, std::size_t initiator) {
        listener_ = &listener;
        initiator_ = initiator;
    }

    /// Writes real bytes without taking time (debug transport). Throws std::runtime_error
    /// if the memory takes fewer.
    void poke(std::uint64_t address, const std::vector<unsigned char>& data);

private:
    Completion access(Process& process, tlm::tlm_command command, std::uint64_t address,
                      unsigned char* data, std::uint64_t bytes,
                      const ScatteredRecords* records = nullptr);

    void announce(Cycle local, tlm::tlm_command command, std::uint64_t address, std::uint64_t bytes,
                  const ScatteredRecords* records) const;

    const ClockDomain* clock_;
    std::vector<unsigned char> scratch_;
    TimingOnly timing_only_;
    MayAnswerLate may_answer_late_;
    bool accepts_late_ = false;
    Urgent urgent_;
    bool is_urgent_ = false;
    Scattered scattered_;
    Observer observer_;
    Watcher watcher_;
    RequestListener* listener_ = nullptr;
    std::size_t initiator_ = 0;
};

} // namespace degs
