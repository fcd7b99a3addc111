// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory_port.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tlm/set_access.hpp"

namespace degs {
Completion MemoryPort::access(Process& process, tlm::tlm_command command, std::uint64_t address,
                              unsigned char* data, std::uint64_t bytes,
                              const ScatteredRecords* records) {
    if (bytes == 0) {
        return process.local();
    }
    if (listener_ != nullptr) {
        announce(process.local(), command, address, bytes, records);
    }
    tlm::tlm_generic_payload payload;
    if (data == nullptr) {
        scratch_.resize(std::max<std::size_t>(scratch_.size(), bytes));
        data = scratch_.data();
        if (!observer_ || command != tlm::TLM_READ_COMMAND) {
            payload.set_extension(&timing_only_);
        }
    }
    set_access(payload, command, address, data, bytes);
    if (records != nullptr) {
        scattered_.records = records;
        payload.set_extension(&scattered_);
    }
    if (accepts_late_) {
        payload.set_extension(&may_answer_late_);
    }
    if (is_urgent_ && command == tlm::TLM_READ_COMMAND) {
        payload.set_extension(&urgent_);
    }
    const Cycle asked = process.local();
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    const sc_core::sc_time date = clock_->at(process.local());
    sc_core::sc_time delay = date > now ? date - now : sc_core::SC_ZERO_TIME;
    process.tell(); // the memory may let others run
    out->b_transport(payload, delay);
    payload.clear_extension(&timing_only_);
    payload.clear_extension(&may_answer_late_);
    payload.clear_extension(&urgent_);
    // A memory that waits has moved the kernel on; a process must not stay more than a cycle
    // behind.
    const auto catch_up = [&] {
        process.advance_to(std::max<Cycle>(clock_->floor(sc_core::sc_time_stamp()), 1) - 1);
    };
    if (may_answer_late_.answer != nullptr) {
        payload.clear_extension(&scattered_);
        catch_up();
        Completion late(std::exchange(may_answer_late_.answer, nullptr));
        if (watcher_) {
            late.when_known([this, asked](Cycle complete) { watcher_(asked, complete); });
        }
        return late;
    }
    if (payload.is_response_error()) {
        payload.clear_extension(&scattered_);
        throw std::runtime_error(std::string(name()) + ": the memory answered " +
                                 payload.get_response_string() + " to an access of " +
                                 std::to_string(bytes) + " bytes at address " +
                                 std::to_string(address));
    }
    if (observer_ && command == tlm::TLM_READ_COMMAND) {
        for_each_run(payload, observer_);
    }
    payload.clear_extension(&scattered_);
    catch_up();
    const Cycle complete = std::max(asked, clock_->ceil(sc_core::sc_time_stamp() + delay));
    if (watcher_) {
        watcher_(asked, complete);
    }
    return complete;
}

// A process may be a cycle behind the kernel, and its request is not.
void MemoryPort::announce(Cycle local, tlm::tlm_command command, std::uint64_t address,
                          std::uint64_t bytes, const ScatteredRecords* records) const {
    const Cycle date = std::max(local, clock_->floor(sc_core::sc_time_stamp()));
    const auto tell = [&](std::uint64_t begin, std::uint64_t count) {
        listener_->request({date, begin, count, initiator_, command == tlm::TLM_WRITE_COMMAND});
    };
    if (records != nullptr) {
        records->for_each_run(tell);
    } else {
        tell(address, bytes);
    }
}

void MemoryPort::poke(std::uint64_t address, const std::vector<unsigned char>& data) {
    tlm::tlm_generic_payload payload;
    set_access(payload, tlm::TLM_WRITE_COMMAND, address, const_cast<unsigned char*>(data.data()),
               data.size());
    if (out->transport_dbg(payload) != data.size()) {
        throw std::runtime_error(std::string(name()) + ": the memory did not take " +
                                 std::to_string(data.size()) + " bytes at address " +
                                 std::to_string(address));
    }
}

} // namespace degs
