// SPDX-License-Identifier: Apache-2.0
// An Issue Bank with its Packing Unit that is awake in every cycle and does what docs/issue-bank.md
// and docs/packing-unit.md say, in the plainest code: no dates to sleep until, no rings, no sets of
// ready domains. It shares nothing with the model but the form of its log. SRAM ports of packets
// are not modelled.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "tests/modules/degs/scheduler/naive_facts.hpp"
#include "tests/modules/degs/scheduler/naive_features.hpp"
#include "tests/modules/degs/scheduler/naive_packing.hpp"
#include "tests/tlm/event_reader.hpp"

namespace degs::test {

/// Runs on what came in according to a log, and says what it takes, issues and sends.
class NaiveBank {
public:
    NaiveBank(const NaiveFacts& facts, const std::vector<LoggedEvent>& events)
        : facts_(facts), streams_(facts.streams) {
        for (const LoggedEvent& event : events) {
            if (event.kind() == "tile") {
                columns_[event["tile"]] = {event["first_column"], event["last_column"]};
            } else if (event.has("waited")) { // it came in
                inputs_[event.kind()][event["port"]].push_back(
                    {event, Number(event.now) - event["waited"]});
            }
        }
        for (Stream& stream : streams_) {
            stream.startable = facts_.contexts;
            stream.turns.resize(facts_.inputs);
        }
    }
    /// Lines "span", "issue", "over" and "packet" in their order, each with its cycle.
    const std::vector<std::string>& run() {
        for (; !over(); ++now_) {
            cycle();
        }
        for (packing_.send_due(now_); packing_.open(); packing_.send_due(++now_)) {
        }
        if (facts_.granted != 0) {
            packing_.end_tile(kNobody, 0);
        }
        return lines_.lines();
    }

private:
    static constexpr Number kNobody = 0xFFFFFFFF; // in place of a tile: nothing follows
    static constexpr std::uint32_t kAll = ~0U;
    struct Message {
        LoggedEvent event;
        Number readable;
    };
    struct Domain {
        std::uint32_t ended = 0;
        Number ready = 0;
        bool chosen = false; // by a pipelined bank, and not packed yet
        std::deque<NaiveSegment> waiting;
    };
    struct Tile {
        Number number = -1, context = 0, cursor = 0, waiting = 0;
        std::vector<Domain> domains;
    };
    struct Stream {
        Number oldest = 0, startable = 0, entering = 0, ends = 0; // turns
        bool entered = false;
        std::vector<Number> turns;    // of each input: ends of tiles that it has delivered
        std::map<Number, Tile> tiles; // by turn
        NaiveFeatures::Open open;
        Number started() const { return std::min(startable, entering + (entered ? 1 : 0)); }
    };
    struct Pick {
        Stream* stream = nullptr;
        Tile* tile = nullptr;
        Number domain = -1;
    };

    bool over() {
        for (const auto& [port, messages] : inputs_["span"]) {
            if (!messages.empty()) {
                return false;
            }
        }
        return std::all_of(streams_.begin(), streams_.end(),
                           [](const Stream& stream) { return stream.oldest == stream.entering; });
    }
    Number index_of(const Stream& stream) const { return &stream - streams_.data(); }
    bool arrived(const char* kind, Number port) {
        return !inputs_[kind][port].empty() && inputs_[kind][port].front().readable <= now_;
    }
    LoggedEvent take(const char* kind, Number port) {
        LoggedEvent event = inputs_[kind][port].front().event;
        inputs_[kind][port].pop_front();
        return event;
    }
    void cycle() {
        packing_.begin_cycle(now_);
        while (arrived("terminated", 0)) {
            end_pixels(take("terminated", 0));
        }
        for (Stream& stream : streams_) {
            while (stream.startable < stream.oldest + facts_.contexts &&
                   arrived("context_free", index_of(stream))) {
                take("context_free", index_of(stream));
                ++stream.startable;
            }
        }
        take_in();
        const bool held = facts_.select_cycles == 0 ? issue(), false : !pack_chosen();
        for (Stream& stream : streams_) {
            end_tiles(stream);
        }
        packing_.send_due(now_);
        if (facts_.select_cycles != 0 && !held) {
            choose_group();
        }
    }

    std::uint32_t live(const Domain& domain) const { // a grain of 0: whole regions
        return facts_.termination != 0 || domain.ended == kAll ? ~domain.ended : kAll;
    }
    void end_pixels(const LoggedEvent& message) {
        for (Stream& stream : streams_) {
            for (Number turn = stream.oldest; turn < stream.started(); ++turn) {
                Tile& tile = stream.tiles[turn];
                if (tile.number != message["tile"]) {
                    continue;
                }
                Domain& domain = tile.domains[domain_of(message["row"], message["column"])];
                domain.ended |= static_cast<std::uint32_t>(message["mask"]);
                while (domain.ended == kAll && !domain.waiting.empty()) {
                    leave(tile, domain, now_);
                }
                if (domain.waiting.empty()) {
                    forget(domain);
                }
            }
        }
    }
    // The oldest segment of the domain goes; its splat is needed until `date`.
    void leave(Tile& tile, Domain& domain, Number date) {
        features_.release(domain.waiting.front().entry, date);
        domain.waiting.pop_front();
        --tile.waiting;
        --waiting_;
    }

