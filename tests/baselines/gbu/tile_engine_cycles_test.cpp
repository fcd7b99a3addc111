// SPDX-License-Identifier: Apache-2.0
// The tile engine works with dates in closed form. Here the same rule is played cycle by cycle and
// pixel by pixel, and both must agree on every date and count.
#include <deque>
#include <sstream>

#include "tests/baselines/gbu/tile_engine_bench.hpp"

namespace degs {
namespace {

using test::ChunkFeed;
using test::TileEngineBench;

class Ticks {
public:
    std::vector<Cycle> tile_done;
    gbu::TileEngine::Stats stats;

    Ticks(const gbu::TileEngine::Config& config, const FrameWorkload& frame,
          const std::vector<ChunkFeed>& feed)
        : config_(config), frame_(frame), feed_(feed),
          job_(make_render_job({&frame},
                               {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}}, 1)),
          pes_(static_cast<std::size_t>(config.row_pes)),
          rows_(static_cast<std::size_t>(job_.tile_size)) {
        for (now_ = 0; !finished_; ++now_) {
            for (Pe& pe : pes_) {
                step(pe);
            }
            while (generate()) {
            }
        }
    }

private:
    struct Interval { // row and column inside the tile
        std::uint32_t splat = 0;
        int row = 0, column = 0, length = 0;
    };
    struct Entry {
        Interval pixels;
        Cycle visible = 0;
    };
    struct Pe {
        std::deque<Entry> queue;
        bool busy = false;
        Entry current{};
        int done = 0;      // pixels of the current entry, one more with the probe
        bool slot = false; // in this cycle
    };
    struct Row {
        int live = 0;
        Cycle ended = kNever;
    };

    void step(Pe& pe) {
        while (!pe.busy && !pe.queue.empty() && pe.queue.front().visible <= now_) {
            pe.current = pe.queue.front();
            pe.queue.pop_front();
            pe.done = 0;
            pe.busy = rows_[static_cast<std::size_t>(pe.current.pixels.row)].live != 0;
            stats.entries += pe.busy ? 1 : 0;
            stats.entries_dropped += pe.busy ? 0 : 1;
        }
        pe.slot = pe.busy;
        if (!pe.busy) {
            return;
        }
        stats.window.include(now_);
        if (pe.done == pe.current.pixels.length) {
            stats.slots[Slot::Boundary]++;
        } else {
            stats.pixels++;
            pixel(pe.current.pixels, pe.done);
        }
        ++pe.done;
        pe.busy = pe.done < pe.current.pixels.length + (config_.end_probe ? 1 : 0);
    }
    void pixel(const Interval& pixels, int n) {
        PixelTest test;
        test.splat = pixels.splat;
        test.mask = 1;
        test.row = static_cast<std::int16_t>(pixels.row);
        test.column = static_cast<std::int16_t>(pixels.column + n);
        test.x = tile_->x + test.column;
        test.y = tile_->y + pixels.row;
        const BlendOutcome outcome = job_.path->test(test);
        stats.slots[Slot::Useful] += outcome.useful;
        stats.slots[Slot::Boundary] += outcome.boundary;
        stats.slots[Slot::Terminated] += outcome.terminated;
        stats.pixels_ended += outcome.ended;
        Row& row = rows_[static_cast<std::size_t>(pixels.row)];
        if (outcome.ended != 0 && --row.live == 0) {
            row.ended = now_ + static_cast<Cycle>(config_.termination_cycles);
            if (--live_rows_ == 0) {
                ended_ = row.ended;
                tile_done.push_back(now_ + static_cast<Cycle>(config_.row_pe_latency));
            }
        }
    }

