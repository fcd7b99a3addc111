// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/drawing/drawing_thread.hpp"

#include <algorithm>
#include <chrono>

namespace degs {
namespace {

constexpr int kSpins =
    2000; // some 20 us: longer than most waits, and than it takes to sleep and wake
// What the simulation has given back when it is worth waking the thread that has no room.
constexpr std::size_t kWakingSheets = 16;
constexpr std::size_t kWakingTiles = 4;
// A cache line's worth, times two.
constexpr int kPrefetchedRows = 4;

void relax() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

std::uint64_t demand_for(TileNumber number, std::uint32_t sheet) {
    return std::uint64_t{number} << 32U | sheet;
}

} // namespace

DrawingThread::DrawingThread(RenderJob& job, const DrawingOptions& options)
    : job_(job), options_(options), canvases_(job, options.tests) {
    hand_over_joined();
    thread_ = std::thread([this] { run(); });
}

DrawingThread::~DrawingThread() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        stop_ = true;
    }
    wanted_.notify_one();
    thread_.join();
}

// The simulation's side: it reads what is published, and says what it has taken and what it waits
// for.

// The thread stands still while the list of tiles changes. All that have retired have been closed
// when it has heard of them.
void DrawingThread::hand_over_joined() {
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

PixelRange DrawingThread::rows(TileNumber number, std::uint32_t place) {
    if (number >= slots_end()) {
        hand_over_joined();
    }
    return sheet(number, place).splats[place % Sheet::kSplats].rows;
}

void DrawingThread::take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
                         DrawnRow* drawn) {
    Sheet& from = sheet(number, place);
    const Sheet::Splat& splat = from.splats[place % Sheet::kSplats];
    // Another processor has written the rows, and what comes next lies behind them.
    if (!from.drawn.empty()) {
        const DrawnRow* const behind = from.drawn.data() + splat.drawn + splat.rows.size();
        __builtin_prefetch(behind);
        __builtin_prefetch(behind + kPrefetchedRows);
    }
    from.copy(place, own, step, drawn);
    for (int row = own.first; row <= own.last; row += step, ++drawn) {
        count(*drawn);
    }
    if (--from.takes == 0) {
        tile(number)->sheets[place / Sheet::kSplats] = nullptr;
        asked_[number % kAsked].tile = kNoTile;
        const std::lock_guard<std::mutex> lock(mutex_);
        taken_sheets_.push_back(&from);
        wake_if_useful();
    }
}

void DrawingThread::read_row(TileNumber number, int row, int count, PixelValue* pixels) {
    await(number, kWholeTile, [this, number] {
        const Tile* drawn = tile(number);
        return drawn != nullptr && drawn->final.load();
    });
    const Tile& drawn = *tile(number);
    std::copy_n(drawn.pixels.begin() + std::ptrdiff_t{row} * drawn.job.width, count, pixels);
}

void DrawingThread::clear_row(TileNumber number, int /*row*/) {
    if (++tile(number)->cleared != job_.tile_size) {
        return;
    }
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        cleared_tiles_.push_back(number);
        wake_if_useful();
    }
    if (slots_end() < job_.tiles.size()) { // another frame is there to be drawn ahead
        hand_over_joined();
    }
}

DrawingThread::Sheet& DrawingThread::sheet(TileNumber number, std::uint32_t place) {
    const std::uint32_t index = place / Sheet::kSplats;
    Asked& asked = asked_[number % kAsked];
    if (asked.tile == number && asked.index == index) {
        return *asked.sheet;
    }
    const Slot& slot = this->slot(number);
    await(number, index, [&slot, index] {
        const Tile* drawn = slot.open.load();
        return drawn != nullptr && drawn->ready.load() > index;
    });
    asked = {number, index, tile(number)->sheets[index]};
    return *asked.sheet;
}

