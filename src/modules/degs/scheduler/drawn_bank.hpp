// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/degs/scheduler/cooling_places.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

/// The cycles of an Issue Bank with its Packing Unit where tasks are drawn (TileDrawing) and nothing limits
/// them but the queue, the scoreboard and the Packing Buffer: in one loop over little data, because these
/// cycles are half of a run. Segments carry masks, and packets are counted, not made. Every decision and date
/// is that of IssueBank and PackingUnit, which do the same for all other designs and in strict mode.
class DrawnBank {
public:
    /// True if the bank has one tile stream from one Span Unit, goes round robin, compacts, and has no limited
    /// ports and no filling of Feature Buffer entries, if the domains of all tiles in flight fit in a word, and if
    /// nobody records its tasks. The unit must hand its rows over, too; see DrawnSpans.
    static bool can_run(const IssueBank& bank);

    explicit DrawnBank(IssueBank& bank);
    DrawnBank(const DrawnBank&) = delete; // entries point at each other
    DrawnBank& operator=(const DrawnBank&) = delete;
    /// Runs the bank until the job is over.
    void run();

private:
    static constexpr int kPlaces = 64;
    static constexpr std::uint32_t kAllPixels = ~0U;

    struct Waiting {
        std::uint32_t mask, inside, useful, ended; // see DrawnTasks
        Waiting* next;
        std::uint16_t feature;
    };
    /// A conflict domain of a tile in flight.
    struct alignas(32) Place {
        Waiting* head = nullptr;
        Waiting** end = nullptr; // where the next one is linked
        std::uint32_t live = 0, ended = 0;
        std::int32_t executed = 0; // low bits of the date at which its latest task executes
    };
    struct Tile {
        std::uint64_t places = 0; // a bit each
        std::uint64_t later = 0;  // those behind the one that issued last
        int first = 0;            // place
        TileNumber number = kNoTile;
        std::int16_t context = 0;
    };

    // Intake.
    inline void accept();
    inline bool open_span();
    inline bool cut_segment();
    [[gnu::noinline]] void enter_tile(TileNumber number);
    [[gnu::noinline]] void end_pixels();
    [[gnu::noinline]] void see_contexts();
    void end_pixels(Place& place, std::uint32_t mask) const;
    void list_started();
    // A span that is there needs no proof.
    bool arrived() const {
        return spans_.empty() ? self_.arrived(spans_) : spans_.head_date() <= now_;
    }
    bool takes() const { return input_.turn == stream_.entering && stream_.enterable; }

    // Issue.
    inline int issue();
    inline bool issue_one(int number, Cycle slot);
    [[gnu::noinline]] std::uint32_t tasks_of(const Waiting& segment, std::uint32_t live);
    inline Cycle pack(int number, const Waiting& segment, std::uint32_t tasks, int count,
                      Cycle slot);
    [[gnu::noinline]] Cycle end_drawn(int number, const Waiting& segment, std::uint32_t tasks);
    inline void pop(int number);
    inline void send(int tasks);
    [[gnu::noinline]] void send_part(Slot cause);
    [[gnu::noinline]] void settle_idle();
    [[gnu::noinline]] bool finish_tiles();

    // Dates.
    Cycle next_execution() const { return std::max(now_ + latency_, next_slot_); }
    bool open() const { return tasks_ != 0; }
    Slot idle_cause() const;
    std::uint64_t issuable() const { return occupied_ & startable_; }
    [[gnu::noinline]] Cycle next_date();
    inline void close_cycles(Cycle until);

    Tile& tile_at(std::size_t turn) { return tiles_[turn & tile_mask_]; }
    Tile& tile_of(int place) { return tiles_[place / domains_]; }

    IssueBank& bank_;
    PackingUnit& packing_;
    ArraySlice& slice_;
    BankStream& stream_;
    BankStream::Input& input_;
    DrawnSpans& spans_;
    FeatureBuffer& features_;
    Process& self_;
    int domains_, segment_length_, segments_per_cycle_, spans_per_cycle_, issue_width_;
    Cycle reuse_, latency_;
    int width_;
    Cycle capacity_;

    std::vector<Waiting> pool_;
    Waiting* free_ = nullptr;
    std::size_t size_ = 0;              // segments that wait
    std::array<Place, kPlaces> places_; // tile by tile
    std::uint64_t occupied_ = 0;        // places that have segments
    std::uint64_t startable_ = 0;       // places of tiles that may issue
    CoolingPlaces cooling_;
    std::vector<Tile> tiles_;
    std::size_t tile_mask_ = 0;
    std::vector<Tile*> started_; // that may issue, oldest first

    Cycle now_ = 0;
    // The span that is cut: what is left of it from `column_` on.
    int left_ = 0, column_ = 0;
    int cut_ = 0;           // its place
    std::uint64_t low_ = 1; // bit of the segment's first pixel
    DrawnRow drawn_;
    int spans_left_ = 0;
    bool features_full_ = false, no_room_ = false, width_limited_ = false;
    // The open packet, see PackingUnit.
    int tasks_ = 0;
    Cycle next_slot_ = 0;
    bool ends_tile_ = false;
    bool idle_pending_ = false; // cycles without a packet, which count once another one comes
};

inline __attribute__((always_inline)) void DrawnBank::pop(int number) {
    Place& place = places_[number];
    Waiting& segment = *place.head;
    Waiting* const next = segment.next;
    segment.next = free_;
    free_ = &segment;
    --size_;
    place.head = next;
    if (next == nullptr) {
        place.end = &place.head;
        occupied_ ^= std::uint64_t{1} << number;
    }
}

// The open packet, which has `tasks` tasks.
inline __attribute__((always_inline)) void DrawnBank::send(int tasks) {
    const Cycle slot = next_slot_++;
    packing_.stats_.packets++;
    packing_.stats_.tasks += tasks;
    packing_.passed_.pass_packet(now_, slot);
    if (ends_tile_) {
        ends_tile_ = false;
        packing_.tell_end(slot, true);
    } else {
        slice_.pass_packet(slot);
    }
}

} // namespace degs
