// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "modules/degs/scheduler/domain_lanes.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"
#include "modules/degs/scheduler/open_packet.hpp"

namespace degs {

/// The cycles of an Issue Bank with its Packing Unit where tasks are drawn (TileDrawing), for every
/// design whose packets need only be counted: in one loop over little data, because these cycles
/// are half of a run. Segments carry masks, packets are not made, and what follows from totals is
/// counted at the end. Every decision and date is that of IssueBank and PackingUnit, which do the
/// same in strict mode, with limited ports, and where tasks are recorded.
class DrawnBank {
public:
    /// What an Issue Bank has, for its DrawnBank.
    struct Parts {
        const sc_core::sc_object& bank;
        const IssueBank::Config& config;
        const RenderJob& job;
        PackingUnit& packing;
        DatedFifo<Termination>& terminations;
        std::vector<BankStream>& streams;
        const Segmenter& segmenter;
        FeatureBuffer& features;
        TileEnd& tiles;
        Process& self;
        IssueBank::Stats& stats;
        int contexts, tiles_in_flight, spans_per_cycle;
        Slot width_cause;
        IssueTrace* trace; ///< may be null
    };

    /// True if packets need only be counted, and if the domains of all tiles in flight take little
    /// room.
    static bool can_run(const Parts& parts);

    /// Before the simulation starts; all parts must exist until the bank has finished.
    explicit DrawnBank(const Parts& parts);
    DrawnBank(const DrawnBank&) = delete; // entries point at each other
    DrawnBank& operator=(const DrawnBank&) = delete;
    /// Runs the bank until the job is over.
    void run();

private:
    /// What the loop over cycles chooses a domain by.
    enum class Choice {
        InTurn, ///< few domains of a tile, round robin
        Keyed,  ///< keys, in the oldest tile of a stream that has a domain to issue from
        Oldest  ///< keys, in all tiles at once: each stream has one that may issue
    };
    /// Where spans come from. The loop over cycles asks for nothing else.
    enum class Intake {
        Single, ///< DrawnSpans of the only tile stream
        Drawn,  ///< DrawnSpans, one per stream
        Rings   ///< rings of the crossbar
    };
    template <Intake intake, Choice choice>
    void run_cycles();
    template <Intake intake>
    void run_cycles();
    static Choice choice_of(const Parts& parts);

    static constexpr std::uint32_t kAllPixels = ~0U;
    static constexpr std::uint64_t kNothing = ~std::uint64_t{0}; // no domain is ready

    struct Waiting {
        std::uint32_t mask, inside, ended; // see DrawnTasks
        std::uint32_t key;                 // see next_key_
        Waiting* next;
        std::uint16_t feature;
    };
    /// A conflict domain of a tile in flight.
    struct alignas(32) Domain {
        Waiting* head = nullptr;
        Waiting** end = nullptr; // where the next one is linked
        std::uint32_t live = 0, ended = 0;
        std::uint32_t length = 0; // segments; for DomainScan::Deepest alone
    };
    /// The bank's part of a tile in flight.
    struct Tile {
        Tile(DomainLanes&& own, Domain* first) : lanes(std::move(own)), domains(first) {}
        DomainLanes lanes;
        int first_lane = 0; // of all_lanes_; for Choice::Oldest alone
        Domain* domains;
        bool started = false;     // may issue
        std::size_t waiting = 0;  // segments
        std::uint32_t cursor = 0; // behind the domain that issued last
        TileNumber number = kNoTile;
        std::int16_t context = 0;
    };
    /// A tile stream: its tile that enters, the only one that may issue, if there is no more than
    /// one, and what a cycle finds ready.
    struct Stream {
        Tile* entering = nullptr;
        Tile* only = nullptr;
        Tile* tile = nullptr;
        std::uint64_t rank = kNothing; // see find()
    };

