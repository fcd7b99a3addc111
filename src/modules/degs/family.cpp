// SPDX-License-Identifier: Apache-2.0
// The rule by which DeGS designs of other sizes are made. docs/families.md explains it.
#include "modules/degs/config.hpp"
#include "modules/kit/job/family_size.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

constexpr int kMostBanks = 64, kWidestBank = TaskPacket::kMaxRuns;

// The power of two that is nearest to the square root of `pes`, the larger one if both are as near,
// but so many that no bank is wider than the widest packet.
int banks_of(int pes) {
    int banks = 1;
    while (2 * banks * banks <= pes || pes > banks * kWidestBank) {
        banks *= 2;
    }
    return banks;
}

// One for a bank of up to four PEs, and one more for every doubling: wide packets need several
// segments, because spans are shorter than segments, but not in proportion.
int segments_of(int pes_of_bank) {
    int segments = 1;
    for (int width = 8; width <= pes_of_bank; width *= 2) {
        ++segments;
    }
    return segments;
}

} // namespace

void DegsConfig::scale_to(int pes) {
    require_family_size("degs", pes, kMostBanks * kWidestBank,
                        "must be a multiple of its Issue Banks, which are the power of two next "
                        "to its square root, and at most 2048",
                        [](int number) { return number % banks_of(number) == 0; });
    constexpr int kBanksPerSlicer = 4;
    const int banks = banks_of(pes);
    const int rows_of_unit = span_buffer.bytes / span.count; // bytes; every unit keeps its share
    const int splats_of_bank = feature_buffer.bytes / scheduler.banks;
    name = "degs-" + std::to_string(pes);
    tile_size = std::max(4, family_tile(pes));
    pipeline.numbers = Arithmetic::Paper;
    pipeline.span_ends = SpanEnds::Slope;
    slicing.count = std::max(1, banks / kBanksPerSlicer);
    span.count = banks;
    scheduler.banks = banks;
    array.pes_per_bank = pes / banks;
    scheduler.segments_per_cycle = segments_of(array.pes_per_bank);
    scheduler.issue_width = scheduler.segments_per_cycle;
    span_buffer.bytes = rows_of_unit * span.count;
    feature_buffer.bytes = splats_of_bank * banks;
    packing.lead_packets = std::max(packing.lead_packets, packets_per_segment());
    packing.bytes = per_pe(packing.bytes, pes);
    pixel_buffer.bytes = per_pe(pixel_buffer.bytes, pes);
    pixel_buffer.state_bytes = 8;
    pixel_buffer.readout_pixels = pes;
}

} // namespace degs
