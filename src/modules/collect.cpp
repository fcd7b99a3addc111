// SPDX-License-Identifier: Apache-2.0
#include "modules/collect.hpp"

#include "config/grouped_number.hpp"

namespace degs {

namespace {

void collect_written(AcceleratorResult& result, const std::vector<Cycle>& written) {
    result.frames.resize(std::max(result.frames.size(), written.size()));
    for (std::size_t f = 0; f < written.size(); ++f) {
        result.frames[f].finished = std::max(result.frames[f].finished, written[f]);
    }
}

} // namespace

void collect_frames(AcceleratorResult& result, const PixelBuffers& buffers,
                    const BackgroundWriter& background) {
    collect_written(result, background.frames_written());
    result.cycles = background.stats().finished;
    result.background_tiles = background.stats().tiles;
    for (const auto& buffer : buffers) {
        collect_written(result, buffer->frames_written());
        result.cycles = std::max(result.cycles, buffer->stats().finished);
    }
    // Images leave in order, even if engines had the tiles of a later frame done before.
    for (std::size_t f = 1; f < result.frames.size(); ++f) {
        result.frames[f].finished =
            std::max(result.frames[f].finished, result.frames[f - 1].finished);
    }
}

void add_pixel_buffer(AcceleratorResult& result, int bytes, int contexts,
                      const PixelBuffers& buffers) {
    using P = PixelBuffer::Stats;
    BufferUse use;
    use.name = "pixel_buffer";
    use.bytes = bytes;
    use.counts = {{"contexts", static_cast<std::uint64_t>(contexts)},
                  {"readout_cycles", sum_of(buffers, &P::readout_busy)},
                  {"write_wait_cycles", sum_of(buffers, &P::write_wait)}};
    result.buffers.push_back(use);
}

void explain_tiles(AcceleratorResult& result, std::uint64_t records_cancelled) {
    auto& out = result.left_out;
    out.push_back(grouped(result.background_tiles) + " of " +
                  grouped(result.tiles + result.background_tiles) +
                  " tiles list no splat: they are written as background and enter no unit.");
    out.push_back(grouped(result.tiles_cancelled) +
                  " tiles were cancelled before the end of their list because all their pixels had "
                  "ended: " +
                  grouped(records_cancelled) + " splat records were not fetched.");
    out.emplace_back(
        "The energy of the accelerator is not reported: its blocks have no energy model.");
}

} // namespace degs
