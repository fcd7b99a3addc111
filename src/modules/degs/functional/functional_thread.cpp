// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/functional_thread.hpp"

#include <algorithm>
#include <chrono>

namespace degs {
namespace {

constexpr int kSpins =
    2000; // some 20 us: longer than most waits, and than it takes to sleep and wake
// A thread that has no room is woken once the simulation has given back so much, because waking it
// takes time, too.
constexpr std::size_t kWakingBatches = 16;
constexpr std::size_t kWakingTiles = 4;
// Rows that are prefetched beyond those that are taken: about two cache lines.
constexpr int kPrefetchedRows = 4;

void relax() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

std::uint64_t demand_for(TileNumber number, std::uint32_t batch) {
    return std::uint64_t{number} << 32U | batch;
}

} // namespace

FunctionalThread::FunctionalThread(RenderJob& job, const FunctionalOptions& options)
    : job_(job), options_(options), contexts_(job, options.tests) {
    hand_over_joined();
    thread_ = std::thread([this] { run(); });
}

FunctionalThread::~FunctionalThread() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        stop_ = true;
    }
    wanted_.notify_one();
    thread_.join();
}

// The simulation's side: it reads what is published, and says what it has taken and what it waits
// for.

// Takes over the tiles that have joined the job, and drops those that have retired: receive() has
// closed these. The lock keeps the thread still, because both sides read the list of tiles.
void FunctionalThread::hand_over_joined() {
    {
        const std::lock_guard<TurnMutex> lock(*job_.changes);
        receive();
        while (slots_end() < job_.tiles.size()) {
            slots_.emplace_back(job_.tiles[slots_end()]);
        }
        for (; first_slot_ < job_.tiles.first(); ++first_slot_) {
            slots_.pop_front();
        }
        next_ = std::max(next_, static_cast<TileNumber>(first_slot_));
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    joined_ = true;
    wanted_.notify_one();
}

PixelRange FunctionalThread::rows(TileNumber number, std::uint32_t place) {
    if (number >= slots_end()) {
        hand_over_joined();
    }
    return batch(number, place).splats[place % RowBatch::kSplats].rows;
}

void FunctionalThread::take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
                            RowOutcome* outcomes) {
    RowBatch& from = batch(number, place);
    const RowBatch::Splat& splat = from.splats[place % RowBatch::kSplats];
    // Another processor has written these rows, and the next ones lie behind them.
    if (!from.outcomes.empty()) {
        const RowOutcome* const behind = from.outcomes.data() + splat.first + splat.rows.size();
        __builtin_prefetch(behind);
        __builtin_prefetch(behind + kPrefetchedRows);
    }
    from.copy(place, own, step, outcomes);
    for (int row = own.first; row <= own.last; row += step, ++outcomes) {
        count(*outcomes);
    }
    if (--from.takes == 0) {
        tile(number)->batches[place / RowBatch::kSplats] = nullptr;
        asked_[number % kAsked].tile = kNoTile;
        const std::lock_guard<std::mutex> lock(mutex_);
        taken_batches_.push_back(&from);
        wake_if_useful();
    }
}

void FunctionalThread::read_row(TileNumber number, int row, int count, PixelValue* pixels) {
    await(number, kWholeTile, [this, number] {
        const Tile* opened = tile(number);
        return opened != nullptr && opened->final.load();
    });
    const Tile& finished = *tile(number);
    std::copy_n(finished.pixels.begin() + std::ptrdiff_t{row} * finished.job.width, count, pixels);
}

void FunctionalThread::clear_row(TileNumber number, int /*row*/) {
    if (++tile(number)->cleared != job_.tile_size) {
        return;
    }
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        cleared_tiles_.push_back(number);
        wake_if_useful();
    }
    if (slots_end() < job_.tiles.size()) { // another frame has come, which can be rasterised ahead
        hand_over_joined();
    }
}

