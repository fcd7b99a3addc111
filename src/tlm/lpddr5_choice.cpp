// SPDX-License-Identifier: Apache-2.0
// Which command a channel sends next, and when. The other half of lpddr5_channel.cpp.
#include "tlm/lpddr5_channel.hpp"

namespace degs {

void Lpddr5Channel::choose() {
    choice_ = Choice{};
    best_order_ = ~std::uint64_t{0};
    if (refreshing_) {
        choose_refresh();
    }
    choose_ordinary();
    if (!refreshing_ && choice_.date >= refresh_due_) {
        choice_ = Choice{};
        choice_.date = std::max(refresh_due_, clock_);
        choice_.start_refresh = true;
    }
    chosen_ = true;
}

void Lpddr5Channel::offer(Command command, unsigned bank, std::uint8_t slot, std::uint64_t order) {
    const Ck date = std::max(dates_.earliest(command, bank), clock_);
    if (date < choice_.date || (date == choice_.date && order < best_order_)) {
        choice_.date = date;
        choice_.command = command;
        choice_.bank = static_cast<std::uint8_t>(bank);
        choice_.slot = slot;
        best_order_ = order;
    }
}

void Lpddr5Channel::choose_ordinary() {
    std::uint32_t banks = pending_ & ~held_banks();
    if (scheduler_.oldest_only && queue().size() != 0) {
        banks &= 1U << queue().oldest_bank() | activating_;
    }
    for (; banks != 0; banks &= banks - 1) {
        const auto bank = static_cast<unsigned>(__builtin_ctz(banks));
        const Candidate& candidate = candidates_[bank];
        offer(candidate.command, bank, candidate.slot, candidate.order);
    }
}

std::uint32_t Lpddr5Channel::held_banks() const {
    if (!refreshing_) {
        return 0;
    }
    return config_.refresh == Lpddr5Refresh::AllBank
               ? ~0U
               : 1U << refresh_bank_ | 1U << (refresh_bank_ + kLpddr5RefreshPartner);
}

// Once a refresh is due its banks take nothing else: they finish an activation, close, refresh.
void Lpddr5Channel::choose_refresh() {
    const bool all = config_.refresh == Lpddr5Refresh::AllBank;
    bool open = false;
    for (std::uint32_t banks = held_banks() & ((1U << kLpddr5Banks) - 1); banks != 0;
         banks &= banks - 1) {
        const auto bank = static_cast<unsigned>(__builtin_ctz(banks));
        if (banks_[bank].state == BankState::Activating) {
            return offer(Command::Act2, bank, Lpddr5Queue::kNone, 0);
        }
        if (banks_[bank].state == BankState::Open) {
            open = true;
            if (!all) {
                return offer(Command::Pre, bank, Lpddr5Queue::kNone, 0);
            }
        }
    }
    if (all) {
        return offer(open ? Command::PreAb : Command::RefAb, 0, Lpddr5Queue::kNone, 0);
    }
    const unsigned partner = refresh_bank_ + kLpddr5RefreshPartner;
    const bool partner_later =
        dates_.earliest(Command::RefPb, partner) > dates_.earliest(Command::RefPb, refresh_bank_);
    offer(Command::RefPb, partner_later ? partner : refresh_bank_, Lpddr5Queue::kNone, 0);
}

} // namespace degs
