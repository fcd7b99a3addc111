// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/degs/scheduler/cooling_places.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"
#include "modules/degs/scheduler/open_packet.hpp"

namespace degs {

/// The cycles of an Issue Bank with its Packing Unit where tasks are drawn (TileDrawing) and
/// nothing limits them but the queue, the scoreboard and the Packing Buffer: in one loop over
/// little data, because these cycles are half of a run. Segments carry masks, and packets are
/// counted, not made. Every decision and date is that of IssueBank and PackingUnit, which do the
/// same for all other designs and in strict mode.
class DrawnBank {
public:
    /// What an Issue Bank has, for its DrawnBank.
    struct Parts {
        const sc_core::sc_object& bank;
        const IssueBank::Config& config;
        const RenderJob& job;
        PackingUnit& packing;
        DatedFifo<Termination>& terminations;
        BankStream& stream; ///< the first one
        const Segmenter& segmenter;
        FeatureBuffer& features;
        TileEnd& tiles;
        Process& self;
        IssueBank::Stats& stats;
        int contexts, tiles_in_flight, spans_per_cycle;
        Slot width_cause;
    };

    /// True if the bank has one tile stream from one Span Unit, goes round robin, compacts, and has
    /// no limited ports and no filling of Feature Buffer entries, if the domains of all tiles in
    /// flight fit in a word, and if nobody records its tasks. The unit must hand its rows over,
    /// too; see DrawnSpans.
    static bool can_run(const Parts& parts);

    /// Before the simulation starts; `spans` and all parts must exist until the bank has finished.
    DrawnBank(const Parts& parts, DrawnSpans& spans);
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
        std::uint64_t later = 0;  // places behind the one that issued last
        int first = 0;            // place
        TileNumber number = kNoTile;
        std::int16_t context = 0;
    };

    // Intake.
    inline void accept();
    inline bool open_span();
    void take_end(TileNumber number);
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
    template <bool ends>
    class Sink;
    [[gnu::noinline]] Cycle pack_ends(int number, std::uint32_t tasks, std::uint32_t ended);
    inline void send();
    [[gnu::noinline]] void send_part(Slot cause);
    [[gnu::noinline]] void end_drawn(int number, std::uint32_t tasks, Cycle date);
    void end_tile(const Tile& tile);
    inline void pop(int number);
    [[gnu::noinline]] void finish_tiles();

    // Dates.
    bool over() const { return tile_end_.over() && closing_ == 0; }
    bool enterable() const { return stream_.entering < stream_.oldest + tiles_in_flight_; }
    bool owed_contexts() const { return stream_.startable < stream_.oldest + contexts_; }
    Slot idle_cause() const;
    std::uint64_t issuable() const { return occupied_ & startable_; }
    [[gnu::noinline]] Cycle next_date();

    Tile& tile_at(std::size_t turn) { return tiles_[turn & tile_mask_]; }
    Tile& tile_of(int place) { return tiles_[place / domains_]; }

    const sc_core::sc_object& bank_;
    const IssueBank::Config& config_;
    const RenderJob& job_;
    PackingUnit& packing_;
    ArraySlice& slice_;
    BankStream& stream_;
    BankStream::Input& input_;
    DrawnSpans& spans_;
    DatedFifo<Termination>& terminations_;
    const Segmenter& segmenter_;
    FeatureBuffer& features_;
    TileEnd& tile_end_;
    Process& self_;
    IssueBank::Stats& stats_;
    int domains_, segment_length_, segments_per_cycle_, spans_per_cycle_, issue_width_;
    Cycle reuse_;
    int contexts_, tiles_in_flight_;
    bool by_task_, sees_pixels_; // see TerminationGrain
    Slot width_cause_;           // what limits the issue width

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
    int cut_ = 0;           // place of the span's next segment
    std::uint64_t low_ = 1; // bit of the segment's first pixel
    DrawnRow drawn_;
    int spans_left_ = 0;
    bool features_full_ = false, no_room_ = false, width_limited_ = false;
    OpenPacket packet_;
    bool ends_tile_ = false;     // it carries the end of a tile
    bool idle_pending_ = false;  // slots without a packet, which count once another one comes
    std::size_t closing_ = 0;    // tiles of which nothing more will be taken
    bool contexts_owed_ = false; // the stream has fewer contexts than it may have
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

inline __attribute__((always_inline)) void DrawnBank::send() {
    const int tasks = packet_.tasks();
    const bool ends = ends_tile_;
    ends_tile_ = false;
    packing_.pass_packet(now_, packet_.sent(), tasks, ends);
}

} // namespace degs
