// SPDX-License-Identifier: Apache-2.0
// A lockstep array alone, fed with chunks at chosen dates.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/gscore/lockstep_array.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {

/// The array, one ring of chunks per input, and scripts in the places of fetchers, Pixel Buffer and
/// Tile Monitor. Data path in double precision.
class LockstepBench {
public:
    struct Sizes {
        std::size_t inputs = 1;
        int contexts = 64;
        std::size_t ring = 64;      ///< chunks per input
        Cycle readout = 0;          ///< cycles from tile_done to the context's hand-over
        std::uint32_t chunk = 1024; ///< splats per chunk if the bench cuts the lists
        Cycle chunk_gap = 1;        ///< between chunks of one input
    };
    static constexpr Cycle kStart = 20; ///< date of the first chunk

    LockstepBench(const std::string& name, const gscore::LockstepArray::Config& config,
                  FrameWorkload frame, const Sizes& sizes, Fidelity fidelity = Fidelity::Exact)
        : frame_(std::move(frame)), sizes_(sizes), time_{ClockDomain(1.0), fidelity},
          job_(make_render_job({&frame_},
                               {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}},
                               sizes.contexts)),
          done_((name + "_done").c_str(), time_, 64, static_cast<Cycle>(config.pipeline_cycles)),
          state_((name + "_state").c_str(), time_, 64),
          contexts_((name + "_contexts").c_str(), time_, 64), boxes_(job_),
          array_((name + "_array").c_str(), config, time_, job_, boxes_,
                 ArrayShare{sizes.inputs, sizes.contexts, 0, false}),
          tile_done(job_.tiles.size()), tile_state(job_.tiles.size()),
          all_ended(job_.tiles.size()) {
        for (std::size_t i = 0; i < sizes.inputs; ++i) {
            rings_.push_back(std::make_unique<DatedFifo<SplatChunk>>(
                (name + "_ring" + std::to_string(i)).c_str(), time_, sizes.ring));
            array_.in[i].bind(*rings_.back());
        }
        array_.tile_done.bind(done_);
        array_.tile_state.bind(state_);
        array_.context_free.bind(contexts_);
        for (int c = 0; c < sizes.contexts; ++c) {
            clear(c);
        }
        feeds_.resize(sizes.inputs);
        script(name + "_pixels", [this](Process& self) { pixels(self); });
        script(name + "_monitor", [this](Process& self) { monitor(self); });
        contexts_.connect_writer(*processes_[0]);
        for (std::size_t i = 0; i < sizes.inputs; ++i) {
            script(name + "_feed" + std::to_string(i), [this, i](Process& self) { feed(self, i); });
            rings_[i]->connect_writer(*processes_.back());
        }
    }

    /// The next `count` splats of the tile reach the array at `date` at the earliest.
    void chunk(TileNumber tile, std::uint32_t count, Cycle date) {
        auto& list = feeds_[tile % feeds_.size()];
        std::uint64_t before = 0;
        for (const Feed& f : list) {
            before += f.chunk.tile == tile ? f.chunk.count : 0;
        }
        const JobTile& t = job_.tiles[tile];
        list.push_back({{tile, t.first + before, count, before + count == t.count}, date});
    }
    /// All lists in chunks, as early as the rings take them.
    void chunks_of_all_tiles() {
        std::vector<Cycle> date(feeds_.size(), kStart);
        for (TileNumber tile = 0; tile < job_.tiles.size(); ++tile) {
            for (std::uint64_t left = job_.tiles[tile].count; left != 0;) {
                const auto count =
                    static_cast<std::uint32_t>(std::min<std::uint64_t>(left, sizes_.chunk));
                chunk(tile, count, date[tile % feeds_.size()]);
                date[tile % feeds_.size()] += sizes_.chunk_gap;
                left -= count;
            }
        }
    }
    static void start() { sc_core::sc_start(); }

    const gscore::LockstepArray::Stats& stats() const { return array_.stats(); }
    const RenderJob& job() const { return job_; }
    const DatedFifo<SplatChunk>& ring(std::size_t i) const { return *rings_[i]; }
    /// The pixel as it was read out.
    const PixelValue& pixel(int x, int y) const {
        return image_[static_cast<std::size_t>(y * job_.frames[0]->camera.width + x)];
    }
    void expect_sound() const {
        const gscore::LockstepArray::Stats& s = stats();
        const std::uint64_t lanes = static_cast<std::uint64_t>(array_.config().lanes);
        EXPECT_EQ(s.slots.total(), lanes * s.window.cycles());
        EXPECT_EQ(s.slots[Slot::Useful] + s.slots[Slot::Boundary] + s.slots[Slot::Terminated],
                  lanes * s.passes);
        EXPECT_EQ(s.splats + s.splats_discarded, job_.frames[0]->tile_pairs());
        EXPECT_LE(s.splats_skipped, s.splats);
        EXPECT_EQ(finished_, job_.tiles.size()) << "the bench did not come to its end";
    }

