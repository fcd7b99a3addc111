// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "dram/timing.hpp"

namespace degs::dram {

enum class BankState : std::uint8_t { Closed, Activating, Open };

/// The row buffers of a channel, and when each may take which command.
class Banks {
public:
    explicit Banks(const RuleTable& rules) : dates_(rules) {}

    unsigned count() const { return dates_.table().banks(); }
    BankState state(unsigned bank) const { return banks_[bank].state; }
    std::uint32_t row(unsigned bank) const { return banks_[bank].row; }
    /// Banks between ACT-1 and ACT-2, as a mask.
    std::uint32_t activating() const { return activating_; }
    bool all_closed() const { return open_ == 0; }
    const Dates& dates() const { return dates_; }
    /// CK with a row open, up to `date`.
    Ck open_until(Ck date) const {
        return open_time_ + (open_ != 0 && date > open_since_ ? date - open_since_ : 0);
    }
    /// CK with a row open, up to the last change.
    Ck open_time() const { return open_time_; }

    /// What a command has done to the row buffer.
    void activate(unsigned bank, std::uint32_t row, Ck date) {
        banks_[bank] = {BankState::Activating, row};
        activating_ |= 1U << bank;
        if (open_++ == 0) {
            open_since_ = date;
        }
    }
    void open(unsigned bank) {
        banks_[bank].state = BankState::Open;
        activating_ &= ~(1U << bank);
    }
    void close(unsigned bank, Ck date) {
        if (banks_[bank].state != BankState::Closed) {
            banks_[bank].state = BankState::Closed;
            if (--open_ == 0) {
                open_time_ += date - open_since_;
            }
        }
    }
    void close_all(Ck date) {
        for (unsigned bank = 0; bank < count(); ++bank) {
            close(bank, date);
        }
    }
    /// Dates the commands that may follow.
    void issue(Command command, unsigned bank, Ck date) { dates_.issue(command, bank, date); }

private:
    struct Bank {
        BankState state = BankState::Closed;
        std::uint32_t row = 0;
    };
    std::array<Bank, kMostBanks> banks_{};
    Dates dates_;
    std::uint32_t activating_ = 0;
    unsigned open_ = 0; // banks
    Ck open_since_ = 0, open_time_ = 0;
};

} // namespace degs::dram
