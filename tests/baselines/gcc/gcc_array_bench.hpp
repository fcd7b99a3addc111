// SPDX-License-Identifier: Apache-2.0
// Stage IV of GCC alone: lists come from a script, finished views go to another.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "baselines/gcc/window_array.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs::test {

/// One array with its job; several may live in one elaboration.
class GccArrayBench {
public:
    struct Options {
        gcc::WindowArray::Config array;
        int contexts = 1;
        std::uint32_t chunk = 16;  ///< splats per hand-over
        Cycle chunk_cycles = 0;    ///< between two hand-overs
        Cycle readout_cycles = 10; ///< from a finished view to a free context
        std::size_t listeners = 0; ///< for ended blocks
        int block = 8;
        Arithmetic numbers = Arithmetic::Fp64;
        Fidelity fidelity = Fidelity::Exact;
    };
    struct Report {
        Cycle date = 0;
        SliceReport report;
    };

    GccArrayBench(const std::string& name, const FrameWorkload& frame, const Options& options)
        : options_(options), time_{ClockDomain(1.0), options.fidelity},
          job_(make_render_job({&frame},
                               {options.numbers, SpanEnds::Exact, 0, StopRule::Refuse, {}},
                               options.contexts)),
          array_((name + "_array").c_str(), options.array, time_, job_,
                 ArrayShare{1, options.contexts, 0, false}, options.listeners, options.block),
          chunks_((name + "_chunks").c_str(), time_, 4),
          contexts_((name + "_contexts").c_str(), time_, 64),
          done_((name + "_done").c_str(), time_, 64, writeback()),
          state_((name + "_state").c_str(), time_, 64, writeback()),
          blocks_((name + "_blocks").c_str(), time_, 4096, writeback()) {
        array_.in[0].bind(chunks_);
        array_.context_free.bind(contexts_);
        array_.tile_done.bind(done_);
        array_.tile_state.bind(state_);
        if (options.listeners != 0) {
            array_.block_ended[0].bind(blocks_);
            script(name + "_blocks_of", [this](Process& self) { listen(self); });
        }
        script(name + "_source", [this](Process& self) { feed(self); });
        script(name + "_pixels", [this](Process& self) { read_out(self); });
        script(name + "_monitor", [this](Process& self) {
            for (std::size_t t = 0; t < job_.tiles.size(); ++t) {
                const SliceReport report = state_.get(self);
                states_.push_back({self.local(), report});
            }
        });
    }

    const gcc::WindowArray::Stats& stats() const { return array_.stats(); }
    const Image& image() const { return job_.images[0]; }
    const std::vector<Report>& done() const { return dones_; }
    const std::vector<Report>& states() const { return states_; }
    const std::vector<std::pair<Cycle, gcc::BlockEnded>>& blocks() const { return ended_blocks_; }
    std::uint64_t pes() const { return static_cast<std::uint64_t>(options_.array.pes()); }

private:
    Cycle writeback() const { return static_cast<Cycle>(options_.array.writeback_cycles); }
    void script(const std::string& name, const std::function<void(Process&)>& body) {
        processes_.push_back(std::make_unique<Process>(time_));
        Process& self = *processes_.back();
        scripts_.push_back(std::make_unique<Script>(name.c_str(), [body, &self] {
            body(self);
            self.finish();
        }));
    }
    void feed(Process& self) {
        for (TileNumber t = 0; t < job_.tiles.size(); ++t) {
            const JobTile& tile = job_.tiles[t];
            for (std::uint64_t done = 0; done < tile.count;) {
                SplatChunk chunk;
                chunk.tile = t;
                chunk.first = tile.first + done;
                chunk.count = static_cast<std::uint32_t>(
                    std::min<std::uint64_t>(options_.chunk, tile.count - done));
                done += chunk.count;
                chunk.last = done == tile.count;
                chunks_.put(self, chunk);
                self.advance(options_.chunk_cycles);
            }
        }
    }
    void read_out(Process& self) {
        std::vector<PixelValue> row(static_cast<std::size_t>(job_.tile_size));
        for (TileNumber t = 0; t < job_.tiles.size(); ++t) {
            const SliceReport report = done_.get(self);
            dones_.push_back({self.local(), report});
            const JobTile& tile = job_.tiles[t];
            const int context = static_cast<int>(t) % options_.contexts;
            for (int y = 0; y < tile.height; ++y) {
                job_.path->read_row(context, y, tile.width, row.data());
                for (int x = 0; x < tile.width; ++x) {
                    store(row[static_cast<std::size_t>(x)], tile.x + x, tile.y + y);
                }
            }
            begin_context(context);
            self.advance(options_.readout_cycles);
            const auto next = t + static_cast<TileNumber>(options_.contexts);
            if (next < job_.tiles.size()) {
                contexts_.put(self, next);
            }
        }
    }
    void begin_context(int context) {
        for (int y = 0; y < job_.tile_size; ++y) {
            job_.path->begin_row(context, y);
        }
    }
    void store(const PixelValue& pixel, int x, int y) {
        Image& image = job_.images[0];
        const std::size_t i = image.at(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgb[i * 3 + c] = static_cast<float>(pixel.rgb[c]);
        }
        image.transmittance[i] = static_cast<float>(pixel.transmittance);
        image.fragments[i] = pixel.updates;
    }
    void listen(Process& self) {
        for (;;) {
            const gcc::BlockEnded block = blocks_.get(self);
            ended_blocks_.emplace_back(self.local(), block);
        }
    }

    Options options_;
    Timebase time_;
    RenderJob job_;
    gcc::WindowArray array_;
    DatedFifo<SplatChunk> chunks_;
    DatedFifo<TileNumber> contexts_;
    DatedFifo<SliceReport> done_, state_;
    DatedFifo<gcc::BlockEnded> blocks_;
    std::vector<std::unique_ptr<Process>> processes_;
    std::vector<std::unique_ptr<Script>> scripts_;
    std::vector<Report> dones_, states_;
    std::vector<std::pair<Cycle, gcc::BlockEnded>> ended_blocks_;
};

/// What must hold of every finished run of the array.
inline void expect_sound(const GccArrayBench& bench) {
    const gcc::WindowArray::Stats& s = bench.stats();
    EXPECT_EQ(s.slots.total(), s.window.cycles() * bench.pes());
    EXPECT_EQ(s.slots[Slot::Useful] + s.slots[Slot::Boundary] + s.slots[Slot::Terminated],
              (s.windows + s.skip_cycles) * bench.pes());
    EXPECT_EQ(s.slots[Slot::Useful] + s.slots[Slot::Terminated],
              s.valid_pixels + s.skip_cycles * bench.pes());
    EXPECT_EQ(s.slots[Slot::Drain], 0U);
}

} // namespace degs::test
