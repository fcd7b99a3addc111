// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/pixels/pixel_buffer.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "splat/images/image.hpp"
#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs {
namespace {

void encode_half(double value, unsigned char* bytes) {
    const std::uint16_t half = glm::packHalf1x16(static_cast<float>(value));
    std::memcpy(bytes, &half, sizeof half);
}

void encode(const PixelValue& pixel, int pixel_bytes, unsigned char* bytes) {
    const float alpha = 1.0F - static_cast<float>(pixel.transmittance); // an Image has floats
    if (pixel_bytes == 8) {
        for (int c = 0; c < 3; ++c) {
            encode_half(pixel.rgb[c], bytes + std::ptrdiff_t{2} * c);
        }
        encode_half(alpha, bytes + 6);
    } else {
        for (int c = 0; c < 3; ++c) {
            bytes[c] = byte_of(static_cast<float>(pixel.rgb[c])); // as in an Image
        }
        bytes[3] = byte_of(alpha);
    }
}

} // namespace

void PixelBuffer::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 1, 1 << 30, "bytes of tile contexts (paper Table I: 16 KB)");
    visitor.integer("state_bytes", state_bytes, 0, 64,
                    "bytes per pixel: 16 are T and RGB in single precision [assumed]; 0: what they "
                    "take in the formats of pipeline.numbers");
    visitor.choice("release", release, {"tile", "bank"},
                   "when a context may hold the next tile: once all slices have finished, or each "
                   "bank's rows on their own [assumed]");
    visitor.integer("rows_per_cycle", rows_per_cycle, 1, 2,
                    "rows of pixels of a tile that leave for memory per cycle [assumed]");
    visitor.integer("free_cycles", free_cycles, 1, 1024,
                    "cycles until the array knows that a context is free again [assumed]");
    visitor.integer("writes_in_flight", writes_in_flight, 1, 1024,
                    "tile writes not yet acknowledged by memory; 4 hide its latency [assumed]");
    visitor.integer("readout_pixels", readout_pixels, 1, 4096,
                    "pixels per cycle when a finished tile is read out [assumed]");
}

void PixelBuffer::Config::require_tiles(ConfigVisitor& visitor, const std::string& section,
                                        TilePixels tile, int tiles, std::vector<const char*> others,
                                        int most) const {
    const std::string readout = section + ".readout_pixels", rows = section + ".rows_per_cycle";
    std::vector<const char*> rates = others;
    rates.insert(rates.begin(), rows.c_str());
    const std::string state_key = section + ".state_bytes";
    others.insert(others.begin(), state_key.c_str());
    if (state_bytes == 0) {
        others.push_back("pipeline.numbers");
    }
    const std::string key = section + ".bytes";
    const std::string side = std::to_string(tile.side);
    const std::string of = " of " + side + " x " + side + " px";
    visitor.require_at_least(
        key.c_str(), bytes, tiles * tile_bytes(tile),
        "to hold " + std::to_string(tiles) + (tiles == 1 ? " tile" : " tiles") + of, others);
    visitor.require(contexts(tile) <= most,
                    {key.c_str(), "must not hold more than " + std::to_string(most) + " tiles" + of,
                     std::to_string(tile_bytes(tile) * most), others});
    const std::int64_t step = tiles * tile_bytes(tile), rest = bytes % step;
    visitor.advise_if_set(rest == 0,
                          {key.c_str(),
                           "holds " + std::to_string(bytes / step * tiles) + " tiles" + of +
                               ", so " + std::to_string(rest) + " bytes of it have no effect",
                           std::to_string(bytes - rest), others});
    const int leave = tiles * rows_per_cycle * tile.side; // each reads out one at a time
    visitor.advise_if_set(release == ContextRelease::Bank || readout_pixels <= leave,
                          {readout.c_str(),
                           "has no effect above " + std::to_string(leave) +
                               ", the pixels of the rows that leave per cycle",
                           std::to_string(leave), rates});
}

PixelBuffer::Config PixelBuffer::Config::part_of(int parts) const {
    Config part = *this;
    part.bytes /= parts;
    part.readout_pixels = std::max(1, readout_pixels / parts);
    return part;
}

std::int64_t PixelBuffer::Config::tile_bytes(TilePixels tile) const {
    return ceil_div(std::int64_t{bits(tile)} * tile.side * tile.side, std::int64_t{8});
}

PixelBuffer::PixelBuffer(const sc_core::sc_module_name& name, const Config& config,
                         const TrafficConfig& traffic, const Timebase& time, RenderJob& job,
                         std::size_t slices, int contexts, const Share& share, bool gated,
                         bool instant)
    : sc_core::sc_module(name), in("in", slices), context_free("context_free", slices),
      frame_done("frame_done", gated ? 1 : 0), frame_buffer("frame_buffer", time), config_(config),
      traffic_(traffic), job_(job), contexts_(contexts), share_(share), instant_(instant),
      self_(time), in_flight_(config.writes_in_flight, 0) {
    DEGS_HAS_PROCESS(PixelBuffer);
    SC_THREAD(run);
    self_.show(*this, stats_.readout_busy);
    if (self_.track() != nullptr) {
        self_.track()->follow(TimelineState::Kind::Memory, stats_.write_wait);
    }
}

