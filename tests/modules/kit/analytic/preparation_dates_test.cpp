// SPDX-License-Identifier: Apache-2.0
// Projection and binning of an estimate against dates worked out by hand.
#include "modules/kit/analytic/preparation_dates.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

using Chunk = PreparationDates::Chunk;

constexpr double kBytes = 64; // per cycle

struct Places {
    int units = 1, in_flight = 1000, ahead = 1000, writes = 1000;
};

PreparationDates dates_of(const Places& places) {
    MemoryRate memory({}, 1);
    memory.bytes_per_cycle = kBytes;
    memory.latency = 100;
    ProjectionUnit::Config projection;
    projection.count = places.units;
    projection.chunks_in_flight = places.in_flight;
    projection.chunks_ahead = places.ahead;
    projection.latency_cycles = 20; // less than the memory that the colours wait for
    TileBinner::Config binning;
    binning.writes_in_flight = places.writes;
    return PreparationDates(projection, binning, memory);
}

double end_of(const Places& places, const std::vector<Chunk>& chunks) {
    PreparationDates dates = dates_of(places);
    for (const Chunk& chunk : chunks) {
        dates.add(chunk);
    }
    return dates.end();
}

Chunk chunk_of(double projecting, double shading, double binning, double moving) {
    return {projecting, shading, binning, moving * kBytes};
}

// Geometry, colours and the acknowledgement of the lists wait for memory.
TEST(PreparationDates, AChunkPassesThroughAllSteps) {
    EXPECT_EQ(end_of({}, {}), 0);
    EXPECT_EQ(end_of({}, {chunk_of(10, 20, 30, 40)}), 40 + 100 + 10 + 100 + 20 + 30 + 100);
}

TEST(PreparationDates, TheSlowestStepPacesTheOthers) {
    const auto end_of_ten = [](double projecting, double shading, double binning, double moving) {
        return end_of({}, std::vector<Chunk>(10, chunk_of(projecting, shading, binning, moving)));
    };
    EXPECT_EQ(end_of_ten(50, 1, 1, 1), 1 + 100 + 10 * 50 + 100 + 1 + 1 + 100);
    EXPECT_EQ(end_of_ten(1, 50, 1, 1), 1 + 100 + 1 + 100 + 10 * 50 + 1 + 100);
    EXPECT_EQ(end_of_ten(1, 1, 50, 1), 1 + 100 + 1 + 100 + 1 + 10 * 50 + 100);
    EXPECT_EQ(end_of_ten(1, 1, 1, 50), 10 * 50 + 100 + 1 + 100 + 1 + 1 + 100);
}

// Chunks of which now this, now that is slow take longer than the sums of either.
TEST(PreparationDates, ChunksDiffer) {
    std::vector<Chunk> chunks(5, chunk_of(50, 0, 0, 0));
    chunks.insert(chunks.end(), 5, chunk_of(0, 0, 50, 0));
    EXPECT_EQ(end_of({}, chunks), 100 + 5 * 50 + 100 + 5 * 50 + 100);
}

TEST(PreparationDates, UnitsShareTheChunks) {
    Places places;
    places.units = 4;
    EXPECT_EQ(end_of(places, std::vector<Chunk>(8, chunk_of(50, 0, 0, 0))),
              100 + 2 * 50 + 100 + 100);
}

TEST(PreparationDates, AFullStepHoldsUpTheOneBefore) {
    Places one_request;
    one_request.in_flight = 1;
    EXPECT_EQ(end_of(one_request, std::vector<Chunk>(10, chunk_of(0, 0, 0, 1))),
              10 * (1 + 100) + 100 + 100);
    Places one_write;
    one_write.writes = 1;
    EXPECT_EQ(end_of(one_write, std::vector<Chunk>(10, chunk_of(0, 0, 1, 0))),
              100 + 100 + 1 + 10 * 100);
    // The second colour is finished at 220, when the first chunk has left its place for the binner.
    Places one_ahead;
    one_ahead.ahead = 1;
    one_ahead.in_flight = 1;
    EXPECT_EQ(end_of(one_ahead, {chunk_of(0, 10, 300, 0), chunk_of(0, 10, 0, 0),
                                 chunk_of(0, 10, 0, 0), chunk_of(0, 500, 0, 0)}),
              510 + 500 + 100)
        << "the third waits with its colour until 510";
}

} // namespace
} // namespace degs
