// SPDX-License-Identifier: Apache-2.0
// Which command a channel sends next, and when. The other half of lpddr5_channel.cpp.
#include "dram/channel.hpp"

namespace degs::dram {
namespace {

// Column commands win, then ACT-2, so that it keeps its deadline tAAD: a burst leaves every other
// CK to it. Then the oldest access.
constexpr std::uint64_t rank_of(Command command) {
    return is_column(command) ? 1 : command == Command::Act2 ? 2 : 3;
}
constexpr unsigned kAgeBits = 60;
constexpr std::uint64_t kNoOrder = ~std::uint64_t{0};

// A key of 32 bits is wait, rank, age, bank from high to low. No gap is longer than kMostWait, see
// Timing; ages are those of the latest arrivals, which all older ones share the first of.
constexpr unsigned kRankShift = 18, kWaitShift = 20, kKeyAgeShift = 4;
constexpr std::int32_t kMostWait = 4095, kMostAge = 16383;

} // namespace

void Channel::find_candidates() {
    for (unsigned bank = 0; bank < kBanks; ++bank) {
        find_candidate(bank);
    }
}

void Channel::find_candidate(unsigned bank) {
    constexpr std::uint8_t kNone = Queue::kNone;
    const Queue& waiting = queue();
    const Bank& state = banks_[bank];
    Candidate& candidate = candidates_[bank];
    candidate.slot = waiting.oldest(bank);
    if (state.state == BankState::Activating) {
        candidate.command = Command::Act2;
    } else if (candidate.slot == kNone) {
        pending_ &= ~(1U << bank);
        keys_.rest[bank] = ~0U;
        return;
    } else if (state.state == BankState::Closed) {
        candidate.command = Command::Act1;
    } else {
        find_open(bank, candidate);
    }
    const std::uint64_t age = candidate.slot == kNone ? 0 : waiting[candidate.slot].age;
    const std::uint64_t rank = rank_of(candidate.command);
    candidate.order = (rank << kAgeBits) + age;
    keys_.date[bank] =
        static_cast<std::uint32_t>(std::max(dates_.of_bank(candidate.command, bank), clock_));
    keys_.age[bank] = static_cast<std::uint32_t>(age);
    keys_.column[bank] = is_column(candidate.command) ? ~0U : 0U;
    keys_.act1[bank] = candidate.command == Command::Act1 ? ~0U : 0U;
    keys_.pre[bank] = candidate.command == Command::Pre ? ~0U : 0U;
    keys_.rest[bank] = static_cast<std::uint32_t>(rank) << kRankShift | bank;
    pending_ |= 1U << bank;
}

// A younger conflict does not close a row that an older access, or any hit, still wants.
void Channel::find_open(unsigned bank, Candidate& candidate) const {
    const Queue& waiting = writing_ ? writes_ : reads_;
    const std::uint32_t row = banks_[bank].row;
    const std::uint8_t hit = scheduler_.hits_first ? waiting.oldest_of_row(bank, row)
                             : waiting[candidate.slot].access.row == row ? candidate.slot
                                                                         : Queue::kNone;
    if (hit == Queue::kNone) {
        candidate.command = Command::Pre;
    } else {
        candidate.command = writing_ ? Command::Wr : Command::Rd;
        candidate.slot = hit;
    }
}

void Channel::choose() {
    choice_ = Choice{};
    best_order_ = kNoOrder;
    if (refreshing_) {
        choose_refresh();
    }
    choose_ordinary();
    if (!refreshing_ && choice_.date >= refresh_due_) {
        choice_ = Choice{};
        choice_.date = std::max(refresh_due_, clock_);
        choice_.start_refresh = true;
        best_order_ = 0;
    }
    chosen_ = true;
}

void Channel::offer(Command command, unsigned bank, std::uint8_t slot, std::uint64_t order) {
    const Ck date = std::max(dates_.earliest(command, bank), clock_);
    if (date < choice_.date || (date == choice_.date && order < best_order_)) {
        choice_.date = date;
        choice_.command = command;
        choice_.bank = static_cast<std::uint8_t>(bank);
        choice_.slot = slot;
        choice_.start_refresh = false;
        best_order_ = order;
    }
}

// A new access can change the candidate of its bank only, so the choice among the others stands.
void Channel::offer_candidate(unsigned bank) {
    if (!chosen_ || scheduler_.oldest_only || choice_.bank == bank) {
        chosen_ = false;
    } else if ((held_banks() & 1U << bank) == 0) {
        const Candidate& candidate = candidates_[bank];
        offer(candidate.command, bank, candidate.slot, candidate.order);
    }
}

void Channel::choose_ordinary() {
    std::uint32_t banks = pending_ & ~held_banks();
    if (scheduler_.oldest_only && queue().size() != 0) {
        banks &= 1U << queue().oldest_bank() | activating_;
    }
    if (banks == 0) {
        return;
    }
    const unsigned bank = banks == pending_ ? first_of_all() : first_of(banks);
    const Candidate& candidate = candidates_[bank];
    offer(candidate.command, bank, candidate.slot, candidate.order);
}

// The hot loop of a simulation: no branches, so that the compiler takes four banks at once.
unsigned Channel::first_of_all() const {
    const auto wait_of = [this](Command command, unsigned group) {
        const Ck date = std::max(dates_.of_others(command, group), clock_);
        return static_cast<std::uint32_t>(date - clock_);
    };
    const Command command = writing_ ? Command::Wr : Command::Rd;
    const std::uint32_t act1 = wait_of(Command::Act1, 0);
    const std::uint32_t pre = wait_of(Command::Pre, 0);
    const auto now = static_cast<std::uint32_t>(clock_);
    const auto latest = static_cast<std::uint32_t>((writing_ ? writes_ : reads_).arrivals());
    std::uint32_t best = ~0U;
    for (unsigned group = 0; group < 4; ++group) {
        const std::uint32_t column = wait_of(command, group);
        for (unsigned b = 4 * group; b < 4 * group + 4; ++b) {
            const std::uint32_t shared =
                (keys_.column[b] & column) | (keys_.act1[b] & act1) | (keys_.pre[b] & pre);
            // Dates lie at most a few thousand CK from now, on either side.
            const std::int32_t own = keys_.date[b] - now;
            const std::int32_t wait =
                std::min(std::max(own, static_cast<std::int32_t>(shared)), kMostWait);
            const std::int32_t age =
                std::max(kMostAge - static_cast<std::int32_t>(latest - keys_.age[b]), 0);
            best =
                std::min(best, wait << kWaitShift |
                                   static_cast<std::uint32_t>(age) << kKeyAgeShift | keys_.rest[b]);
        }
    }
    return best % kBanks;
}

/// The same for some of the banks, at least one.
unsigned Channel::first_of(std::uint32_t banks) const {
    Ck first = kNoDate;
    unsigned best = 0;
    for (; banks != 0; banks &= banks - 1) {
        const unsigned bank = __builtin_ctz(banks);
        const Candidate& candidate = candidates_[bank];
        const Ck date = std::max(dates_.earliest(candidate.command, bank), clock_);
        if (date < first || (date == first && candidate.order < candidates_[best].order)) {
            first = date;
            best = bank;
        }
    }
    return best;
}

std::uint32_t Channel::held_banks() const {
    if (!refreshing_) {
        return 0;
    }
    return config_.refresh == Refresh::AllBank
               ? ~0U
               : 1U << refresh_bank_ | 1U << (refresh_bank_ + kRefreshPartner);
}

// Once a refresh is due its banks take nothing else: they finish an activation, close, refresh.
void Channel::choose_refresh() {
    const bool all = config_.refresh == Refresh::AllBank;
    const std::uint32_t banks = held_banks();
    if (const std::uint32_t activating = banks & activating_; activating != 0) {
        return offer(Command::Act2, __builtin_ctz(activating), Queue::kNone, 0);
    }
    if (all) {
        return offer(open_banks_ != 0 ? Command::PreAb : Command::RefAb, 0, Queue::kNone, 0);
    }
    const unsigned partner = refresh_bank_ + kRefreshPartner;
    for (const unsigned bank : {refresh_bank_, partner}) {
        if (banks_[bank].state == BankState::Open) {
            return offer(Command::Pre, bank, Queue::kNone, 0);
        }
    }
    const bool partner_later =
        dates_.earliest(Command::RefPb, partner) > dates_.earliest(Command::RefPb, refresh_bank_);
    offer(Command::RefPb, partner_later ? partner : refresh_bank_, Queue::kNone, 0);
}

Ck Channel::admission_bound() {
    if (waiting() == 0) {
        return kNoDate;
    }
    if (!chosen_) {
        choose();
    }
    const bool full =
        (reads_.full() && !reads_in_.empty()) || (writes_.full() && !writes_in_.empty());
    return full ? std::min(next_admission(), column_bound()) : next_admission();
}

// Room comes with a column command. A bank that has not begun to open its row is tRCD away from it.
Ck Channel::column_bound() const {
    const Command column = writing_ ? Command::Wr : Command::Rd;
    Ck bound = choice_.date + timing_->rcd;
    for (std::uint32_t banks = pending_; banks != 0; banks &= banks - 1) {
        const unsigned bank = __builtin_ctz(banks);
        const Command command = candidates_[bank].command;
        if (is_column(command) || command == Command::Act2) {
            bound = std::min(bound, dates_.of_bank(column, bank));
        }
    }
    return std::max(bound, choice_.date);
}

} // namespace degs::dram