    // True: something changed that costs no time.
    bool generate() {
        if (tile_ == nullptr) {
            return start_tile();
        }
        if (generated_) {
            return end_tile();
        }
        if (waiting_) {
            solve();
            push();
            return false;
        }
        if (!loaded_) {
            loaded_ = ready(feed_[chunk_]);
            taken_ = 0;
            return loaded_;
        }
        const ChunkFeed& chunk = feed_[chunk_];
        if (taken_ == chunk.count || ended_ <= now_) {
            stats.splats_abandoned += chunk.count - taken_;
            generated_ = chunk.last;
            loaded_ = false;
            ++chunk_;
            return taken_ != 0;
        }
        open(frame_.tile_splats[chunk.first + taken_++]);
        return true;
    }
    bool ready(const ChunkFeed& chunk) const {
        return chunk.date + static_cast<Cycle>(config_.generation_latency) <= now_;
    }
    bool start_tile() {
        if (chunk_ == feed_.size()) {
            finished_ = true;
            return false;
        }
        if (!ready(feed_[chunk_]) || (!tile_done.empty() && tile_done.back() + 1 > now_)) {
            return false;
        }
        tile_ = &job_.tiles[feed_[chunk_].tile];
        live_rows_ = tile_->height;
        ended_ = kNever;
        generated_ = false;
        for (int y = 0; y < job_.tile_size; ++y) {
            job_.path->begin_row(0, y);
            const bool inside = y < tile_->height;
            rows_[static_cast<std::size_t>(y)] = {inside ? tile_->width : 0, inside ? kNever : 0};
        }
        return true;
    }
    bool end_tile() {
        for (const Pe& pe : pes_) {
            if (pe.busy || pe.slot || !pe.queue.empty()) {
                return false;
            }
        }
        if (live_rows_ != 0) {
            tile_done.push_back(
                std::max(now_ - 1 + static_cast<Cycle>(config_.row_pe_latency), now_ + 1));
        }
        tile_ = nullptr;
        stats.tiles++;
        return true;
    }
    void open(std::uint32_t splat) {
        stats.splats++;
        waiting_ = true;
        pending_.clear();
        splat_ = splat;
        unsolved_ = job_.path->tested_rows(splat, tile_->columns(), tile_->rows());
    }
    // The rows of this cycle; those that have ended take no solver.
    void solve() {
        const int x_end = tile_->x + tile_->width;
        for (int solved = 0; !unsolved_.empty();) {
            const int y = unsolved_.first;
            if (rows_[static_cast<std::size_t>(y - tile_->y)].ended <= now_) {
                stats.rows_skipped++;
            } else if (config_.rows_per_cycle != 0 && solved == config_.rows_per_cycle) {
                return;
            } else {
                const PixelRange pixels = job_.path->tested_columns(splat_, y, tile_->x, x_end);
                if (!pixels.empty()) {
                    pending_.push_back(
                        {splat_, y - tile_->y, pixels.first - tile_->x, pixels.size()});
                }
                ++solved;
            }
            ++unsolved_.first;
        }
    }
    void push() {
        std::vector<Interval> left;
        for (const Interval& pixels : pending_) {
            Pe& pe = pes_[static_cast<std::size_t>(pixels.row % config_.row_pes)];
            if (rows_[static_cast<std::size_t>(pixels.row)].ended <= now_) {
                stats.entries_dropped++;
            } else if (pe.queue.size() < static_cast<std::size_t>(config_.queue_depth)) {
                pe.queue.push_back({pixels, now_ + 1});
            } else {
                left.push_back(pixels);
            }
        }
        pending_ = left;
        stats.queue_wait += unsolved_.empty() && !pending_.empty() ? 1 : 0;
        waiting_ = !pending_.empty() || !unsolved_.empty();
    }