private:
    struct Feed {
        SplatChunk chunk;
        Cycle date;
    };
    template <class Body>
    void script(const std::string& name, Body body) {
        processes_.push_back(std::make_unique<Process>(time_));
        Process& self = *processes_.back();
        scripts_.push_back(std::make_unique<Script>(name.c_str(), [body, &self] {
            body(self);
            self.finish();
        }));
    }
    void clear(int context) {
        for (int row = 0; row < job_.tile_size; ++row) {
            job_.path->begin_row(context, row);
        }
    }
    void feed(Process& self, std::size_t input) {
        for (const Feed& f : feeds_[input]) {
            self.advance_to(f.date - 1); // the ring takes a cycle
            rings_[input]->put(self, f.chunk);
        }
    }
    void pixels(Process& self) {
        const Camera& camera = job_.frames[0]->camera;
        image_.resize(static_cast<std::size_t>(camera.width * camera.height));
        for (TileNumber tile = 0; tile < job_.tiles.size(); ++tile) {
            EXPECT_EQ(done_.get(self).tile, tile);
            tile_done[tile] = self.local();
            const JobTile& t = job_.tiles[tile];
            const int context = static_cast<int>(tile) % sizes_.contexts;
            for (int row = 0; row < t.height; ++row) {
                job_.path->read_row(
                    context, row, t.width,
                    &image_[static_cast<std::size_t>((t.y + row) * camera.width + t.x)]);
            }
            self.advance(sizes_.readout);
            clear(context);
            ++finished_;
            if (tile + static_cast<TileNumber>(sizes_.contexts) < job_.tiles.size()) {
                contexts_.put(self, tile + static_cast<TileNumber>(sizes_.contexts));
            }
        }
    }
    void monitor(Process& self) {
        for (TileNumber tile = 0; tile < job_.tiles.size(); ++tile) {
            const SliceReport report = state_.get(self);
            EXPECT_EQ(report.tile, tile);
            tile_state[tile] = self.local();
            all_ended[tile] = report.all_ended;
        }
    }

    FrameWorkload frame_;
    Sizes sizes_;
    Timebase time_;
    RenderJob job_;
    std::vector<std::unique_ptr<DatedFifo<SplatChunk>>> rings_;
    DatedFifo<SliceReport> done_, state_;
    DatedFifo<TileNumber> contexts_;
    gscore::OrientedBoxes boxes_;
    gscore::LockstepArray array_;
    std::vector<std::vector<Feed>> feeds_;
    std::vector<std::unique_ptr<Process>> processes_;
    std::vector<std::unique_ptr<Script>> scripts_;
    std::vector<PixelValue> image_;
    std::size_t finished_ = 0;

public:
    std::vector<Cycle> tile_done, tile_state; ///< dates of the reports
    std::vector<bool> all_ended;
};

} // namespace degs::test
