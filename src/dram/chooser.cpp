// SPDX-License-Identifier: Apache-2.0
#include "dram/chooser.hpp"

#include <algorithm>

namespace degs::dram {
namespace {

constexpr std::uint64_t kNoOrder = ~std::uint64_t{0};

// A key of 32 bits is wait, rank, age, bank from high to low. No gap is longer than kMostWait, see
// Timing. Ages are relative to the latest arrival; anything older than kMostAge counts as oldest.
constexpr unsigned kWaitShift = 20, kKeyAgeShift = 4;
constexpr std::int32_t kMostWait = 4095, kMostAge = 16383;
constexpr unsigned kFewBanks = 1U << kKeyAgeShift; // that all are compared at once

bool few_banks(const ChannelState& state) {
    return state.banks.count() == kFewBanks;
}

} // namespace

void Chooser::update_all(const ChannelState& state) {
    for (unsigned bank = 0; bank < state.banks.count(); ++bank) {
        update(bank, state);
    }
}

void Chooser::add(unsigned bank, const ChannelState& state) {
    update(bank, state);
    if (!chosen_ || selective_ || choice_.bank == bank) {
        chosen_ = false;
    } else if ((state.refresher.held_banks() & 1U << bank) == 0) {
        offer(candidates_[bank], bank, state);
    }
}

// The hot loop of a simulation: no branches, so that the compiler takes four banks at once.
inline __attribute__((always_inline)) unsigned
Chooser::first_of_all(const ChannelState& state) const {
    const Dates& dates = state.banks.dates();
    const Ck now = state.clock;
    const auto wait_of = [&](Command command, unsigned group) {
        const Ck date = std::max(dates.of_others(command, group), now);
        return static_cast<std::uint32_t>(date - now);
    };
    const Command command = column_of(state.queues);
    const std::uint32_t pre = wait_of(Command::Pre, 0);
    const auto short_now = static_cast<std::uint32_t>(now);
    const auto latest = static_cast<std::uint32_t>(state.queues.current().arrivals());
    std::uint32_t best = ~0U;
    for (unsigned group = 0; group < 4; ++group) {
        const std::uint32_t column = wait_of(command, group);
        const std::uint32_t act1 = wait_of(Command::Act1, group);
        for (unsigned b = 4 * group; b < 4 * group + 4; ++b) {
            const std::uint32_t shared =
                (keys_.column[b] & column) | (keys_.act1[b] & act1) | (keys_.pre[b] & pre);
            // Dates lie at most a few thousand CK from now, on either side.
            const std::int32_t own = keys_.date[b] - short_now;
            const std::int32_t wait =
                std::min(std::max(own, static_cast<std::int32_t>(shared)), kMostWait);
            const std::int32_t age =
                std::max(kMostAge - static_cast<std::int32_t>(latest - keys_.age[b]), 0);
            best =
                std::min(best, wait << kWaitShift |
                                   static_cast<std::uint32_t>(age) << kKeyAgeShift | keys_.rest[b]);
        }
    }
    return best % kFewBanks;
}

void Chooser::find(const ChannelState& state) {
    const Refresher& refresher = state.refresher;
    choice_ = Choice{};
    best_order_ = kNoOrder;
    if (refresher.active()) {
        const Refresher::Step step = refresher.next(state.banks);
        offer({0, step.command, Queue::kNone}, step.bank, state);
    }
    find_ordinary(state);
    if (!refresher.active() && choice_.date >= refresher.due()) {
        choice_ = Choice{};
        choice_.date = std::max(refresher.due(), state.clock);
        choice_.start_refresh = true;
        best_order_ = 0;
    }
    chosen_ = true;
}

void Chooser::find_ordinary(const ChannelState& state) {
    const std::uint32_t allowed = pending_ & ~state.refresher.held_banks();
    if (special_) {
        find_by_policy(allowed, state);
    } else if (allowed != 0) {
        const unsigned bank = allowed == pending_ && few_banks(state) ? first_of_all(state)
                                                                      : first_of(allowed, state);
        offer(candidates_[bank], bank, state);
    }
}

void Chooser::find_by_policy(std::uint32_t allowed, const ChannelState& state) {
    if (selective_ && state.queues.current().size() != 0) {
        allowed &= policy_->eligible(state.queues.current()) | state.banks.activating();
    }
    if (allowed != 0) {
        const bool all = allowed == pending_ && !has_order_ && few_banks(state);
        const unsigned bank = all ? first_of_all(state) : first_of(allowed, state);
        offer(candidates_[bank], bank, state);
    }
}

/// The first of some banks, at least one, in any order of the policy.
unsigned Chooser::first_of(std::uint32_t banks, const ChannelState& state) const {
    const Dates& dates = state.banks.dates();
    Ck first = kNoDate;
    unsigned best = 0;
    for (; banks != 0; banks &= banks - 1) {
        const unsigned bank = first_bank(banks);
        const Candidate& candidate = candidates_[bank];
        const Ck date = std::max(dates.earliest(candidate.command, bank), state.clock);
        if (date < first || (date == first && candidate.order < candidates_[best].order)) {
            first = date;
            best = bank;
        }
    }
    return best;
}

// A bank that has not begun to open its row is tRCD away from a column command.
Ck Chooser::column_bound(const ChannelState& state, int rcd) const {
    Ck bound = choice_.date + rcd;
    for (std::uint32_t rest = pending_; rest != 0; rest &= rest - 1) {
        const unsigned bank = first_bank(rest);
        const Command command = candidates_[bank].command;
        if (is_column(command) || command == Command::Act2) {
            bound = std::min(bound, state.banks.dates().of_bank(column_of(state.queues), bank));
        }
    }
    return std::max(bound, choice_.date);
}

} // namespace degs::dram
