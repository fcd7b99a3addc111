// SPDX-License-Identifier: Apache-2.0
// The cycle of a bank, its intake, and what ends pixels; issue_bank_issue.cpp has the rest.
#include "modules/degs/scheduler/issue_bank.hpp"

#include "modules/degs/scheduler/drawn_bank.hpp"
#include "tlm/has_process.hpp"

#include <algorithm>

namespace degs {
namespace {

// The queue holds more when they come.
constexpr int kFirstTiles = 2;

// Every cut writes a segment, and every issue reads one.
IssueBank::Config within_ports(IssueBank::Config config) {
    config.segments_per_cycle = config.segment_ports.of(config.segments_per_cycle);
    config.issue_width = config.segment_ports.of(config.issue_width);
    return config;
}

} // namespace

IssueBank::IssueBank(const sc_core::sc_module_name& name, const Config& config,
                     const Timebase& time, const RenderJob& job, PackingUnit& packing, int index,
                     std::size_t inputs, int contexts)
    : sc_core::sc_module(name), in("in", inputs * config.streams), terminated("terminated"),
      context_free("context_free", config.streams), config_(within_ports(config)), job_(job),
      index_(index), packing_(packing), contexts_(contexts),
      tiles_in_flight_(config.tiles_of(contexts)),
      by_task_(config.termination == TerminationGrain::Task),
      sees_pixels_(config.termination != TerminationGrain::Segment),
      fills_(config.fill.cycles != 0), streams_(config.streams), stream_count_(streams_.size()),
      spans_per_cycle_(config.spans_per_cycle == 0 ? config_.segments_per_cycle
                                                   : config.spans_per_cycle),
      self_(time), segmenter_(job.tile_size, config.segment_length, index, config.banks),
      queue_(config.queue_depth, kFirstTiles,
             Segmenter::domains_per_tile(job.tile_size, config.segment_length, config.banks),
             config.scan, config.streams),
      pipeline_(config.select_cycles, config_.issue_width),
      features_(config.feature_entries, config.open_splats, config.streams, config.fill),
      next_stream_(&streams_.front()), issued_stream_(&streams_.front()),
      tiles_(job, config.granted ? config.streams : 0),
      width_cause_(config_.issue_width < config.issue_width ? Slot::Ports : Slot::Starved) {
    for (BankStream& stream : streams_) {
        stream.index = &stream - streams_.data();
        stream.next = &streams_[(stream.index + 1) % streams_.size()];
        stream.inputs.resize(inputs);
        stream.startable = contexts;
    }
    DEGS_HAS_PROCESS(IssueBank);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

IssueBank::~IssueBank() = default;

void IssueBank::end_of_elaboration() {
    std::size_t port = 0;
    for (BankStream& stream : streams_) {
        for (BankStream::Input& input : stream.inputs) {
            input.ring = &in[port++].ring();
            input.ring->connect_reader(self_);
        }
        stream.contexts_freed = &context_free[stream.index].ring();
        stream.contexts_freed->connect_reader(self_);
    }
    terminations_ = &terminated.ring();
    terminations_->connect_reader(self_);
    packing_.out->connect_writer(self_);
    watched_.reserve(in.size() + streams_.size() + 1);
}

void IssueBank::start_of_simulation() {
    if (log_ != nullptr) {
        start_log();
    }
    const DrawnBank::Parts parts{
        *this,        config_, job_,  packing_, *terminations_, streams_,         segmenter_,
        features_,    tiles_,  self_, stats_,   contexts_,      tiles_in_flight_, spans_per_cycle_,
        width_cause_, trace_};
    if (!DrawnBank::can_run(parts)) {
        return;
    }
    if (spans_ != nullptr) {
        const auto& drawn_spans = spans_->hand_over(self_);
        for (std::size_t stream = 0; stream < drawn_spans.size(); ++stream) {
            streams_[stream].inputs.front().spans = drawn_spans[stream].get();
        }
    }
    drawn_bank_ = std::make_unique<DrawnBank>(parts);
}

void IssueBank::run() {
    if (drawn_bank_ != nullptr) {
        drawn_bank_->run();
    } else if (stream_count_ == 1 && streams_.front().inputs.size() == 1) {
        run_cycles<true>();
    } else {
        run_cycles<false>();
    }
}

template <bool single>
void IssueBank::run_cycles() {
    for (bool over = this->over(); !over;) {
        const Cycle now = self_.local();
        see_terminations();
        see_contexts();
        accept<single>(now);
        bool worked = issue(now);
        finish_tiles();
        if (pipeline_.exists()) {
            choose(now);
            worked = worked || !pipeline_.empty();
        }
        over = this->over();
        if (packing_.due(now)) {
            packing_.send_due(self_, idle_cause());
        }
        Cycle next = now + 1;
        if (over) {
            const Cycle open = packing_.open_until();
            next = open == kNever ? next : std::max(open, next);
        } else if (!worked && !can_cut()) {
            next = next_date(now);
        } // else work is left, whatever arrives; proof is asked for where it matters
        if (packing_.leaves_slots(next)) {
            packing_.close_cycles(self_, next, idle_cause());
        }
        self_.advance_to(next);
    }
    packing_.send_due(self_, Slot::Starved);
    packing_.close_cycles(self_, self_.local() + 1, Slot::Starved);
    if (config_.granted) {
        packing_.end_tile(self_, kNoTile, 0);
    }
    self_.finish();
}

// Drawn tasks report the ends of their pixels when they are issued, so a report that the ring does
// not hold yet is due later than now.
inline void IssueBank::see_terminations() {
    if (packing_.draws()) {
        while (!terminations_->empty() && terminations_->head_date() <= self_.local()) {
            end_pixels(terminations_->take(self_));
        }
        return;
    }
    while (self_.arrived(*terminations_)) {
        end_pixels(terminations_->take(self_));
    }
}

// A context comes back only after this bank, too, has ended the tile that holds it.
void IssueBank::see_contexts() {
    if (!contexts_owed_) {
        return;
    }
    contexts_owed_ = false;
    bool gained = false;
    for (BankStream& stream : streams_) {
        while (stream.startable < stream.oldest + contexts_ &&
               self_.arrived(*stream.contexts_freed)) {
            stream.contexts_freed->drop(self_);
            ++stream.startable;
            gained = true;
        }
        contexts_owed_ = contexts_owed_ || stream.startable < stream.oldest + contexts_;
    }
    if (gained) {
        list_started();
    }
}

// Called when a tile has begun, got a context, or ended.
void IssueBank::list_started() {
    started_.clear();
    for (BankStream& stream : streams_) {
        stream.first_started = started_.size();
        for (std::size_t turn = stream.oldest; turn < stream.first_unstarted(); ++turn) {
            started_.push_back(&tile_at(stream, turn));
        }
        stream.end_started = started_.size();
        stream.enterable = stream.entering < end_of_intake(stream);
    }
}

void IssueBank::end_pixels(const Termination& message) {
    const BankStream& stream = streams_[(message.context - config_.first_context) / contexts_];
    const std::size_t turn =
        stream.turn_of((message.context - config_.first_context) % contexts_, contexts_);
    if (turn >= stream.first_unstarted() || tile_at(stream, turn).number() != message.tile) {
        return; // the tile is over for this bank
    }
    SegmentQueue::Tile& tile = tile_at(stream, turn);
    const int domain = segmenter_.domain_of(message.row, message.column);
    if (end_pixels(tile, domain, message.mask) == kAllPixels) {
        while (tile.has_waiting(domain)) {
            const Segment& segment = tile.front(domain);
            features_.release(segment.feature, self_.local());
            stats_.drop(segment.run.task.mask);
            queue_.pop(tile, domain);
        }
        if (pipeline_.exists()) {
            queue_.let_go(tile, domain);
            pipeline_.remove({stream.index, turn, domain});
        }
    }
}

// All pixels of the domain that have ended. The bank looks at single pixels or at whole segments.
std::uint32_t IssueBank::end_pixels(SegmentQueue::Tile& tile, int domain,
                                    std::uint32_t mask) const {
    const std::uint32_t ended = tile.end_pixels(domain, mask);
    const bool all = ended == kAllPixels;
    tile.set_live(domain, sees_pixels_ || all ? ~ended : kAllPixels);
    return ended;
}

// Called when the first item of a tile is taken. Pixels outside of the image count as ended.
void IssueBank::enter_tile(BankStream& stream, TileNumber number) {
    queue_.hold(stream.oldest, stream.entering, stream.index);
    const PixelRange drawn = job_.tiles[number].drawn_columns();
    SegmentQueue::Tile& tile = tile_at(stream, stream.entering);
    const int first_context = config_.first_context + static_cast<int>(stream.index) * contexts_;
    tile.name(number, context_in_turn(stream.entering, contexts_, first_context));
    int domain = 0;
    for (const Segmenter::Domain& place : segmenter_.domains()) {
        end_pixels(tile, domain++,
                   ~bits_of(drawn.relative_to(place.column), config_.segment_length));
    }
    stream.entered = true;
    list_started();
    log_tile(tile_event_, number, {tile.context(), drawn.first, drawn.last});
}

template <bool single>
inline __attribute__((always_inline)) void IssueBank::accept(Cycle now) {
    spans_left_ = spans_per_cycle_;
    features_full_ = false;
    for (int budget = config_.segments_per_cycle; budget > 0; --budget) {
        if (!segmenter_.cutting() && !open_span<single>(now)) {
            break;
        }
        if (!cut_segment()) {
            break;
        }
    }
}

// Takes the earliest item that has arrived, ties by input, if it may be taken. Inlined in the hot
// loop.
template <bool single>
inline __attribute__((always_inline)) IssueBank::Taken IssueBank::take_from(BankStream& stream,
                                                                            Cycle now) {
    BankStream::Input* const source = earliest_input<single>(stream);
    if (source == nullptr) {
        return Taken::Nothing;
    }
    const SpanItem& item = source->ring->front();
    const bool span = item.span.has_value();
    if (span && !features_.admit(item.tile, item.span->splat, now, stream.index)) {
        features_full_ = true;
        return Taken::Nothing;
    }
    if (span && fills_ && !features_.filled_by(packing_.next_execution(now))) {
        return Taken::Nothing;
    }
    const TileNumber number = item.tile;
    if (!stream.entered && number != kNoTile) {
        enter_tile(stream, number);
    }
    if (span) {
        cut_tile_ = &tile_at(stream, stream.entering);
        segmenter_.start(item, cut_tile_->context());
        stats_.spans++;
        stats_.tasks_in += item.span->length;
    }
    source->ring->drop(self_);
    if (!span) {
        ++source->turn;
        take_end(stream, number, now);
    }
    return span ? Taken::Span : Taken::End;
}

// Takes a span of the next stream that has one, in turn; a span cut halfway is finished first.
template <bool single>
inline __attribute__((always_inline)) bool IssueBank::open_span(Cycle now) {
    if (spans_left_ == 0) {
        return false;
    }
    if constexpr (single) {
        Taken taken;
        do {
            taken = take_from<true>(*next_stream_, now);
        } while (taken == Taken::End);
        spans_left_ -= taken == Taken::Span ? 1 : 0;
        return taken == Taken::Span;
    }
    BankStream* const first = next_stream_;
    do {
        BankStream& stream = *next_stream_;
        next_stream_ = stream.next;
        Taken taken;
        do { // ends of tiles on the way cost nothing
            taken = take_from<false>(stream, now);
        } while (taken == Taken::End);
        if (taken == Taken::Span) {
            --spans_left_;
            return true;
        }
    } while (next_stream_ != first);
    return false;
}

template <bool single>
inline __attribute__((always_inline)) BankStream::Input*
IssueBank::earliest_input(BankStream& stream) {
    if constexpr (single) {
        BankStream::Input& only = stream.inputs.front();
        return takes(stream, only) && self_.arrived(*only.ring) ? &only : nullptr;
    }
    BankStream::Input* source = nullptr;
    for (BankStream::Input& input : stream.inputs) {
        if (takes(stream, input) && self_.arrived(*input.ring) &&
            (source == nullptr || input.ring->head_date() < source->ring->head_date())) {
            source = &input;
        }
    }
    return source;
}

// kNoTile: that of the stream.
void IssueBank::take_end(BankStream& stream, TileNumber number, Cycle now) {
    if (++stream.ends_seen != stream.inputs.size()) {
        return;
    }
    if (number == kNoTile) {
        tiles_.count(number);
    } else {
        features_.close(now, stream.index);
        stream.ends_seen = 0;
        ++stream.entering;
        ++closing_;
        stream.enterable = stream.entering < end_of_intake(stream);
        stream.entered = false;
    }
}

bool IssueBank::can_cut() const {
    return segmenter_.cutting() &&
           (!queue_.full() ||
            (segmenter_.mask() & cut_tile_->live(segmenter_.domain())) == 0); // it is dropped
}

// False if the queue has no room; the segment is then cut later.
bool IssueBank::cut_segment() {
    SegmentQueue::Tile& tile = *cut_tile_;
    const int domain = segmenter_.domain();
    const std::uint32_t mask = segmenter_.mask();
    if ((mask & tile.live(domain)) == 0) {
        stats_.drop(mask);
    } else {
        if (queue_.full()) {
            return false;
        }
        Segment& segment = queue_.push(tile, domain, sequence_++);
        segment.feature = features_.current();
        features_.hold(segment.feature);
        segmenter_.fill(segment.run, mask);
        if (packing_.draws()) {
            segmenter_.fill(segment.run.drawn);
        } else {
            segmenter_.fill(segment.run.task);
        }
        if (queue_.size() > stats_.queue_high_water) {
            stats_.queue_high_water = queue_.size();
        }
    }
    segmenter_.next();
    return true;
}

} // namespace degs
