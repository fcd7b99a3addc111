// SPDX-License-Identifier: Apache-2.0
// Tile engines of GBU between scripts: chunks come at chosen dates,
// contexts go back at chosen dates.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/gbu/tile_engine.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {

/// The engine's own cycles are 1, so that dates are easy to follow.
inline gbu::TileEngine::Config small_engine(int row_pes = 16) {
    gbu::TileEngine::Config c;
    c.row_pes = row_pes;
    c.rows_per_cycle = 0;
    c.generation_latency = 3;
    c.row_pe_latency = 5;
    return c;
}

/// Splats `count` of a tile from its list entry `first` on, readable from `date` on.
struct ChunkFeed {
    Cycle date;
    TileNumber tile;
    std::uint64_t first;
    std::uint32_t count;
    bool last;
};

struct TileEngineBench {
    struct Unit {
        DatedFifo<SplatChunk> in;
        DatedFifo<TileNumber> contexts;
        DatedFifo<SliceReport> done, state;
        gbu::TileEngine engine;
        Process feeder, pixels, monitor;
        std::vector<std::pair<Cycle, SliceReport>> tile_done, tile_state;
        Unit(const std::string& name, const gbu::TileEngine::Config& config, const Timebase& time,
             RenderJob& job, int first_context, int contexts_count)
            : in((name + "_in").c_str(), time, 1024), contexts((name + "_ctx").c_str(), time, 64),
              done((name + "_done").c_str(), time, 64), state((name + "_state").c_str(), time, 64),
              engine(name.c_str(), config, time, job, first_context, contexts_count), feeder(time),
              pixels(time), monitor(time) {
            engine.in.bind(in);
            engine.context_free.bind(contexts);
            engine.tile_done.bind(done);
            engine.tile_state.bind(state);
        }
    };

    gbu::TileEngine::Config config;
    Timebase time;
    FrameWorkload frame;
    RenderJob job;
    int contexts;
    Image image;
    std::vector<std::unique_ptr<Unit>> units;
    std::vector<std::unique_ptr<Script>> scripts;
    /// Date of the context message after the n-th tile of an engine; beyond the list at once.
    std::vector<Cycle> context_dates;

    TileEngineBench(const gbu::TileEngine::Config& c, FrameWorkload work, int engines = 1,
                    int contexts_each = 1, Fidelity fidelity = Fidelity::Exact)
        : config(c), time{ClockDomain(1.0), fidelity}, frame(std::move(work)),
          job(make_render_job({&frame},
                              {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}},
                              engines * contexts_each)),
          contexts(contexts_each), image(frame.camera.width, frame.camera.height) {
        for (int e = 0; e < engines; ++e) {
            units.push_back(std::make_unique<Unit>("engine" + std::to_string(e), c, time, job,
                                                   e * contexts, contexts));
        }
        for (int context = 0; context < engines * contexts; ++context) {
            clear(context);
        }
    }
    void clear(int context) {
        for (int row = 0; row < job.tile_size; ++row) {
            job.path->begin_row(context, row);
        }
    }
    /// Whole lists of these tiles, a chunk each, all there at `date`.
    std::vector<ChunkFeed> lists(const std::vector<TileNumber>& tiles, Cycle date = 1) const {
        std::vector<ChunkFeed> feed;
        for (const TileNumber t : tiles) {
            feed.push_back({date, t, job.tiles[t].first,
                            static_cast<std::uint32_t>(job.tiles[t].count), true});
        }
        return feed;
    }
    /// `feeds[e]` goes to engine e; runs to the end.
    void run(const std::vector<std::vector<ChunkFeed>>& feeds) {
        for (std::size_t e = 0; e < units.size(); ++e) {
            script([this, e, feed = feeds.at(e)] { send(*units[e], feed); });
            script([this, e] { take_tiles(static_cast<int>(e)); });
            script([this, e] {
                Unit& u = *units[e];
                for (SliceReport r = u.state.get(u.monitor); r.tile != kNoTile;
                     r = u.state.get(u.monitor)) {
                    u.tile_state.emplace_back(u.monitor.local(), r);
                }
            });
        }
        sc_core::sc_start();
        std::size_t tiles = 0;
        for (std::size_t e = 0; e < units.size(); ++e) {
            tiles += units[e]->tile_done.size();
            EXPECT_EQ(units[e]->tile_state.size(), units[e]->tile_done.size());
            expect_sound(*units[e]);
        }
        std::size_t ends = 0;
        for (const auto& feed : feeds) {
            for (const ChunkFeed& chunk : feed) {
                ends += chunk.last ? 1 : 0;
            }
        }
        EXPECT_EQ(tiles, ends) << "the bench did not come to its end";
    }
    void run(const std::vector<ChunkFeed>& feed) { run(std::vector<std::vector<ChunkFeed>>{feed}); }

    const gbu::TileEngine::Stats& stats(std::size_t e = 0) const {
        return units[e]->engine.stats();
    }
    /// Date at which the first splat of a list that is there at `date` is pushed.
    Cycle first_push(Cycle date = 1) const {
        return date + static_cast<Cycle>(config.generation_latency);
    }
    Cycle done(std::size_t tile = 0) const { return units[0]->tile_done.at(tile).first; }

    void expect_reference() {
        ReferenceCounts counts;
        const Image reference = render_reference(frame, counts);
        std::uint64_t useful = 0;
        for (const auto& unit : units) {
            useful += unit->engine.stats().slots[Slot::Useful];
        }
        EXPECT_EQ(useful, counts.fragments);
        EXPECT_EQ(image.fragments, reference.fragments);
        ASSERT_EQ(image.rgb.size(), reference.rgb.size());
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            // Both are doubles rounded to float: a last-place difference of the doubles may show.
            ASSERT_NEAR(image.rgb[i], reference.rgb[i], 1e-12 + 6e-8 * reference.rgb[i]) << i;
        }
    }

