// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/functional/row_batch.hpp"
#include "modules/degs/functional/tile_contexts.hpp"

namespace degs {

/// Rasterises tile after tile on a thread of its own, some tiles ahead of the simulation. A tile is
/// rasterised until all its pixels have ended, and a little further, because the Slicing Units
/// go on until they hear of that. If the simulation asks for rows beyond that, the thread
/// rasterises them on demand. The outcomes wait in memory, of which the thread takes a bounded
/// amount.
///
/// The thread owns the pixels of the data path. It publishes batches of rows, and the pixels of
/// tiles that will not change; the simulation reads nothing else. Whenever the thread rasterises,
/// it holds RenderJob::changes, so that no tile is added or removed meanwhile.
class FunctionalThread final : public FunctionalModel {
public:
    FunctionalThread(RenderJob& job, const FunctionalOptions& options);
    ~FunctionalThread() override;

    PixelRange rows(TileNumber number, std::uint32_t place) override;
    void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
              RowOutcome* outcomes) override;
    void read_row(TileNumber number, int row, int count, PixelValue* pixels) override;
    void clear_row(TileNumber number, int row) override;
    double waited_s() const override { return waited_s_; }

private:
    static constexpr std::size_t kMostBytes = std::size_t{4} << 20U; // of outcomes ahead
    static constexpr std::size_t kMostTiles = 64; // open at a time, ahead of the simulation
    static constexpr std::uint64_t kNoDemand = ~std::uint64_t{0};
    static constexpr std::uint32_t kWholeTile = ~std::uint32_t{0}; // in place of a batch

    /// A tile that is being rasterised, or whose outcomes the simulation has not taken yet.
    struct Tile {
        JobTile job;
        int context = 0;
        std::int64_t live = 0;               // pixels that have not ended
        int batches_after_end = 0;           // from the one in which the last pixel ended on
        std::vector<RowBatch*> batches;      // of the whole list; nullptr: taken, or not there yet
        std::atomic<std::uint32_t> ready{0}; // batches that are published
        std::vector<PixelValue> pixels;      // row by row; filled when the tile is final
        std::atomic<bool> final{false};      // no pixel changes any more
        int cleared = 0;                     // rows that the simulation has cleared
        bool listed() const { return ready.load(std::memory_order_relaxed) == batches.size(); }
        std::size_t pixel_bytes() const { return pixels.size() * sizeof(PixelValue); }
    };

    /// A tile of the job, in whatever state it is.
    struct Slot {
        explicit Slot(const JobTile& listed) : job(listed) {}
        JobTile job;
        std::atomic<Tile*> open{nullptr}; // nullptr: not begun yet, or closed
        bool passed = false;              // it has been closed; only the thread reads this
    };

    /// The batch of a tile that the simulation has asked for last, unless all of it has been taken.
    struct Asked {
        TileNumber tile = kNoTile;
        std::uint32_t index = 0;
        RowBatch* batch = nullptr;
    };
    static constexpr std::size_t kAsked = 64; // mostly more than the tiles that are sliced at once

    // The simulation's side.
    void hand_over_joined();
    std::size_t slots_end() const { return first_slot_ + slots_.size(); }
    Slot& slot(TileNumber number) { return slots_[number - first_slot_]; }
    Tile* tile(TileNumber number) { return slot(number).open.load(); }
    RowBatch& batch(TileNumber number, std::uint32_t place);
    template <class Ready>
    void await(TileNumber number, std::uint32_t batch, const Ready& ready);
    void wake_if_useful();

    // The thread's side.
    enum class Round { Worked, Idle, Stops };
    void run();
    Round work();
    bool receive();
    bool serve_demand();
    bool run_ahead();
    void rest();
    Tile& open(TileNumber number);
    void close(TileNumber number);
    void rasterise_batch(Tile& tile);
    void fix_pixels(Tile& tile);
    RowBatch& empty_batch();
    void recycle(RowBatch& batch);
    template <class Value>
    void publish(std::atomic<Value>& place, Value value);

    RenderJob& job_;
    FunctionalOptions options_;
    std::deque<Slot> slots_; // by tile; changed only by who holds RenderJob::changes
    std::size_t first_slot_ = 0;
    std::array<Asked, kAsked> asked_; // a tile is at its number modulo kAsked
    double waited_s_ = 0;

    TileContexts contexts_;
    std::vector<std::unique_ptr<Tile>> all_tiles_;
    std::vector<std::unique_ptr<RowBatch>> all_batches_;
    std::vector<Tile*> free_tiles_;
    std::vector<RowBatch*> free_batches_;
    TileNumber next_ = 0; // the tile that is rasterised ahead
    std::size_t bytes_ = 0, open_tiles_ = 0;
    std::uint64_t met_ = kNoDemand; // the latest demand that was found met
    std::vector<RowBatch*> received_batches_;
    std::vector<TileNumber> received_tiles_;

    std::atomic<std::uint64_t> demand_{kNoDemand}; // tile and batch for which the simulation waits
    std::atomic<bool> simulation_sleeps_{false}, thread_sleeps_{false};
    std::mutex mutex_; // for both to sleep, and of all that follows
    std::condition_variable published_, wanted_;
    std::vector<RowBatch*> taken_batches_;
    std::vector<TileNumber> cleared_tiles_;
    bool joined_ = false;
    std::exception_ptr failure_;
    bool stop_ = false;
    std::thread thread_; // starts when everything else is there
};

} // namespace degs