    gbu::TileEngine::Config config_;
    const FrameWorkload& frame_;
    std::vector<ChunkFeed> feed_;
    RenderJob job_;
    std::vector<Pe> pes_;
    std::vector<Row> rows_;
    Cycle now_ = 0;
    bool finished_ = false;
    // Row Generation
    std::size_t chunk_ = 0;
    std::uint32_t taken_ = 0;
    bool loaded_ = false, generated_ = false, waiting_ = false;
    std::uint32_t splat_ = 0;
    PixelRange unsolved_;
    std::vector<Interval> pending_;
    // The tile
    const JobTile* tile_ = nullptr;
    int live_rows_ = 0;
    Cycle ended_ = kNever;
};

class SmallRunTileEngineCycles : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunTileEngineCycles, AgreeWithTheClosedForm) {
    std::mt19937 random(GetParam());
    const auto upto = [&random](unsigned n) { return static_cast<int>(random() % n); };
    gbu::TileEngine::Config config;
    const int tile = upto(4) == 0 ? 40 : 16; // 40: intervals longer than one call takes
    config.row_pes = upto(3) == 0 ? 1 + upto(tile) : tile;
    config.rows_per_cycle = upto(2) == 0 ? 0 : 1 + upto(9);
    config.queue_depth = 1 + upto(upto(2) == 0 ? 3 : 20);
    config.generation_latency = upto(10);
    config.row_pe_latency = 1 + upto(12);
    config.termination_cycles = 1 + upto(upto(2) == 0 ? 1 : 60);
    config.end_probe = upto(3) != 0;
    TileEngineBench bench(
        config, test::random_frame(GetParam(), 1 + upto(70), 1 + upto(50), tile, 1 + upto(300)));
    std::vector<ChunkFeed> feed;
    Cycle date = 1;
    for (TileNumber t = 0; t < bench.job.tiles.size(); ++t) {
        const JobTile& listed = bench.job.tiles[t];
        for (std::uint64_t at = 0; at < listed.count;) {
            const auto count = static_cast<std::uint32_t>(
                std::min<std::uint64_t>(listed.count - at, static_cast<unsigned>(upto(20))));
            feed.push_back({date, t, listed.first + at, count, at + count == listed.count});
            at += count;
            date += 1 + static_cast<Cycle>(upto(upto(5) == 0 ? 200 : 10));
        }
    }
    std::ostringstream shape;
    shape << tile << " px, " << config.row_pes << " PEs, queue " << config.queue_depth
          << ", termination " << config.termination_cycles;
    SCOPED_TRACE(shape.str());
    bench.run(feed);
    bench.expect_reference();
    const Ticks ticks(config, bench.frame, feed);
    const gbu::TileEngine::Stats& fast = bench.stats();
    const gbu::TileEngine::Stats& slow = ticks.stats;
    ASSERT_EQ(ticks.tile_done.size(), bench.units[0]->tile_done.size());
    for (std::size_t t = 0; t < ticks.tile_done.size(); ++t) {
        EXPECT_EQ(bench.done(t), ticks.tile_done[t]) << "tile " << t;
    }
    EXPECT_EQ(fast.window.first, slow.window.first);
    EXPECT_EQ(fast.window.last, slow.window.last);
    EXPECT_EQ(fast.slots[Slot::Useful], slow.slots[Slot::Useful]);
    EXPECT_EQ(fast.slots[Slot::Boundary], slow.slots[Slot::Boundary]);
    EXPECT_EQ(fast.slots[Slot::Terminated], slow.slots[Slot::Terminated]);
    EXPECT_EQ(fast.splats, slow.splats);
    EXPECT_EQ(fast.splats_abandoned, slow.splats_abandoned);
    EXPECT_EQ(fast.entries, slow.entries);
    EXPECT_EQ(fast.pixels, slow.pixels);
    EXPECT_EQ(fast.entries_dropped, slow.entries_dropped);
    EXPECT_EQ(fast.rows_skipped, slow.rows_skipped);
    EXPECT_EQ(fast.pixels_ended, slow.pixels_ended);
    EXPECT_EQ(fast.queue_wait, slow.queue_wait);
    EXPECT_EQ(fast.tiles, slow.tiles);
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunTileEngineCycles, ::testing::Range(0U, 60U));

} // namespace
} // namespace degs
