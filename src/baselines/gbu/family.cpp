// SPDX-License-Identifier: Apache-2.0
// The rule by which GBU designs of other sizes are made. docs/families.md explains it.
#include <algorithm>
#include <array>
#include <cmath>

#include "baselines/gbu/config.hpp"
#include "modules/kit/job/family_size.hpp"

namespace degs::gbu {
namespace {

// How the SRAM of 91 KB per 64 PEs is spent at the sizes of the shipped files [assumed]: what is
// left for lists and cache depends on how many tiles of which side the Pixel Buffer has to hold.
struct SharesOfSram {
    int pes;
    int cache_bytes, list_bytes;
    int contexts; ///< of an engine
    int chunks;   ///< in front of an engine
};
constexpr std::array<SharesOfSram, 4> kColumns{{{16, 6144, 8192, 2, 4},
                                                {64, 32768, 15360, 2, 4},
                                                {256, 131072, 61440, 1, 8},
                                                {1024, 262144, 32768, 1, 4}}};
// Rows per cycle of Row Generation: 8 are taken to fit the Scheduler of Table I, which one or two
// engines share; each engine of a larger design has as many as one of two [assumed].
constexpr int kRowsOfScheduler = 8, kLeastRows = 4;

// Bytes on the straight line through both columns on logarithmic axes; beyond the columns as the
// PEs.
int between(int pes, const SharesOfSram& low, const SharesOfSram& high, int SharesOfSram::*bytes) {
    if (low.pes == high.pes) {
        return static_cast<int>(std::int64_t{low.*bytes} * pes / low.pes);
    }
    const double way = std::log(double(pes) / low.pes) / std::log(double(high.pes) / low.pes);
    return static_cast<int>(
        std::lround(low.*bytes * std::pow(double(high.*bytes) / low.*bytes, way)));
}

} // namespace

void Config::scale_to(int pes) {
    constexpr int kLeast = 8, kMost = 4096;
    require_family_size(
        "gbu", pes, kMost, "must be a multiple of the rows of its tile, from 8 to 4096",
        [](int number) { return number >= kLeast && number % family_tile(number) == 0; });
    const auto above =
        std::find_if(kColumns.begin(), kColumns.end(),
                     [pes](const SharesOfSram& column) { return column.pes >= pes; });
    const bool beyond = above == kColumns.end();
    const SharesOfSram& high = beyond ? kColumns.back() : *above;
    const bool first = above == kColumns.begin();
    const SharesOfSram& low = beyond || first || high.pes == pes ? high : *(above - 1);
    name = "gbu-" + std::to_string(pes);
    tile_size = family_tile(pes);
    engines.row_pes = tile_size;
    engines.count = pes / tile_size;
    engines.rows_per_cycle = std::max(kLeastRows, kRowsOfScheduler / engines.count);
    reuse_cache.bytes = between(pes, low, high, &SharesOfSram::cache_bytes);
    const int chunks = sorting.count * sorting.chunk * traffic.list_entry_bytes;
    list_buffer.bytes = std::max(chunks, between(pes, low, high, &SharesOfSram::list_bytes));
    list_buffer.chunks = low.chunks;
    pixel_buffer.bytes =
        engines.count * low.contexts * pixel_buffer.state_bytes * tile_size * tile_size;
    pixel_buffer.readout_pixels = pes;
}

} // namespace degs::gbu
