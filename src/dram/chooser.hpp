// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "dram/banks.hpp"
#include "dram/queues.hpp"
#include "dram/refresher.hpp"
#include "dram/scheduler.hpp"

namespace degs::dram {

/// The state from which the next command of a channel follows.
struct ChannelState {
    Ck clock = 0; ///< the next command comes here or later
    Banks banks;
    Queues queues;
    Refresher refresher;
};

/// Chooses which command a channel sends next, and when. Ready commands go first. Among them column
/// commands go before others, and older ones before younger ones. A command that the scheduler holds
/// back waits.
class Chooser {
public:
    struct Choice {
        Ck date = kNoDate;
        Command command = Command::Pre;
        std::uint8_t bank = 0;
        std::uint8_t slot = Queue::kNone; ///< of the current queue
        bool start_refresh = false;       ///< no command: from here on refresh comes first
    };

    explicit Chooser(const Scheduler& scheduler)
        : scheduler_(scheduler), selective_(scheduler.selective()) {
        keys_.rest.fill(~0U);
    }

    /// Updates what a bank, or every bank, would do next. Must be called after every such change.
    void update(unsigned bank, const ChannelState& state);
    void update_all(const ChannelState& state);
    /// The same for a bank that has got one more access, which leaves the choice among the others.
    void add(unsigned bank, const ChannelState& state);

    /// The command that comes next if nothing more comes; it stays until drop() or add().
    const Choice& choose(const ChannelState& state) {
        if (!chosen_) {
            find(state);
        }
        return choice_;
    }
    void drop() { chosen_ = false; }
    /// No column command goes before this; the choice must be up to date.
    Ck column_bound(const ChannelState& state, int rcd) const;

private:
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

    void find(const ChannelState& state);
    void find_ordinary(const ChannelState& state);
    unsigned first_of_all(const ChannelState& state) const;
    unsigned first_of(std::uint32_t banks, const ChannelState& state) const;
    /// Takes a command as the choice if it goes before the present one.
    void offer(const Candidate& candidate, unsigned bank, const ChannelState& state) {
        const Ck date =
            std::max(state.banks.dates().earliest(candidate.command, bank), state.clock);
        if (date < choice_.date || (date == choice_.date && candidate.order < best_order_)) {
            choice_ = {date, candidate.command, static_cast<std::uint8_t>(bank), candidate.slot,
                       false};
            best_order_ = candidate.order;
        }
    }

    Scheduler scheduler_;
    bool selective_;
    std::array<Candidate, kBanks> candidates_{};
    Keys keys_;                 // of banks without a candidate: absent
    std::uint32_t pending_ = 0; // banks with a candidate
    Choice choice_;
    std::uint64_t best_order_ = 0; // of choice_
    bool chosen_ = false;          // choice_ is up to date
};

} // namespace degs::dram
