// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "modules/degs/scheduler/domain_lanes.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"
#include "modules/degs/scheduler/open_packet.hpp"
#include "modules/degs/scheduler/pick_pipeline.hpp"

namespace degs {

/// The cycles of an Issue Bank with its Packing Unit, in one loop over little data, because they
/// are half of a run. A waiting segment is a mask and a few words; where packets need only be
/// counted (PackingUnit::counts()), none is made, and what follows from totals is counted by
/// count_totals().
///
/// In cycle t the bank takes terminations and freed contexts dated <= t, accepts segments, issues
/// segments, and ends tiles; a bank with select_cycles then chooses the segments of a later cycle.
class BankCycles {
public:
    /// The parts of an Issue Bank that its cycles work on.
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
        BankLog* log;      ///< may be null
    };

    /// Before the simulation starts; all parts must exist until the bank has finished.
    explicit BankCycles(const Parts& parts);
    BankCycles(const BankCycles&) = delete; // entries point at each other
    BankCycles& operator=(const BankCycles&) = delete;
    /// Runs the bank until the job is over.
    void run();
    /// Counts what follows from totals up to now. Segments that wait count as issued.
    void count_totals();

private:
    /// By what the loop over cycles chooses the domain that issues next.
    enum class Choice {
        InTurn, ///< few domains of a tile, round robin
        Keyed,  ///< keys, in the oldest tile of a stream that has a domain to issue from
        Oldest  ///< keys, in all tiles at once: each stream has one that may issue
    };
    /// Where spans come from. The loop over cycles is compiled for each, so that it need not ask.
    enum class Intake {
        Single,   ///< SpanReplay of the only tile stream
        Replayed, ///< SpanReplay, one per stream
        Rings     ///< rings of the crossbar
    };
    /// How much the loop over cycles has to ask about.
    enum class Kind {
        Plain,  ///< nothing more: packets are counted, and segments go in the cycle of the choice
        General ///< whether the Packing Unit looks at tasks, and whether the bank chooses ahead
    };
    template <Kind kind>
    void run_from();
    template <Kind kind, Intake intake>
    void run_by();
    template <Kind kind, Intake intake, Choice choice>
    void run_cycles();
    static Choice choice_of(const Parts& parts);

    static constexpr std::uint32_t kAllPixels = ~0U;
    static constexpr std::uint64_t kNothing = ~std::uint64_t{0}; // no domain is ready

    struct Waiting {
        std::uint32_t mask, inside, ended; // see TaskOutcome
        std::uint32_t key;                 // see next_key_
        Waiting* next;
        std::uint16_t feature;
    };
    /// What the Packing Unit also needs of a waiting segment, if it looks at tasks.
    struct Values {
        std::uint32_t splat = 0, useful = 0;
        double g0 = 0, d0 = 0;
        std::int16_t offset = 0;
    };
    /// A conflict domain of a tile in flight.
    struct alignas(32) Domain {
        Waiting* head = nullptr;
        Waiting** end = nullptr; // where the next one is linked
        std::uint32_t live = 0, ended = 0;
        std::uint32_t length : 31; // segments; for DomainScan::Deepest alone
        std::uint32_t held : 1;    // chosen, and not packed yet; with select_cycles alone
        Domain() : length(0), held(0) {}
    };
    /// The bank's part of a tile in flight.
    struct Tile {
        explicit Tile(int count) : own(count), domains(own.data()) {}
        std::vector<Domain> own; // entries point at them
        Domain* domains;         // these, at hand in the hot loop
        DomainLanes lanes{0};
        int first_lane = 0;       // of all_lanes_; for Choice::Oldest alone
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
    template <Kind kind, Intake intake, Choice choice>
    inline void accept();
    template <Kind kind, Intake intake>
    inline bool open_span();
    static inline Cycle next_span_from(const BankStream& stream);
    template <Kind kind, Intake intake>
    inline bool take_from(BankStream& stream);
    template <Intake intake>
    inline SpanReplay& spans_of(const BankStream::Input& input) const;
    template <Intake intake>
    inline BankStream::Input* earliest_input(BankStream& stream);
    inline bool admits(const BankStream& stream, TileNumber number, std::uint32_t splat);
    inline void start(const BankStream& stream, int row, int x0, int length);
    template <class Row>
    inline void start_replay(const Row& row);
    [[gnu::noinline]] void take_end(BankStream& stream, TileNumber number);
    template <Kind kind, Choice choice>
    inline bool cut_segment();
    template <Kind kind, Choice choice>
    inline void list_segment(Waiting& segment, Domain& domain);
    void keep_values(const Waiting& segment);
    inline std::uint32_t cut_mask() const;
    inline bool can_cut() const;
    [[gnu::noinline]] void enter_tile(BankStream& stream, TileNumber number);
    void make_tile(std::unique_ptr<Tile>& place);
    [[gnu::noinline]] void renumber();
    [[gnu::noinline]] void end_pixels();
    void end_pixels(const Termination& message);
    [[gnu::noinline]] void see_contexts();
    void end_pixels(Domain& domain, std::uint32_t mask) const;
    // True if terminations may be taken now. Replayed tasks report the ends of their pixels when
    // they are issued, so a report that the ring does not hold yet is due later than now.
    template <Kind kind>
    bool has_terminations() const {
        return kind == Kind::Plain || slice_ != nullptr
                   ? !terminations_.empty() && terminations_.head_date() <= now_
                   : self_.arrived(terminations_);
    }
    void list_started();
    // True if an item may be read now. Only if there is none does the answer need a proof that none
    // will come for this date.
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
    template <Kind kind, Intake intake, Choice choice>
    inline int issue();
    template <Kind kind, Choice choice>
    inline int issue_in_order();
    template <Kind kind, Choice choice>
    inline int issue_from_all();
    template <Kind kind>
    inline int issue_oldest();
    template <Kind kind, Choice choice>
    [[gnu::noinline]] int issue_chosen();
    template <Choice choice>
    [[gnu::noinline]] void choose();
    template <Choice choice>
    inline std::uint64_t find(const Tile& tile, Cycle slot) const;
    template <Kind kind, Choice choice>
    inline int number_of(const Tile& tile, std::uint64_t rank) const;
    template <Choice choice>
    inline bool find_ready(std::size_t number, Cycle slot);
    template <Choice choice>
    inline std::size_t first_ready(Cycle slot);
    template <Choice choice>
    inline std::size_t least_ready(Cycle slot);
    template <Choice choice>
    inline std::size_t next_stream(Cycle slot, bool anew);
    template <Kind kind, Choice choice>
    inline bool issue_one(Tile& tile, int number, Cycle slot);
    TaskRun run_of(const Tile& tile, int number, const Waiting& segment) const;
    [[gnu::noinline]] std::uint32_t tasks_of(const Waiting& segment, std::uint32_t live);
    void drop(const Waiting& segment, std::uint32_t tasks);
    template <bool ends>
    class Sink;
    inline Cycle count_tasks(const Tile& tile, int number, std::uint32_t tasks, int count,
                             std::uint32_t ended);
    [[gnu::noinline]] Cycle pack_ends(const Tile& tile, int number, std::uint32_t tasks,
                                      std::uint32_t ended);
    [[gnu::noinline]] void end_replayed(const Tile& tile, int number, std::uint32_t tasks,
                                        Cycle date);
    template <Choice choice>
    inline void pop(Tile& tile, int number);
    [[gnu::noinline]] void finish_tiles();
    void finish_tiles(BankStream& stream);
    void finish();