RowBatch& FunctionalThread::batch(TileNumber number, std::uint32_t place) {
    const std::uint32_t index = place / RowBatch::kSplats;
    Asked& asked = asked_[number % kAsked];
    if (asked.tile == number && asked.index == index) {
        return *asked.batch;
    }
    const Slot& slot = this->slot(number);
    await(number, index, [&slot, index] {
        const Tile* opened = slot.open.load();
        return opened != nullptr && opened->ready.load() > index;
    });
    asked = {number, index, tile(number)->batches[index]};
    return *asked.batch;
}

// A demand is taken back when it is met, because the tile may then be closed at any time.
template <class Ready>
void FunctionalThread::await(TileNumber number, std::uint32_t batch, const Ready& ready) {
    if (ready()) {
        return;
    }
    demand_ = demand_for(number, batch);
    if (thread_sleeps_) {
        const std::lock_guard<std::mutex> lock(mutex_);
        wanted_.notify_one();
    }
    for (int spin = 0; spin < kSpins && !ready(); ++spin) {
        relax();
    }
    if (!ready()) {
        const auto since = std::chrono::steady_clock::now();
        std::unique_lock<std::mutex> lock(mutex_);
        simulation_sleeps_ = true;
        published_.wait(lock, [&] { return failure_ != nullptr || ready(); });
        simulation_sleeps_ = false;
        waited_s_ +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
        if (failure_ != nullptr) {
            std::rethrow_exception(failure_);
        }
    }
    demand_ = kNoDemand;
}

// The caller holds the mutex.
void FunctionalThread::wake_if_useful() {
    if (thread_sleeps_ &&
        (taken_batches_.size() >= kWakingBatches || cleared_tiles_.size() >= kWakingTiles)) {
        wanted_.notify_one();
    }
}

// The thread's side.

void FunctionalThread::run() {
    try {
        for (Round round = Round::Worked; round != Round::Stops; round = work()) {
            if (round == Round::Idle) {
                rest();
            }
        }
    } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failure_ = std::current_exception();
        published_.notify_one();
    }
}

// One step of the thread. The lock keeps the job's tiles and frames in place meanwhile.
FunctionalThread::Round FunctionalThread::work() {
    const std::lock_guard<TurnMutex> lock(*job_.changes);
    if (!receive()) {
        return Round::Stops;
    }
    return serve_demand() || run_ahead() ? Round::Worked : Round::Idle;
}

// Takes back the batches and tiles that the simulation no longer needs. False: the thread stops.
bool FunctionalThread::receive() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        received_batches_.swap(taken_batches_);
        received_tiles_.swap(cleared_tiles_);
        joined_ = false;
        if (stop_) {
            return false;
        }
    }
    for (RowBatch* batch : received_batches_) {
        recycle(*batch);
    }
    for (const TileNumber number : received_tiles_) {
        close(number);
    }
    received_batches_.clear();
    received_tiles_.clear();
    return true;
}

// Rasterises one batch of the tile that the simulation waits for. False if the simulation waits for
// nothing, or if what it waits for is there and it is about to see that.
bool FunctionalThread::serve_demand() {
    const std::uint64_t demand = demand_;
    if (demand == kNoDemand || demand == met_) {
        return false;
    }
    const auto number = static_cast<TileNumber>(demand >> 32U);
    Tile& tile = open(number);
    const auto batch = static_cast<std::uint32_t>(demand);
    const bool met = batch == kWholeTile ? tile.final.load() : tile.ready.load() > batch;
    if (met) {
        met_ = demand;
    } else {
        rasterise_batch(tile);
    }
    return !met;
}

bool FunctionalThread::run_ahead() {
    if (bytes_ >= kMostBytes || open_tiles_ >= kMostTiles) {
        return false;
    }
    for (; next_ < slots_end(); ++next_) {
        if (slot(next_).passed) {
            continue;
        }
        Tile& tile = open(next_);
        if (!tile.listed() && tile.batches_after_end < RowBatch::kBatchesAfterEnd) {
            rasterise_batch(tile);
            return true;
        }
    }
    return false;
}

