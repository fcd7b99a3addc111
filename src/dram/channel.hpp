// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "dram/controller.hpp"
#include "dram/queue.hpp"
#include "dram/timing.hpp"

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
};

/// One x16 channel with its controller, as plain arithmetic without ticks and events. Work is
/// pushed with dates, and run(until) issues every command dated up to `until`, each at the first CK
/// in which it is legal and chosen. To see what would happen, run a copy.
///
/// Modelled: read and write queue; FR-FCFS and simpler schedulers; open and closed page; writes in
/// batches between two watermarks, at once when no read waits; forwarding of reads from queued
/// writes and merging of writes; all-bank and per-bank refresh; one command per CK, ACT in two.
/// Not modelled: postponed refreshes, a limit on how often a row hit overtakes, WCK start, power-
/// down; a read that a queued write covers only in part does not wait for it (contents are kept in
/// the order of arrival all the same).
class Channel {
public:
    struct Stats {
        std::array<std::uint64_t, kCommands> commands{};
        ByRowState bursts{};   ///< first burst of an access as it found the row, others hit
        ByRowState accesses{}; ///< of up to 64 B
        std::uint64_t forwarded = 0, merged = 0; ///< accesses that never reached the DRAM
        std::uint64_t drains = 0;                ///< turns from reads to writes
        Ck open = 0;                             ///< CK with a row open, up to the last change
        void add(const Stats& other);
        void subtract(const Stats& earlier);
    };

    /// `phase`: CK by which the first refresh comes early. The table outlives the channel.
    Channel(const Timing& timing, const RuleTable& rules, const ControllerConfig& config,
            Ck phase = 0);

    /// Dates never fall per direction, and are later than any `until` so far. True if the answer
    /// may come as soon as the queues have it, not only with the data.
    bool push(Access access);
    void run(Ck until, Outcome& outcome);
    /// The earliest date at which something happens if nothing more comes.
    Ck next_date();
    /// No access that waits for room in a queue, or for its date, gets in before this.
    Ck admission_bound();

    /// True if nothing is queued and nothing waits for a queue.
    bool idle() const;
    /// Accesses that wait for room in a queue, or for their date.
    std::size_t waiting() const { return reads_in_.size() + writes_in_.size(); }
    bool has_writes() const { return writes_.size() != 0 || !writes_in_.empty(); }
    /// Accesses that wait for room may be answered when they get in.
    bool answers_at_admission() const { return after_writes_ != 0 || !writes_in_.empty(); }
    const Stats& stats() const { return stats_; }
    Ck open_until(Ck date) const; ///< CK with a row open, up to `date`
    /// Called with every command; a copy of the channel has it too unless it is taken away.
    void observe(std::function<void(const Issued&)> observer) { observer_ = std::move(observer); }

private:
    enum class BankState : std::uint8_t { Closed, Activating, Open };
    struct Bank {
        BankState state = BankState::Closed;
        std::uint32_t row = 0;
    };
    struct Candidate {           // the next command of a bank for the current direction
        std::uint64_t order = 0; // rank, then age
        Command command = Command::Pre;
        std::uint8_t slot = Queue::kNone;
    };
    /// The same once more, one array each and in 32 bits: all banks are compared at once. Masks say
    /// what holds a bank back beside itself.
    struct Keys {
        using PerBank = std::array<std::uint32_t, kBanks>;
        alignas(16) PerBank date{}, age{}, column{}, act1{}, pre{};
        PerBank rest{}; // rank and bank, the same bits as in a key; all ones: no candidate
    };
    struct Choice {
        Ck date = kNoDate;
        Command command = Command::Pre;
        std::uint8_t bank = 0;
        std::uint8_t slot = Queue::kNone;
        bool start_refresh = false; // no command: from here on refresh comes first
    };

    Queue& queue() { return writing_ ? writes_ : reads_; }
    Ck refresh_period() const;
    Ck column_bound() const;
    Ck next_admission() const;
    void enqueue(Queue& to, const Access& access);
    void admit(Ck date, Outcome& outcome);
    bool forward(const Access& access) const;
    static std::size_t hash(const Access& access) {
        return (access.row * 37U + access.bank * 11U + access.block) % 256;
    }
    bool merge(const Access& access);
    void choose_direction();

    void find_candidates();
    void find_candidate(unsigned bank);
    void find_open(unsigned bank, Candidate& candidate) const;
    void choose();
    void choose_ordinary();
    unsigned first_of_all() const;
    unsigned first_of(std::uint32_t banks) const;
    void choose_refresh();
    void offer(Command command, unsigned bank, std::uint8_t slot, std::uint64_t order);
    void offer_candidate(unsigned bank);
    std::uint32_t held_banks() const;

    void perform(Outcome& outcome);
    void row_command(const Choice& choice);
    void change_row(const Choice& choice);
    void column(Outcome& outcome);
    void issue(Command command, unsigned bank, unsigned row);
    void close(unsigned bank);

    const Timing* timing_;
    ControllerConfig config_;
    Scheduler scheduler_;
    bool auto_precharge_;
    unsigned write_high_, write_low_; // entries

    Ck clock_ = 0; // the next command comes here or later
    Dates dates_;
    std::array<Bank, kBanks> banks_{};
    unsigned open_banks_ = 0;
    std::uint32_t activating_ = 0; // banks between ACT-1 and ACT-2
    Ck open_since_ = 0;
    Queue reads_, writes_;
    std::deque<Access> reads_in_, writes_in_; // wait for their date or for room
    bool writing_ = false;
    // The number of waiting writes by hash. It shows at arrival that a read has nothing to wait for.
    std::array<std::uint16_t, 256> writes_of_hash_{};
    std::size_t after_writes_ = 0; // reads in reads_in_ with after_write

    std::array<Candidate, kBanks> candidates_{};
    Keys keys_;                 // of banks without a candidate: absent
    std::uint32_t pending_ = 0; // banks with a candidate
    Choice choice_;
    std::uint64_t best_order_ = 0; // of choice_
    bool chosen_ = false;          // choice_ is up to date

    Ck refresh_due_;
    bool refreshing_ = false;
    unsigned refresh_bank_ = 0; // first of the pair that is next

    Stats stats_;
    std::function<void(const Issued&)> observer_;
};

} // namespace degs::dram