    Number per_row() const {
        return (facts_.tile_size + facts_.segment_length - 1) / facts_.segment_length;
    }
    Number domain_of(Number row, Number column) const {
        return row / facts_.banks * per_row() + column / facts_.segment_length;
    }
    bool may_enter(const Stream& stream) const {
        return stream.entering <
               (streams_.size() == 1 ? stream.oldest + facts_.tiles_in_flight : stream.startable);
    }
    void take_in() {
        Number spans = facts_.spans_per_cycle;
        for (Number i = 0; i < facts_.segments_per_cycle; ++i) {
            if (left_ <= 0 && (spans-- == 0 || !take_span())) {
                return;
            }
            if (!cut()) {
                return;
            }
        }
    }
    bool take_span() { // from the streams in turn
        for (std::size_t i = 0; i < streams_.size(); ++i) {
            Stream& stream = streams_[next_stream_];
            next_stream_ = (next_stream_ + 1) % streams_.size();
            if (take_span(stream)) {
                return true;
            }
        }
        return false;
    }
    bool take_span(Stream& stream) { // the earliest one; ends of tiles on the way cost nothing
        for (;;) {
            Number source = -1;
            for (Number i = 0; i < Number(stream.turns.size()); ++i) {
                const Number port = index_of(stream) * facts_.inputs + i;
                if (may_enter(stream) && stream.turns[i] == stream.entering &&
                    arrived("span", port) &&
                    (source < 0 || inputs_["span"][port].front().readable <
                                       inputs_["span"][source].front().readable)) {
                    source = port;
                }
            }
            if (source < 0) {
                return false;
            }
            const LoggedEvent item = inputs_["span"][source].front().event;
            const bool end = item["end"] != 0;
            if (!end && (!features_.admit(stream.open, item["tile"], item["splat"], now_) ||
                         features_.filled() > packing_.next_slot())) {
                return false;
            }
            take("span", source);
            lines_.say(now_, "span",
                       {source, item["tile"], item["end"], item["splat"], item["row"]});
            if (!stream.entered && item["tile"] != kNobody) {
                enter(stream, item["tile"]);
            }
            if (!end) {
                span_ = item;
                cut_tile_ = &stream.tiles[stream.entering];
                column_ = item["x0"] / facts_.segment_length * facts_.segment_length;
                left_ = item["x0"] + item["length"] - column_;
                return true;
            }
            ++stream.turns[source % facts_.inputs];
            if (++stream.ends == facts_.inputs && item["tile"] != kNobody) {
                while (!stream.open.empty()) {
                    features_.close_oldest(stream.open, now_);
                }
                stream.ends = 0;
                stream.entered = false;
                ++stream.entering;
            }
        }
    }
    void enter(Stream& stream, Number number) {
        Tile& tile = stream.tiles[stream.entering];
        tile.number = number;
        tile.context = facts_.first_context + index_of(stream) * facts_.contexts +
                       stream.entering % facts_.contexts;
        for (Number row = facts_.bank; row < facts_.tile_size; row += facts_.banks) {
            for (Number s = 0; s < per_row(); ++s) {
                tile.domains.emplace_back();
                for (Number i = 0; i < 32; ++i) { // pixels outside of the image have ended
                    const Number column = s * facts_.segment_length + i;
                    const bool inside = i < facts_.segment_length &&
                                        column >= columns_[number].first &&
                                        column <= columns_[number].second;
                    tile.domains.back().ended |= inside ? 0 : 1U << static_cast<unsigned>(i);
                }
            }
        }
        stream.entered = true;
    }
    bool cut() { // false: the queue has no room
        const Number number = domain_of(span_["row"], column_);
        Domain& domain = cut_tile_->domains[number];
        std::uint32_t mask = 0;
        for (Number i = 0; i < facts_.segment_length; ++i) {
            const bool covered = column_ + i >= span_["x0"] && i < left_;
            mask |= covered ? 1U << static_cast<unsigned>(i) : 0;
        }
        if ((mask & live(domain)) != 0) {
            if (waiting_ == facts_.queue_depth) {
                return false;
            }
            const Number entry = features_.current().entry;
            domain.waiting.push_back({cut_tile_->number, cut_tile_->context, number, span_["splat"],
                                      span_["row"], column_, sequence_++, entry, mask});
            features_.hold(entry);
            ++cut_tile_->waiting;
            ++waiting_;
        }
        column_ += facts_.segment_length;
        left_ -= facts_.segment_length;
        return true;
    }