void FunctionalThread::rest() {
    std::unique_lock<std::mutex> lock(mutex_);
    thread_sleeps_ = true;
    wanted_.wait(lock, [this] {
        return stop_ || (demand_ != kNoDemand && demand_ != met_) ||
               taken_batches_.size() >= kWakingBatches || cleared_tiles_.size() >= kWakingTiles ||
               joined_;
    });
    thread_sleeps_ = false;
}

FunctionalThread::Tile& FunctionalThread::open(TileNumber number) {
    Slot& slot = this->slot(number);
    if (Tile* tile = slot.open.load()) {
        return *tile;
    }
    if (free_tiles_.empty()) {
        free_tiles_.push_back(all_tiles_.emplace_back(std::make_unique<Tile>()).get());
    }
    Tile& tile = *free_tiles_.back();
    free_tiles_.pop_back();
    tile.job = slot.job;
    tile.context = contexts_.open();
    tile.live = tile.job.pixels();
    tile.batches_after_end = 0;
    tile.batches.assign(RowBatch::batches_of(tile.job), nullptr);
    tile.ready = 0;
    tile.final = false;
    tile.cleared = 0;
    ++open_tiles_;
    publish(slot.open, &tile);
    return tile;
}

void FunctionalThread::close(TileNumber number) {
    Slot& slot = this->slot(number);
    Tile& tile = *slot.open.exchange(nullptr);
    slot.passed = true;
    for (RowBatch* batch : tile.batches) {
        if (batch != nullptr) {
            recycle(*batch);
        }
    }
    for (int row = 0; row < job_.tile_size; ++row) {
        contexts_.clear_row(tile.context, row);
    }
    contexts_.close(tile.context);
    bytes_ -= tile.pixel_bytes();
    tile.pixels.clear();
    free_tiles_.push_back(&tile);
    --open_tiles_;
}

void FunctionalThread::rasterise_batch(Tile& tile) {
    const std::uint32_t index = tile.ready;
    RowBatch& batch = empty_batch();
    batch.rasterise(job_, tile.job, index, options_, contexts_, tile.context);
    tile.live -= batch.ended_pixels();
    tile.batches_after_end += tile.live == 0 ? 1 : 0;
    bytes_ += batch.bytes();
    tile.batches[index] = &batch;
    publish(tile.ready, index + 1);
    if (!tile.final && (tile.live == 0 || tile.listed())) {
        fix_pixels(tile);
    }
}

void FunctionalThread::fix_pixels(Tile& tile) {
    const JobTile& job = tile.job;
    tile.pixels.resize(std::size_t{1} * job.width * job.height);
    for (int row = 0; row < job.height; ++row) {
        contexts_.read_row(tile.context, row, job.width,
                           &tile.pixels[std::size_t{1} * row * job.width]);
    }
    bytes_ += tile.pixel_bytes();
    publish(tile.final, true);
}

RowBatch& FunctionalThread::empty_batch() {
    if (free_batches_.empty()) {
        free_batches_.push_back(all_batches_.emplace_back(std::make_unique<RowBatch>()).get());
    }
    RowBatch& batch = *free_batches_.back();
    free_batches_.pop_back();
    return batch;
}

void FunctionalThread::recycle(RowBatch& batch) {
    bytes_ -= batch.bytes();
    batch.outcomes.clear();
    free_batches_.push_back(&batch);
}

// No wake-up is lost: either the simulation sees the value before it goes to sleep, or the thread
// sees here that the simulation sleeps.
template <class Value>
void FunctionalThread::publish(std::atomic<Value>& place, Value value) {
    place = value;
    if (simulation_sleeps_) {
        const std::lock_guard<std::mutex> lock(mutex_);
        published_.notify_one();
    }
}

} // namespace degs