void PixelBuffer::clear(TileNumber number) {
    for (int row = share_.first_row; row < job_.tile_size; row += share_.row_stride) {
        if (source_ != nullptr) {
            source_->clear_row(number, row);
        } else {
            job_.path->begin_row(context_of(number), row);
        }
    }
}

void PixelBuffer::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    for (auto& port : context_free) {
        port->connect_writer(self_);
    }
    for (auto& port : frame_done) {
        port->connect_writer(self_);
    }
}

void PixelBuffer::run() {
    while (share_.granted || !job_.over(stats_.tiles)) {
        const TileNumber number = next_tile();
        if (number == kNoTile) {
            break;
        }
        finish_tile(number);
    }
    note_frames(job_.frames.size());
    self_.finish();
}

void PixelBuffer::note_frames(std::size_t frames) {
    while (frames_written_.size() < frames) {
        frames_written_.push_back(0);
    }
    frames_written_.drop_before(job_.first_dated());
}

// kNoTile: there are no more tiles.
TileNumber PixelBuffer::next_tile() {
    TileNumber number = kNoTile;
    for (auto& port : in) {
        number = port->get(self_).tile;
    }
    return number;
}

// For a granted tile this must be called before the tile is counted.
int PixelBuffer::context_of(TileNumber number) const {
    const std::uint64_t turn = share_.granted ? stats_.tiles : number;
    return context_in_turn(turn, contexts_, share_.first_context);
}

void PixelBuffer::finish_tile(TileNumber number) {
    Completion& oldest = in_flight_[stats_.tiles % in_flight_.size()];
    self_.wait_for_memory(oldest, stats_.write_wait);
    const Cycle start = self_.local();
    oldest = write_rows(number);
    written_ = latest(written_, oldest);
    read_out_ = self_.local();
    stats_.readout_busy += read_out_ - start;
    if (job_.recorder != nullptr) {
        job_.recorder->read_out(number, read_out_);
    }
    clear(number);
    const std::uint32_t frame = job_.tiles[number].frame;
    note_frames(frame + 1);
    latest(written_, read_out_).when_known([this, frame](Cycle date) {
        // The frame is kept, because it has not ended before.
        frames_written_[frame] = std::max(frames_written_[frame], date);
        stats_.finished = std::max(stats_.finished, date);
    });
    for (auto& port : frame_done) {
        port->put_at(self_, frame, oldest);
    }
    job_.note_end(frame);
    stats_.tiles++;
    const TileNumber next = number + contexts_;
    if (share_.granted || !job_.over(next)) {
        for (auto& port : context_free) {
            port->put(self_, next);
        }
    }
}

// One posted write per row, as the rows are read out, at most rows_per_cycle in a cycle: an access
// takes the kernel half a cycle on, see Memory. Returns the completion of the last one.
Completion PixelBuffer::write_rows(TileNumber number) {
    const int rows_per_cycle = config_.rows_per_cycle;
    const JobTile& tile = job_.tiles[number];
    const MemoryMap map = job_.map(tile.frame, traffic_);
    const std::uint64_t pixel_bytes = job_.pixel_bytes(tile.frame, traffic_);
    const Camera& camera = job_.frame_of(tile).camera;
    const PixelRange rows = tile.image_rows(), columns = tile.columns();
    const int per_cycle = pixels_per_cycle();
    const Cycle start = self_.local();
    Completion done = start;
    int read = 0; // pixels
    int row = 0;
    for (int y = share_.first_row; y <= rows.last; y += share_.row_stride) {
        if (y < rows.first) {
            continue;
        }
        if (!instant_) {
            self_.advance_to(start + std::max(read / per_cycle, row / rows_per_cycle));
        }
        const std::uint64_t address =
            map.frame_buffer + camera.place_of(columns.first, tile.y + y) * pixel_bytes;
        const std::vector<unsigned char>& pixels = read_out(number, y);
        if (instant_) {
            frame_buffer.poke(address, pixels);
        } else {
            done = latest(done, frame_buffer.write(self_, address, pixels));
        }
        read += columns.size();
        ++row;
    }
    if (instant_) {
        return done;
    }
    self_.advance_to(start + std::max((read + per_cycle - 1) / per_cycle,
                                      (row + rows_per_cycle - 1) / rows_per_cycle));
    return done;
}

const std::vector<unsigned char>& PixelBuffer::read_out(TileNumber number, int y) {
    const JobTile& tile = job_.tiles[number];
    Image& image = job_.images[tile.frame];
    const bool kept = !image.rgb.empty();
    const int pixel_bytes = job_.pixel_bytes(tile.frame, traffic_);
    const PixelRange columns = tile.image_columns();
    pixels_.resize(columns.last + 1);
    bytes_.resize(std::size_t{1} * columns.size() * pixel_bytes);
    if (source_ != nullptr) {
        source_->read_row(number, y, columns.last + 1, pixels_.data());
    } else {
        job_.path->read_row(context_of(number), y, columns.last + 1, pixels_.data());
    }
    unsigned char* out = bytes_.data();
    std::size_t i = job_.frame_of(tile).camera.place_of(tile.columns().first, tile.y + y);
    for (int column = columns.first; column <= columns.last; ++column) {
        const PixelValue& pixel = pixels_[column];
        if (kept) {
            image.put(i, pixel.rgb, pixel.transmittance, pixel.updates);
        }
        encode(pixel, pixel_bytes, out);
        out += pixel_bytes;
        ++i;
    }
    return bytes_;
}

} // namespace degs
