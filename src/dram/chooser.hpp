// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "dram/banks.hpp"
#include "dram/policy.hpp"
#include "dram/queues.hpp"
#include "dram/refresher.hpp"

namespace degs::dram {

/// The state from which the next command of a channel follows.
struct ChannelState {
    Ck clock = 0; ///< the next command comes here or later
    Banks banks;
    Queues queues;
    Refresher refresher;
};

/// Chooses which command a channel sends next, and when. Ready commands go first. Among them column
/// commands go before others, and older ones before younger ones, unless the policy has an order of
/// its own. A command that the policy holds back waits.
class Chooser {
public:
    struct Choice {
        Ck date = kNoDate;
        Command command = Command::Pre;
        std::uint8_t bank = 0;
        std::uint8_t slot = Queue::kNone; ///< of the current queue
        bool start_refresh = false;       ///< no command: from here on refresh comes first
    };

    explicit Chooser(const PolicyHolder& policy)
        : policy_(policy), selective_(policy->selective()), has_order_(policy->has_order()),
          special_(selective_ || has_order_) {
        keys_.rest.fill(~0U);
    }

    /// Must be called for what happens to a bank before its update().
    Policy& policy() { return *policy_; }

    /// Updates what a bank, or every bank, would do next. Must be called after every such change.
    void update(unsigned bank, const ChannelState& state) { policy_->update(*this, bank, state); }
    template <class Chosen>
    void update(const Chosen& policy, unsigned bank, const ChannelState& state);
    void update_all(const ChannelState& state);
    /// Updates a bank that has got one more access, which leaves the choice among the others.
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
    static constexpr unsigned kAgeBits = 60;   // of an order
    static constexpr unsigned kRankShift = 18; // in a key of 32 bits
    // Column commands win, then ACT-2, so that it keeps its deadline tAAD: a burst leaves every
    // other CK to it. Then the oldest access.
    static constexpr std::uint32_t rank_of(Command command) {
        return is_column(command) ? 1 : command == Command::Act2 ? 2 : 3;
    }
    static Command column_of(const Queues& queues) {
        return queues.writing() ? Command::Wr : Command::Rd;
    }
    struct Candidate {           // the next command of a bank for the current direction
        std::uint64_t order = 0; // rank, then age; or that of the policy
        Command command = Command::Pre;
        std::uint8_t slot = Queue::kNone;
    };
    /// The candidates once more, one array each and in 32 bits: all banks are compared at once.
    /// Masks say what holds a bank back beside itself.
    struct Keys {
        using PerBank = std::array<std::uint32_t, kMostBanks>;
        alignas(16) PerBank date{}, age{}, column{}, act1{}, pre{};
        PerBank rest{}; // rank and bank, the same bits as in a key; all ones: no candidate
    };

    void find(const ChannelState& state);
    void find_ordinary(const ChannelState& state);
    [[gnu::noinline]] void find_by_policy(std::uint32_t allowed, const ChannelState& state);
    inline unsigned first_of_all(const ChannelState& state) const;
    unsigned first_of(std::uint32_t banks, const ChannelState& state) const;
    /// Takes a command as the choice if it goes before the present one.
    void offer(const Candidate& candidate, unsigned bank, const ChannelState& state) {
        const Ck date =
            std::max(state.banks.dates().earliest(candidate.command, bank), state.clock);
        // Levels may bring about equal orders; the first bank goes first, as among all of them.
        const bool first = candidate.order < best_order_ ||
                           (candidate.order == best_order_ && bank < choice_.bank);
        if (date < choice_.date || (date == choice_.date && first)) {
            choice_ = {date, candidate.command, static_cast<std::uint8_t>(bank), candidate.slot,
                       false};
            best_order_ = candidate.order;
        }
    }

    PolicyHolder policy_;
    bool selective_, has_order_; // of the policy
    bool special_;               // either of them
    std::array<Candidate, kMostBanks> candidates_{};
    Keys keys_;                 // of banks without a candidate: absent
    std::uint32_t pending_ = 0; // banks with a candidate
    Choice choice_;
    std::uint64_t best_order_ = 0; // of choice_
    bool chosen_ = false;          // choice_ is up to date
};

template <class Chosen>
void Chooser::update(const Chosen& policy, unsigned bank, const ChannelState& state) {
    const Banks& banks = state.banks;
    constexpr std::uint8_t kNone = Queue::kNone;
    const Queue& waiting = state.queues.current();
    Candidate& candidate = candidates_[bank];
    candidate.slot = waiting.oldest(bank);
    if (banks.state(bank) == BankState::Activating) {
        candidate.command = Command::Act2;
    } else if (candidate.slot == kNone) {
        pending_ &= ~(1U << bank);
        keys_.rest[bank] = ~0U;
        return;
    } else if (banks.state(bank) == BankState::Closed) {
        candidate.command = Command::Act1;
    } else if (const std::uint8_t hit = policy.hit(waiting, bank, banks.row(bank)); hit != kNone) {
        candidate.command = column_of(state.queues);
        candidate.slot = hit;
    } else {
        candidate.command = Command::Pre;
    }
    const std::uint64_t age = candidate.slot == kNone ? 0 : waiting[candidate.slot].age;
    const std::uint32_t rank = rank_of(candidate.command);
    if (!policy.has_order()) {
        candidate.order = (std::uint64_t{rank} << kAgeBits) + age;
    } else if (candidate.command == Command::Act2) {
        candidate.order = 1; // behind a refresh
    } else {
        candidate.order = 2 + policy.order({candidate.command, bank, waiting[candidate.slot]});
    }
    keys_.date[bank] = static_cast<std::uint32_t>(
        std::max(banks.dates().of_bank(candidate.command, bank), state.clock));
    keys_.age[bank] = static_cast<std::uint32_t>(age);
    keys_.column[bank] = is_column(candidate.command) ? ~0U : 0U;
    keys_.act1[bank] = candidate.command == Command::Act1 ? ~0U : 0U;
    keys_.pre[bank] = candidate.command == Command::Pre ? ~0U : 0U;
    keys_.rest[bank] = rank << kRankShift | bank;
    pending_ |= 1U << bank;
}

} // namespace degs::dram