    // Intake.
    template <Intake intake, Choice choice>
    inline void accept();
    template <Intake intake>
    inline bool open_span();
    static inline Cycle next_span_from(const BankStream& stream);
    template <Intake intake>
    inline bool take_from(BankStream& stream);
    template <Intake intake>
    inline DrawnSpans& spans_of(const BankStream::Input& input) const;
    template <Intake intake>
    inline BankStream::Input* earliest_input(BankStream& stream);
    inline bool admits(const BankStream& stream, TileNumber number, std::uint32_t splat);
    template <class Row>
    inline void start(const BankStream& stream, int row, const Row& drawn);
    [[gnu::noinline]] void take_end(BankStream& stream, TileNumber number);
    template <Choice choice>
    inline bool cut_segment();
    inline std::uint32_t cut_mask() const;
    inline bool can_cut() const;
    [[gnu::noinline]] void enter_tile(BankStream& stream, TileNumber number);
    [[gnu::noinline]] void renumber();
    [[gnu::noinline]] void end_pixels();
    void end_pixels(const Termination& message);
    [[gnu::noinline]] void see_contexts();
    void end_pixels(Domain& domain, std::uint32_t mask) const;
    void list_started();
    // An item that is there needs no proof.
    bool arrived(FifoBase& fifo) const {
        return fifo.empty() ? now_ >= fifo.quiet_until() && self_.arrived(fifo)
                            : fifo.head_date() <= now_;
    }
    static bool takes(const BankStream& stream, const BankStream::Input& input) {
        return input.turn == stream.entering && stream.enterable;
    }
    std::size_t end_of_intake(const BankStream& stream) const {
        return single_stream_ ? stream.oldest + tiles_in_flight_ : stream.startable;
    }

    // Issue.
    template <Intake intake, Choice choice>
    inline int issue();
    template <Choice choice>
    inline int issue_in_order();
    template <Choice choice>
    inline int issue_from_all();
    inline int issue_oldest();
    template <Choice choice>
    inline std::uint64_t find(const Tile& tile, Cycle slot) const;
    template <Choice choice>
    inline bool find_ready(std::size_t number, Cycle slot);
    template <Choice choice>
    inline std::size_t first_ready(Cycle slot);
    template <Choice choice>
    inline std::size_t least_ready(Cycle slot);
    template <Choice choice>
    inline bool issue_one(Tile& tile, int number, Cycle slot);
    [[gnu::noinline]] std::uint32_t tasks_of(const Waiting& segment, std::uint32_t live);
    void drop(const Waiting& segment, std::uint32_t tasks);
    template <bool ends>
    class Sink;
    [[gnu::noinline]] Cycle pack_ends(const Tile& tile, int number, std::uint32_t tasks,
                                      std::uint32_t ended);
    inline void send();
    [[gnu::noinline]] void send_part(Slot cause);
    [[gnu::noinline]] void end_drawn(const Tile& tile, int number, std::uint32_t tasks, Cycle date);
    void end_tile(const Tile& tile);
    template <Choice choice>
    inline void pop(Tile& tile, int number);
    [[gnu::noinline]] void finish_tiles();
    void finish_tiles(BankStream& stream);
    void finish();

    std::uint32_t after(int number) const { return number + 1 < domain_count_ ? number + 1 : 0; }

    // Dates.
    bool over() const { return tile_end_.over() && closing_ == 0; }
    bool owes_contexts(const BankStream& stream) const {
        return stream.startable < stream.oldest + contexts_;
    }
    Slot idle_cause() const;
    Cycle next_ready() const;
    bool watch_inputs();
    [[gnu::noinline]] Cycle next_date();

    Tile& tile_at(const BankStream& stream, std::size_t turn) {
        return tiles_[stream.index * (tile_mask_ + 1) + (turn & tile_mask_)];
    }

