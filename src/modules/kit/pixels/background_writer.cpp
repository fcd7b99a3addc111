// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/pixels/background_writer.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs {

BackgroundWriter::BackgroundWriter(const sc_core::sc_module_name& name,
                                   const TrafficConfig& traffic, const Timebase& time,
                                   RenderJob& job, int cycles_per_write, bool reports, bool instant)
    : sc_core::sc_module(name), listed("listed", instant ? 0 : 1),
      frame_done("frame_done", reports ? 1 : 0), frame_buffer("frame_buffer", time),
      traffic_(traffic), job_(job), cycles_per_write_(cycles_per_write), instant_(instant),
      self_(time) {
    self_.show(*this);
    if (instant && !reports) {
        self_.finish();
        return;
    }
    job_.ends.of_frame++;
    DEGS_HAS_PROCESS(BackgroundWriter);
    SC_THREAD(run);
}

void BackgroundWriter::end_of_elaboration() {
    for (auto& port : listed) {
        port->connect_reader(self_);
    }
    for (auto& port : frame_done) {
        port->connect_writer(self_);
    }
}

void BackgroundWriter::run() {
    for (std::uint32_t f = 0; job_.has_frame(self_, f); ++f) {
        for (auto& port : listed) {
            port->get(self_);
        }
        const Completion done = write_frame(f);
        frames_written_.push_back(0);
        frames_written_.drop_before(job_.first_dated());
        done.when_known([this, f](Cycle date) {
            frames_written_[f] = date; // before the end of the frame, so it is kept
            stats_.finished = std::max(stats_.finished, date);
        });
        for (auto& port : frame_done) {
            port->put_at(self_, f, done);
        }
        job_.note_end(f);
    }
    self_.finish();
}

// A tile lists no splat if its part of the frame's list is empty; hidden ones are another view's.
Completion BackgroundWriter::write_frame(std::uint32_t frame) {
    const FrameWorkload& work = *job_.frames[frame];
    Completion done = self_.local();
    const TileGrid grid = work.grid();
    const auto empty = [&](int tile) {
        return work.tile_begin[tile] == work.tile_begin[tile + 1] && !grid.is_hidden(tile);
    };
    for (int row = 0; row < work.tiles_y; ++row) {
        for (int begin = 0; begin < work.tiles_x;) {
            int end = begin;
            while (end < work.tiles_x && empty(row * work.tiles_x + end)) {
                ++end;
            }
            if (end != begin) {
                done = latest(done, write_run(frame, row, begin, end));
            }
            begin = end + 1;
        }
    }
    return done;
}

// Tiles [begin, end) of a row of tiles. Background is transparent black: zeros in any format.
Completion BackgroundWriter::write_run(std::uint32_t frame, int tile_row, int begin, int end) {
    Completion done = self_.local();
    if (instant_) {
        return done;
    }
    const FrameWorkload& work = *job_.frames[frame];
    const TileGrid grid = work.grid();
    const int first = tile_row * work.tiles_x;
    const int left = grid.image_pixels_of(first + begin).x0;
    const int width = grid.image_pixels_of(first + end - 1).x1 + 1 - left;
    const int top = grid.image_pixels_of(first).y0;
    const int bottom = grid.image_pixels_of(first).y1 + 1;
    // Rows as wide as the image follow each other.
    const int rows = width == work.camera.width ? bottom - top : 1;
    const std::uint64_t pixel_bytes = job_.pixel_bytes(frame, traffic_);
    const std::vector<unsigned char> zeros((rows * width) * pixel_bytes, 0);
    const std::uint64_t base = job_.map(frame, traffic_).frame_buffer;
    for (int y = top; y < bottom; y += rows) {
        const std::uint64_t pixel = work.camera.place_of(left, y);
        self_.advance_to(next_write_);
        next_write_ = self_.local() + cycles_per_write_;
        done = latest(done, frame_buffer.write(self_, base + pixel * pixel_bytes, zeros));
    }
    return done;
}

} // namespace degs