    // True if a key contains the number of its domain: there are bits enough.
    bool keys_name_domains() const { return key_mask_ != 0 || domain_count_ == 1; }
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

    std::unique_ptr<Tile>& place_of(std::size_t stream, std::size_t turn) {
        return tiles_[stream * (tile_mask_ + 1) + (turn & tile_mask_)];
    }
    /// The tile of a turn that has been entered.
    Tile& tile_at(std::size_t stream, std::size_t turn) { return *place_of(stream, turn); }

    const sc_core::sc_object& bank_;
    const IssueBank::Config& config_;
    const RenderJob& job_;
    PackingUnit& packing_;
    ArraySlice* slice_; // nullptr: tasks are blended when they execute
    std::vector<BankStream>& streams_;
    SpanReplay* spans_; // of the only stream; null if there are several, or rings
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
    bool counts_;                // packets are only counted
    bool scoreboard_;            // else domains do not wait between updates
    Slot width_cause_;           // what limits the issue width

    std::vector<Waiting> pool_;
    std::vector<Values> values_; // of each of these, for Kind::General alone
    Waiting* free_ = nullptr;
    std::size_t size_ = 0;     // segments that wait
    std::size_t issuable_ = 0; // segments among them whose tiles may issue
    // The ready domain with the smallest key issues next. A key is the order of arrival and, in its
    // lowest bits if there is room for that, the number of the domain.
    std::uint32_t next_key_ = 0, key_step_ = 1;
    std::uint32_t key_mask_ = 0; // of the domain in a key; 0: keys are the order of arrival alone
    // Stream by stream, by their turn modulo a power of two; null before the first tile.
    std::vector<std::unique_ptr<Tile>> tiles_;
    std::size_t tile_mask_ = 0;
    // For Choice::Oldest alone: the lanes of all tiles, and the tile of each.
    DomainLanes all_lanes_{0};
    std::vector<Tile*> lane_tiles_;
    std::vector<Tile*> started_; // that may issue: stream by stream, oldest first
    std::vector<Stream> own_;    // by stream
    std::size_t issued_stream_ = 0;
    PickPipeline pipeline_;

    Cycle now_ = 0;
    // The span that is cut: what is left of it from `column_` on.
    int left_ = 0, column_ = 0;
    Tile* cut_tile_ = nullptr;
    int cut_ = 0;           // domain of the span's next segment
    std::uint64_t low_ = 1; // bit of the segment's first pixel
    const RowMask *row_inside_ = nullptr, *row_ended_ = nullptr; // see RowOutcome
    const RowMask* row_useful_ = nullptr;
    RowOutcome taken_;        // a copy, unless its ring keeps it
    RowSpan taken_span_;      // for Kind::General alone
    BankStream* next_stream_; // whose span is taken next
    Cycle spans_from_ = 0; // for Intake::Replayed: no stream has a span before, if no tile changes
    bool features_full_ = false, no_room_ = false, width_limited_ = false;
    OpenPacket& packet_;
    std::size_t closing_ = 0;    // tiles of which nothing more will be taken
    bool contexts_owed_ = false; // a stream has fewer contexts than it may have
    Cycle contexts_from_ = 0;    // none of them comes before
    // Tasks taken in, and of the segments dropped.
    std::uint64_t segments_in_ = 0, inside_ = 0, useful_ = 0;
    SlotAccount counted_; // by count_totals()
    IssueTrace* trace_;
    BankLog* log_;
    std::vector<FifoBase*> watched_; // inputs that can end the bank's sleep
};

template <BankCycles::Choice choice>
inline __attribute__((always_inline)) void BankCycles::pop(Tile& tile, int number) {
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

} // namespace degs
