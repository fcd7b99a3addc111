// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "dram/banks.hpp"
#include "dram/chooser.hpp"
#include "dram/controller.hpp"
#include "dram/queues.hpp"
#include "dram/refresher.hpp"
#include "dram/timing.hpp"
#include "stats/statistics.hpp"

namespace degs::dram {

/// A command as it goes over the bus.
struct Issued {
    Command command;
    Ck date;
    unsigned bank; ///< RefPb: also its partner; PreAb, RefAb: 0
    unsigned row;  ///< ACT-1 and column commands
};

struct Answer {
    std::uint32_t id = 0;
    Ck date = 0; ///< last beat; of a posted write the CK after it has entered the write queue
};

/// The results of a run.
struct Outcome {
    std::vector<Answer> answers;         ///< in no order of dates
    std::vector<std::uint32_t> admitted; ///< ids of accesses that have entered a queue

    /// Written in place: a host is slow to copy as one word what it has just written as several.
    void answer(std::uint32_t id, Ck date) {
        Answer& answer = answers.emplace_back();
        answer.id = id;
        answer.date = date;
    }
};

/// One channel with its controller, as plain arithmetic without ticks and events. Work is
/// pushed with dates, and run(until) issues every command dated up to `until`, each at the first CK
/// in which it is legal and chosen. To see what would happen, run a copy.
///
/// Modelled:
/// * read and write queue, FR-FCFS and other policies, open and closed page
/// * levels of reads, of which the higher ones go first, and urgent reads of a level, which enter
///   the read queue before others
/// * writes in batches between two watermarks, and at once when no read waits
/// * forwarding of reads from queued writes, and merging of writes
/// * all-bank and per-bank refresh
/// * one command per CK, ACT in two, or as `command_buses`, `command_ck`, `act_commands` say
///
/// Not modelled: postponed refreshes, WCK start, power-down. A read that a queued write covers only
/// in part does not wait for it; contents are kept in the order of arrival all the same.
class Channel {
public:
    struct Stats {
        std::array<std::uint64_t, kCommands> commands{};
        ByRowState bursts{};   ///< first burst of an access as it found the row, others hit
        ByRowState accesses{}; ///< of up to 64 B
        std::uint64_t forwarded = 0, merged = 0; ///< accesses that never reached the DRAM
        std::uint64_t forwarded_bursts = 0, merged_bursts = 0; ///< never reached the DRAM
        std::uint64_t drains = 0;                              ///< turns from reads to writes
        /// The number of all column commands.
        std::uint64_t column_commands() const;
        Ck open = 0; ///< CK with a row open, up to the last change
        void add(const Stats& other);
        void subtract(const Stats& earlier);
        /// All but `open`, from which the energy follows.
        void describe(StatsVisitor& v) const;
    };

    /// `phase`: CK by which the first refresh comes early. The table outlives the channel.
    Channel(const Timing& timing, const RuleTable& rules, const ControllerConfig& config,
            Ck phase = 0);

    /// Dates never fall per direction, and are later than any `until` so far. True if the answer
    /// may come as soon as the queues have it, not only with the data.
    bool push(const Access& access) { return state_.queues.push(marked(access)); }
    /// The access as push() takes it in.
    Access marked(const Access& access) const { return state_.queues.marked(access); }
    /// Takes an access of marked().
    void push_marked(const Access& access) { state_.queues.push(access); }
    /// An access of this kind that came now would get into its queue at once.
    bool welcomes(Queues::Kind kind) const { return state_.queues.welcomes(kind); }
    void run(Ck until, Outcome& outcome);
    /// Does the one thing that happens next, an admission or a command, and returns its date. There
    /// must be one: next_date() is not kNoDate.
    Ck step(Outcome& outcome);
    /// The earliest date at which something happens if nothing more comes.
    Ck next_date() { return std::min(choice().date, next_admission()); }
    /// No access that waits for room in a queue, or for its date, gets in before this.
    Ck admission_bound();

    /// True if nothing is queued and nothing waits for a queue.
    bool idle() const { return state_.queues.idle(); }
    /// Bursts of all accesses so far that have not been issued.
    std::uint64_t bursts_left() const { return state_.queues.bursts_left(); }
    /// Accesses that wait for room in a queue, or for their date.
    std::size_t waiting() const { return state_.queues.waiting(); }
    bool has_writes() const { return state_.queues.has_writes(); }
    /// Accesses that wait for room may be answered when they get in.
    bool answers_at_admission() const { return state_.queues.answers_at_admission(); }
    const Stats& stats() const { return stats_; }
    /// CK with a row open, up to `date`.
    Ck open_until(Ck date) const { return state_.banks.open_until(date); }
    /// Calls `observer` with every command. A copy of the channel calls it, too, until it gets
    /// another one.
    void observe(std::function<void(const Issued&)> observer) { observer_ = std::move(observer); }

private:
    const Chooser::Choice& choice() { return chooser_.choose(state_); }
    Ck next_admission() const { return std::max(state_.queues.next_admission(), state_.clock); }
    inline void proceed(Ck command, Ck admission, Outcome& outcome);
    void admit(Ck date, Outcome& outcome);
    void turn() {
        if (state_.queues.turn()) {
            begin_direction();
        }
    }
    [[gnu::noinline]] void begin_direction();
    void perform(Outcome& outcome);
    void row_command(const Chooser::Choice& choice);
    void change_row(const Chooser::Choice& choice);
    void column(const Chooser::Choice& choice, Outcome& outcome);
    void answer(const Access& access, Outcome& outcome) const;
    void issue(Command command, unsigned bank);

    const Timing* timing_;
    const RuleTable* rules_;
    Ck bus_ck_; // that a command keeps all others off the bus
    bool posted_writes_;
    bool auto_precharge_;
    int read_latency_; // CK, of the timing, which would divide for every answer
    ChannelState state_;
    Chooser chooser_;
    Stats stats_;
    std::function<void(const Issued&)> observer_;
};

} // namespace degs::dram