    const sc_core::sc_object& bank_;
    const IssueBank::Config& config_;
    const RenderJob& job_;
    PackingUnit& packing_;
    ArraySlice& slice_;
    std::vector<BankStream>& streams_;
    DrawnSpans* spans_; // of the only stream; null if there are several, or rings
    DatedFifo<Termination>& terminations_;
    const Segmenter& segmenter_;
    FeatureBuffer& features_;
    TileEnd& tile_end_;
    Process& self_;
    IssueBank::Stats& stats_;
    bool single_stream_;
    int domain_count_; // of a tile
    int segment_length_, segments_per_cycle_, spans_per_cycle_, issue_width_;
    Cycle reuse_;
    int contexts_, tiles_in_flight_;
    DomainScan scan_;
    Choice choice_;
    bool by_task_, sees_pixels_; // see TerminationGrain
    bool fills_;                 // filling a Feature Buffer entry takes time
    Slot width_cause_;           // what limits the issue width

    std::vector<Waiting> pool_;
    Waiting* free_ = nullptr;
    std::size_t size_ = 0;     // segments that wait
    std::size_t issuable_ = 0; // of these, in tiles that may issue
    // The smallest key of the ready domains is the one to issue. It is the number of the domain,
    // below the order of arrival unless domains go round robin.
    std::uint32_t next_key_ = 0, key_step_ = 0;
    std::vector<Domain> domains_; // tile by tile
    std::vector<Tile> tiles_;     // stream by stream, by their turn modulo a power of two
    std::size_t tile_mask_ = 0;
    // For Choice::Oldest alone: the lanes of all tiles, and the tile of each.
    DomainLanes all_lanes_{0};
    std::vector<Tile*> lane_tiles_;
    std::vector<Tile*> started_; // that may issue: stream by stream, oldest first
    std::vector<Stream> own_;    // by stream
    std::size_t issued_stream_ = 0;

    Cycle now_ = 0;
    // The span that is cut: what is left of it from `column_` on.
    int left_ = 0, column_ = 0;
    Tile* cut_tile_ = nullptr;
    int cut_ = 0;           // domain of the span's next segment
    std::uint64_t low_ = 1; // bit of the segment's first pixel
    const RowMask *row_inside_ = nullptr, *row_ended_ = nullptr; // see DrawnRow
    DrawnRow taken_;                                             // a copy, unless its ring keeps it
    BankStream* next_stream_;                                    // whose span is taken next
    Cycle spans_from_ = 0; // for Intake::Drawn: no stream has a span before, if no tile changes
    bool features_full_ = false, no_room_ = false, width_limited_ = false;
    OpenPacket packet_;
    bool ends_tile_ = false;     // it carries the end of a tile
    bool idle_pending_ = false;  // slots without a packet, which count once another one comes
    std::size_t closing_ = 0;    // tiles of which nothing more will be taken
    bool contexts_owed_ = false; // a stream has fewer contexts than it may have
    Cycle contexts_from_ = 0;    // none of them comes before
    // Tasks taken in, and of the segments dropped.
    std::uint64_t segments_in_ = 0, inside_ = 0, useful_ = 0;
    IssueTrace* trace_;
    std::vector<FifoBase*> watched_; // inputs that can end the bank's sleep
};

template <DrawnBank::Choice choice>
inline __attribute__((always_inline)) void DrawnBank::pop(Tile& tile, int number) {
    Domain& domain = tile.domains[number];
    Waiting& segment = *domain.head;
    Waiting* const next = segment.next;
    segment.next = free_;
    free_ = &segment;
    --size_;
    --issuable_;
    --tile.waiting;
    domain.head = next;
    // There is no branch, because both outcomes are equally likely.
    const bool last = next == nullptr;
    const Waiting& head = last ? segment : *next;
    domain.end = last ? &domain.head : domain.end;
    if (choice == Choice::InTurn) {
        tile.lanes.set_waiting(number, !last);
        return;
    }
    tile.lanes.set_key(number, last ? DomainLanes::kTop : head.key);
    if (choice == Choice::Keyed && scan_ == DomainScan::Deepest) {
        tile.lanes.set_length(number, --domain.length);
    }
}

inline __attribute__((always_inline)) void DrawnBank::send() {
    const int tasks = packet_.tasks();
    const bool ends = ends_tile_;
    ends_tile_ = false;
    packing_.pass_packet(now_, packet_.sent(now_), tasks, ends);
}

} // namespace degs