private:
    void expect_sound(const Unit& u) {
        const gbu::TileEngine::Stats& s = u.engine.stats();
        const SlotAccount& slots = s.slots;
        EXPECT_EQ(slots.total(), s.window.cycles() * static_cast<std::uint64_t>(config.row_pes));
        EXPECT_EQ(slots[Slot::Useful] + slots[Slot::Boundary] + slots[Slot::Terminated],
                  s.pixels + (config.end_probe ? s.entries : 0));
        EXPECT_EQ(slots[Slot::Conflict] + slots[Slot::Drain], 0U);
    }
    void script(const std::function<void()>& body) {
        scripts.push_back(
            std::make_unique<Script>(("script" + std::to_string(scripts.size())).c_str(), body));
    }
    void send(Unit& u, const std::vector<ChunkFeed>& feed) {
        u.in.connect_writer(u.feeder);
        for (const ChunkFeed& f : feed) {
            u.in.put_at(u.feeder, {f.tile, f.first, f.count, f.last}, f.date);
        }
        u.in.put(u.feeder, {kNoTile, 0, 0, true});
        u.feeder.finish();
    }
    void take_tiles(int e) {
        Unit& u = *units[static_cast<std::size_t>(e)];
        u.contexts.connect_writer(u.pixels);
        for (SliceReport r = u.done.get(u.pixels); r.tile != kNoTile; r = u.done.get(u.pixels)) {
            const int context = e * contexts + static_cast<int>(u.tile_done.size()) % contexts;
            copy_out(r.tile, context);
            clear(context);
            u.tile_done.emplace_back(u.pixels.local(), r);
            if (u.tile_done.size() <= context_dates.size()) {
                u.pixels.advance_to(context_dates[u.tile_done.size() - 1] - 1);
            }
            u.contexts.put(u.pixels, 0);
        }
        u.pixels.finish();
    }
    void copy_out(TileNumber number, int context) {
        const JobTile& tile = job.tiles[number];
        std::vector<PixelValue> row(static_cast<std::size_t>(tile.width));
        for (int y = 0; y < tile.height; ++y) {
            job.path->read_row(context, y, tile.width, row.data());
            for (int x = 0; x < tile.width; ++x) {
                const PixelValue& pixel = row[static_cast<std::size_t>(x)];
                const std::size_t i = image.at(tile.x + x, tile.y + y);
                for (std::size_t c = 0; c < 3; ++c) {
                    image.rgb[i * 3 + c] = static_cast<float>(pixel.rgb[c]);
                }
                image.fragments[i] = pixel.updates;
            }
        }
    }
};

} // namespace degs::test