    std::uint64_t rank(const Domain& domain) const { // the lowest goes first
        const std::uint64_t oldest = domain.waiting.front().sequence;
        const std::uint64_t length = domain.waiting.size();
        return facts_.scan == 2 ? oldest + ((65535 - length) << 48U) : oldest;
    }
    // A domain ready at `date` in the stream's oldest tile that has one.
    Pick find(Stream& stream, Number date) {
        Pick pick;
        for (Number turn = stream.oldest; turn < stream.started() && pick.domain < 0; ++turn) {
            Tile& tile = stream.tiles[turn];
            const Number domains = Number(tile.domains.size());
            for (Number i = 0; i < domains; ++i) {
                const Number d = facts_.scan == 0 ? (tile.cursor + i) % domains : i;
                const Domain& domain = tile.domains[d];
                if (domain.waiting.empty() || domain.chosen || domain.ready > date) {
                    continue;
                }
                if (pick.domain < 0 ||
                    (facts_.scan != 0 && rank(domain) < rank(tile.domains[pick.domain]))) {
                    pick = {&stream, &tile, d};
                }
            }
        }
        return pick;
    }
    Pick choose(Number date) {
        Pick best;
        for (std::size_t i = 1; i <= streams_.size(); ++i) {
            const Pick pick = find(streams_[(issued_stream_ + i) % streams_.size()], date);
            const bool first = best.domain < 0 || (facts_.scan != 0 && pick.domain >= 0 &&
                                                   rank(pick.tile->domains[pick.domain]) <
                                                       rank(best.tile->domains[best.domain]));
            best = pick.domain >= 0 && first ? pick : best;
        }
        return best;
    }
    void issue() { // one after the other, nothing overtakes what finds no room
        for (Number i = 0; i < facts_.issue_width; ++i) {
            const Pick pick = choose(packing_.next_slot());
            if (pick.domain < 0 || !pack(pick)) {
                return;
            }
            move_on(pick);
        }
    }
    bool pack_chosen() { // false: the rest of the oldest group waits, and all behind it
        for (; !groups_.front().empty(); groups_.front().pop_front()) {
            const Pick pick = groups_.front().front();
            if (!pack(pick)) {
                return false;
            }
            pick.tile->domains[pick.domain].chosen = false;
        }
        groups_.pop_front();
        return true;
    }
    void choose_group() { // all at one date
        std::deque<Pick>& group = groups_.emplace_back();
        for (Number i = 0; i < facts_.issue_width; ++i) {
            const Pick pick = choose(packing_.next_slot(now_ + 1));
            if (pick.domain >= 0) {
                pick.tile->domains[pick.domain].chosen = true;
                group.push_back(pick);
                move_on(pick);
            }
        }
    }
    void forget(const Domain& emptied) {
        for (std::deque<Pick>& group : groups_) {
            for (std::size_t i = group.size(); i-- > 0;) {
                if (&group[i].tile->domains[group[i].domain] == &emptied) {
                    group.erase(group.begin() + static_cast<std::ptrdiff_t>(i));
                }
            }
        }
    }
    void move_on(const Pick& pick) {
        pick.tile->cursor = pick.domain + 1;
        issued_stream_ = index_of(*pick.stream);
    }
    bool pack(const Pick& pick) { // false: it has no room
        Domain& domain = pick.tile->domains[pick.domain];
        NaiveSegment segment = domain.waiting.front();
        const std::uint32_t wanted = segment.mask & live(domain);
        if (facts_.termination != 1 || wanted == 0) { // 1: one takes the others along
            segment.mask = wanted;
        }
        const Number tasks = __builtin_popcount(segment.mask);
        if (!packing_.has_room(segment, tasks)) {
            return false;
        }
        const Number slot = packing_.next_slot();
        Number ready = now_;
        if (tasks != 0) {
            ready = packing_.pack(segment) + facts_.reuse_cycles;
            domain.ready = facts_.scoreboard != 0 ? ready : 0;
        }
        lines_.say(now_, "issue", {slot, ready, segment.context, segment.domain, segment.mask});
        leave(*pick.tile, domain, ready);
        return true;
    }
    void end_tiles(Stream& stream) {
        for (; stream.oldest < stream.entering && stream.oldest < stream.startable;
             ++stream.oldest) {
            const Tile& tile = stream.tiles[stream.oldest];
            if (tile.waiting != 0) {
                return;
            }
            lines_.say(now_, "over", {tile.number, tile.context});
            packing_.end_tile(tile.number, tile.context);
            stream.tiles.erase(stream.oldest);
        }
    }

    NaiveFacts facts_;
    NaiveLines lines_;
    NaiveFeatures features_{facts_};
    NaivePacking packing_{facts_, lines_};
    std::map<std::string, std::map<Number, std::deque<Message>>> inputs_; // by kind and port
    std::map<Number, std::pair<Number, Number>> columns_; // of tiles, inside the image
    std::vector<Stream> streams_;
    std::size_t next_stream_ = 0, issued_stream_ = 0;
    Number now_ = 0, sequence_ = 0, waiting_ = 0;
    LoggedEvent span_; // that is cut, from column_ on
    Tile* cut_tile_ = nullptr;
    Number column_ = 0, left_ = 0;
    // What a pipelined bank has chosen and not packed, the oldest group first.
    std::deque<std::deque<Pick>> groups_{std::size_t(facts_.select_cycles)};
};

} // namespace degs::test
