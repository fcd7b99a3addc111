// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "modules/degs/span_engine/span_replay.hpp"

namespace degs {

/// A Span Unit that takes rows of several tile streams in turn, one per cycle, all for one bank,
/// where rows come with outcomes. Dates and counts are those of SpanPool, which does the same for
/// all other designs and in strict mode.
///
/// Which row it takes in a cycle depends on what is in every lane and on every place of the
/// crossbar, so it goes on only while all of that is known. It works when the bank asks, when a
/// lane is full, and when what it lacked is there; until then rows stay in their lanes.
class SpanTurns final : public Pumped {
public:
    /// One of `streams` per tile stream. All of them must exist as long as this object.
    SpanTurns(Process& unit, const std::vector<SpanReplay*>& streams, TileEnd& tiles);

    void pump() override;
    /// A bank calls this when it has taken all that it was sent, and wants more.
    Cycle ask() override;
    /// A bank has taken an item of a full ring, so that earlier answers no longer hold.
    void has_room() { asked_at_ = 0; }
    /// True if somebody waits for what follows from a row of this lane.
    bool waits_for(const SpanReplay& lane) const {
        return wanted_ && (unknown_ == nullptr || unknown_ == &lane);
    }
    /// The unit's thread runs this. It goes on whenever Process::wake_at() wakes it.
    void run();

private:
    struct Stream {
        SpanReplay* spans = nullptr;
        Stream* next = nullptr;     // in turn
        Cycle from = kNever;        // date from which it has something to do, as far as is known
        bool ends = false;          // what it has to do then is the end of a tile
        bool ending = false;        // that has left the lane, and has to be sent
        std::size_t end_number = 0; // of it
    };
    /// What has to be known before the unit can act.
    enum class Missing { Nothing, Item, Room };

    void go_on();
    inline Cycle next_known(Stream* changed);
    static inline void look_at(Stream& stream);
    inline Missing missing(const Stream& stream, Cycle date) const;
    [[gnu::noinline]] Missing missing_of_ends(SpanReplay& spans, Cycle date) const;
    inline bool is_quiet(SpanReplay& spans, Cycle date) const;
    bool stays_full(const SpanReplay& spans, Cycle date) const;
    [[gnu::noinline]] void wait_for(SpanReplay& spans, Missing what, Cycle date);
    inline Stream* take(Cycle date);
    [[gnu::noinline]] void pass_ends(Cycle date);
    void pass_end(Stream& stream, Cycle date);
    inline void sent(const SpanReplay& spans, bool was_empty);

    Process& unit_;
    TileEnd& tiles_;
    std::vector<Stream> streams_;
    Stream* next_;                        // from whose lane a row is taken next
    const SpanReplay* unknown_ = nullptr; // what came next in this lane was not known last
    Cycle due_ = kNever;                  // date at which it has something to do, if that is known
    std::uint64_t asked_at_ = 0;          // in vain: Process::activation() + 1, else 0
    std::size_t ending_ = 0;              // streams with the end of a tile in hand
    bool wanted_ = false;                 // by the bank
    bool working_ = false;
};

} // namespace degs