// A demand is taken back when it is met, because the tile may then be closed at any time.
template <class Ready>
void DrawingThread::await(TileNumber number, std::uint32_t sheet, const Ready& ready) {
    if (ready()) {
        return;
    }
    demand_ = demand_for(number, sheet);
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

// With the mutex.
void DrawingThread::wake_if_useful() {
    if (thread_sleeps_ &&
        (taken_sheets_.size() >= kWakingSheets || cleared_tiles_.size() >= kWakingTiles)) {
        wanted_.notify_one();
    }
}

// The thread's side.

void DrawingThread::run() {
    try {
        for (Round round = Round::Drew; round != Round::Stops; round = draw()) {
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

// Nothing of the job that it looks at moves meanwhile.
DrawingThread::Round DrawingThread::draw() {
    const std::lock_guard<TurnMutex> lock(*job_.changes);
    if (!receive()) {
        return Round::Stops;
    }
    return serve_demand() || draw_ahead() ? Round::Drew : Round::Idle;
}

// What the simulation has given back. False at the end.
bool DrawingThread::receive() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        received_sheets_.swap(taken_sheets_);
        received_tiles_.swap(cleared_tiles_);
        joined_ = false;
        if (stop_) {
            return false;
        }
    }
    for (Sheet* sheet : received_sheets_) {
        recycle(*sheet);
    }
    for (const TileNumber number : received_tiles_) {
        close(number);
    }
    received_sheets_.clear();
    received_tiles_.clear();
    return true;
}

// One sheet of what the simulation waits for. False if it waits for nothing, or is about to see
// that it need not.
bool DrawingThread::serve_demand() {
    const std::uint64_t demand = demand_;
    if (demand == kNoDemand || demand == met_) {
        return false;
    }
    const auto number = static_cast<TileNumber>(demand >> 32U);
    Tile& tile = open(number);
    const auto sheet = static_cast<std::uint32_t>(demand);
    const bool met = sheet == kWholeTile ? tile.final.load() : tile.ready.load() > sheet;
    if (met) {
        met_ = demand;
    } else {
        draw_sheet(tile);
    }
    return !met;
}

bool DrawingThread::draw_ahead() {
    if (bytes_ >= kMostBytes || open_tiles_ >= kMostTiles) {
        return false;
    }
    for (; next_ < slots_end(); ++next_) {
        if (slot(next_).passed) {
            continue;
        }
        Tile& tile = open(next_);
        if (!tile.listed() && tile.sheets_after_end < Sheet::kSheetsAfterEnd) {
            draw_sheet(tile);
            return true;
        }
    }
    return false;
}

void DrawingThread::rest() {
    std::unique_lock<std::mutex> lock(mutex_);
    thread_sleeps_ = true;
    wanted_.wait(lock, [this] {
        return stop_ || (demand_ != kNoDemand && demand_ != met_) ||
               taken_sheets_.size() >= kWakingSheets || cleared_tiles_.size() >= kWakingTiles ||
               joined_;
    });
    thread_sleeps_ = false;
}

DrawingThread::Tile& DrawingThread::open(TileNumber number) {
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
    tile.canvas = canvases_.open();
    tile.live = tile.job.pixels();
    tile.sheets_after_end = 0;
    tile.sheets.assign(Sheet::sheets_of(tile.job), nullptr);
    tile.ready = 0;
    tile.final = false;
    tile.cleared = 0;
    ++open_tiles_;
    publish(slot.open, &tile);
    return tile;
}

void DrawingThread::close(TileNumber number) {
    Slot& slot = this->slot(number);
    Tile& tile = *slot.open.exchange(nullptr);
    slot.passed = true;
    for (Sheet* sheet : tile.sheets) {
        if (sheet != nullptr) {
            recycle(*sheet);
        }
    }
    for (int row = 0; row < job_.tile_size; ++row) {
        canvases_.clear_row(tile.canvas, row);
    }
    canvases_.close(tile.canvas);
    bytes_ -= tile.pixel_bytes();
    tile.pixels.clear();
    free_tiles_.push_back(&tile);
    --open_tiles_;
}

void DrawingThread::draw_sheet(Tile& tile) {
    const std::uint32_t index = tile.ready;
    Sheet& sheet = blank_sheet();
    sheet.draw(job_, tile.job, index, options_, canvases_, tile.canvas);
    tile.live -= sheet.ended_pixels();
    tile.sheets_after_end += tile.live == 0 ? 1 : 0;
    bytes_ += sheet.bytes();
    tile.sheets[index] = &sheet;
    publish(tile.ready, index + 1);
    if (!tile.final && (tile.live == 0 || tile.listed())) {
        fix_pixels(tile);
    }
}

void DrawingThread::fix_pixels(Tile& tile) {
    const JobTile& job = tile.job;
    tile.pixels.resize(std::size_t{1} * job.width * job.height);
    for (int row = 0; row < job.height; ++row) {
        canvases_.read_row(tile.canvas, row, job.width,
                           &tile.pixels[std::size_t{1} * row * job.width]);
    }
    bytes_ += tile.pixel_bytes();
    publish(tile.final, true);
}

DrawingThread::Sheet& DrawingThread::blank_sheet() {
    if (free_sheets_.empty()) {
        free_sheets_.push_back(all_sheets_.emplace_back(std::make_unique<Sheet>()).get());
    }
    Sheet& sheet = *free_sheets_.back();
    free_sheets_.pop_back();
    return sheet;
}

void DrawingThread::recycle(Sheet& sheet) {
    bytes_ -= sheet.bytes();
    sheet.drawn.clear();
    free_sheets_.push_back(&sheet);
}

// Either the simulation sees the value before it goes to sleep, or this sees that it sleeps.
template <class Value>
void DrawingThread::publish(std::atomic<Value>& place, Value value) {
    place = value;
    if (simulation_sleeps_) {
        const std::lock_guard<std::mutex> lock(mutex_);
        published_.notify_one();
    }
}

} // namespace degs
