// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <tlm>

namespace degs {

/// Records of one array that a single request moves, wherever they lie: a base address, the size of
/// a record, and a view of their numbers. A record is moved in whole bursts, counted from the base,
/// so one that straddles two bursts takes both.
struct ScatteredRecords {
    std::uint64_t base = 0;   ///< address of the array
    std::uint64_t stride = 1; ///< bytes from one record to the next, at least 1
    std::uint64_t bytes = 1;  ///< of a record, at least 1
    std::uint64_t burst = 1;  ///< bytes, at least 1
    /// Bursts end here at the latest. No record passes it.
    std::uint64_t array_bytes = std::numeric_limits<std::uint64_t>::max();
    const std::uint32_t* numbers =
        nullptr; ///< of the records, in the order in which they are moved
    std::size_t count = 0;
    /// Where the record of a number lies in the array; nullptr: at its number.
    const std::uint32_t* places = nullptr;
    /// Records that follow each other in the array, and in this list, move the burst between them
    /// once. Places must then rise.
    bool neighbours_share = false;

    /// Calls visit(address, bytes) for every run of bytes, in the order of the list: one per
    /// record, or one per run of neighbours that touch if they share bursts.
    template <class Visit>
    void for_each_run(const Visit& visit) const;
    /// Bytes of all runs.
    std::uint64_t total_bytes() const;

private:
    struct Run {
        std::uint64_t begin = 0, end = 0; // in the array
    };
    Run run_of(std::size_t i) const {
        const std::uint32_t number = numbers[i];
        const std::uint64_t first = (places == nullptr ? number : places[number]) * stride;
        const std::uint64_t end = (first + bytes + burst - 1) / burst * burst;
        return {first / burst * burst, std::min(end, array_bytes)};
    }
};

template <class Visit>
void ScatteredRecords::for_each_run(const Visit& visit) const {
    Run run;
    for (std::size_t i = 0; i < count; ++i) {
        const Run next = run_of(i);
        if (neighbours_share && i != 0 && next.begin <= run.end) {
            run.end = std::max(run.end, next.end);
            continue;
        }
        if (i != 0) {
            visit(base + run.begin, run.end - run.begin);
        }
        run = next;
    }
    if (count != 0) {
        visit(base + run.begin, run.end - run.begin);
    }
}

inline std::uint64_t ScatteredRecords::total_bytes() const {
    const bool one_burst_each =
        !neighbours_share && stride == bytes && burst % bytes == 0 && array_bytes % burst == 0;
    if (one_burst_each) {
        return count * burst;
    }
    std::uint64_t sum = 0;
    for_each_run([&sum](std::uint64_t, std::uint64_t run) { sum += run; });
    return sum;
}

/// Says that a payload moves scattered records: its data are those of the runs, one behind the
/// other, and its length is their sum. A target that does not know the extension, or does not care
/// for addresses, sees one access of as many bytes. The records live as long as the access.
struct Scattered : tlm::tlm_extension<Scattered> {
    const ScatteredRecords* records = nullptr;
    tlm_extension_base* clone() const override { return new Scattered(*this); }
    void copy_from(const tlm_extension_base& other) override {
        records = static_cast<const Scattered&>(other).records;
    }
};

/// Calls visit(address, data, bytes) for every run of bytes that a payload moves.
template <class Visit>
void for_each_run(const tlm::tlm_generic_payload& payload, const Visit& visit) {
    unsigned char* data = payload.get_data_ptr();
    if (const auto* scattered = payload.get_extension<Scattered>()) {
        scattered->records->for_each_run([&](std::uint64_t address, std::uint64_t bytes) {
            visit(address, data, bytes);
            data += bytes;
        });
    } else {
        visit(payload.get_address(), data, payload.get_data_length());
    }
}

} // namespace degs
