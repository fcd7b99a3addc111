// SPDX-License-Identifier: Apache-2.0
#include "dram/channel.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

unsigned entries(double share, int depth) {
    return static_cast<unsigned>(std::floor(share * depth + 0.5));
}

/// Applies `change` to every counter of `stats` and its counterpart.
template <class Change>
void each_counter(Lpddr5Channel::Stats& stats, const Lpddr5Channel::Stats& other,
                  const Change& change) {
    for (std::size_t c = 0; c < stats.commands.size(); ++c) {
        change(stats.commands[c], other.commands[c]);
    }
    for (std::size_t s = 0; s < stats.bursts.size(); ++s) {
        change(stats.bursts[s], other.bursts[s]);
        change(stats.accesses[s], other.accesses[s]);
    }
    change(stats.forwarded, other.forwarded);
    change(stats.merged, other.merged);
    change(stats.drains, other.drains);
    change(stats.open, other.open);
}

} // namespace

void Lpddr5Channel::Stats::add(const Stats& other) {
    each_counter(*this, other, [](std::uint64_t& mine, std::uint64_t its) { mine += its; });
}

void Lpddr5Channel::Stats::subtract(const Stats& earlier) {
    each_counter(*this, earlier, [](std::uint64_t& mine, std::uint64_t its) { mine -= its; });
}

Lpddr5Channel::Lpddr5Channel(const Lpddr5Timing& timing, const Lpddr5RuleTable& rules,
                             const Lpddr5ControllerConfig& config, Ck phase)
    : timing_(&timing), config_(config),
      scheduler_(lpddr5_schedulers()[static_cast<std::size_t>(config.scheduler)]),
      auto_precharge_(
          lpddr5_page_policies()[static_cast<std::size_t>(config.page_policy)].auto_precharge),
      write_high_(std::max(1U, entries(config.write_high, config.write_queue))),
      write_low_(entries(config.write_low, config.write_queue)), dates_(rules),
      reads_(static_cast<unsigned>(config.read_queue)),
      writes_(static_cast<unsigned>(config.write_queue)),
      refresh_due_(config.refresh == Lpddr5Refresh::None
                       ? kNoDate
                       : refresh_period() - std::min(phase, refresh_period())) {
    keys_.rest.fill(~0U);
}

Ck Lpddr5Channel::refresh_period() const {
    const auto all_banks = static_cast<Ck>(timing_->refi);
    return config_.refresh == Lpddr5Refresh::PerBank ? all_banks / kLpddr5RefreshSteps : all_banks;
}

bool Lpddr5Channel::idle() const {
    return reads_.size() == 0 && writes_.size() == 0 && reads_in_.empty() && writes_in_.empty();
}

Ck Lpddr5Channel::open_until(Ck date) const {
    return stats_.open + (open_banks_ != 0 && date > open_since_ ? date - open_since_ : 0);
}

bool Lpddr5Channel::push(Lpddr5Access access) {
    if (access.write) {
        ++writes_of_hash_[hash(access)];
        writes_in_.push_back(access);
        return config_.posted_writes;
    }
    access.after_write = writes_of_hash_[hash(access)] != 0;
    after_writes_ += access.after_write ? 1 : 0;
    reads_in_.push_back(access);
    return access.after_write;
}

void Lpddr5Channel::run(Ck until, Lpddr5Outcome& outcome) {
    for (;;) {
        if (!chosen_) {
            choose();
        }
        const Ck admission = next_admission();
        if (std::min(admission, choice_.date) > until) {
            return;
        }
        // An access may send its first command in the CK in which it comes.
        if (admission <= choice_.date) {
            admit(admission, outcome);
        } else {
            perform(outcome);
        }
    }
}

Ck Lpddr5Channel::next_date() {
    if (!chosen_) {
        choose();
    }
    return std::min(choice_.date, next_admission());
}

Ck Lpddr5Channel::next_admission() const {
    Ck date = kNoDate;
    if (!reads_in_.empty() && !reads_.full()) {
        date = reads_in_.front().date;
    }
    if (!writes_in_.empty() && !writes_.full()) {
        date = std::min(date, writes_in_.front().date);
    }
    return std::max(date, clock_);
}

void Lpddr5Channel::admit(Ck date, Lpddr5Outcome& outcome) {
    clock_ = date;
    while (!writes_in_.empty() && !writes_.full() && writes_in_.front().date <= date) {
        const Lpddr5Access access = writes_in_.front();
        writes_in_.pop_front();
        outcome.admitted.push_back(access.id);
        if (config_.posted_writes) {
            outcome.answers.push_back({access.id, date + 1});
        }
        if (!config_.posted_writes || !merge(access)) {
            enqueue(writes_, access);
        }
    }
    while (!reads_in_.empty() && !reads_.full() && reads_in_.front().date <= date) {
        const Lpddr5Access access = reads_in_.front();
        reads_in_.pop_front();
        outcome.admitted.push_back(access.id);
        after_writes_ -= access.after_write ? 1 : 0;
        if (access.after_write && forward(access)) {
            ++stats_.forwarded;
            outcome.answers.push_back({access.id, date + 1});
        } else {
            enqueue(reads_, access);
        }
    }
    choose_direction();
}

void Lpddr5Channel::enqueue(Lpddr5Queue& to, const Lpddr5Access& access) {
    to.push(access);
    if (&to == &queue()) {
        find_candidate(access.bank);
        offer_candidate(access.bank);
    }
}

bool Lpddr5Channel::forward(const Lpddr5Access& access) const {
    const std::uint8_t slot = writes_.find(access.bank, access.row, access.block);
    return slot != Lpddr5Queue::kNone && (access.bursts & ~writes_[slot].access.bursts) == 0;
}

bool Lpddr5Channel::merge(const Lpddr5Access& access) {
    const std::uint8_t slot = writes_.find(access.bank, access.row, access.block);
    if (slot == Lpddr5Queue::kNone) {
        return false;
    }
    writes_[slot].access.bursts |= access.bursts;
    writes_[slot].left |= access.bursts;
    --writes_of_hash_[hash(access)];
    ++stats_.merged;
    return true;
}

// Reads first; writes in batches, or when there is nothing else to do. Asked only when the size of
// a queue has changed, so a direction always gets something done.
void Lpddr5Channel::choose_direction() {
    const unsigned reads = reads_.size();
    const unsigned writes = writes_.size();
    const bool write = writing_ ? writes != 0 && (writes > write_low_ || reads == 0)
                                : writes >= write_high_ || (reads == 0 && writes != 0);
    if (write != writing_) {
        writing_ = write;
        stats_.drains += write ? 1 : 0;
        find_candidates();
        chosen_ = false;
    }
}

void Lpddr5Channel::perform(Lpddr5Outcome& outcome) {
    const Choice choice = choice_;
    chosen_ = false;
    clock_ = choice.date;
    if (choice.start_refresh) {
        refreshing_ = true;
        return;
    }
    if (is_column(choice.command)) {
        column(outcome);
    } else {
        row_command(choice);
    }
    ++clock_;
}

void Lpddr5Channel::row_command(const Choice& choice) {
    const unsigned bank = choice.bank;
    change_row(choice);
    issue(choice.command, bank, banks_[bank].row);
    if (choice.command == Command::PreAb) {
        find_candidates();
    } else {
        find_candidate(bank);
        if (choice.command == Command::RefPb) {
            find_candidate(bank ^ kLpddr5RefreshPartner);
        }
    }
}

void Lpddr5Channel::change_row(const Choice& choice) {
    const unsigned bank = choice.bank;
    Bank& state = banks_[bank];
    auto* entry = choice.slot == Lpddr5Queue::kNone ? nullptr : &queue()[choice.slot];
    switch (choice.command) {
    case Command::Act1:
        state = {BankState::Activating, entry->access.row};
        activating_ |= 1U << bank;
        if (open_banks_++ == 0) {
            open_since_ = choice.date;
        }
        if (entry->outcome == Lpddr5RowState::Hit) {
            entry->outcome = Lpddr5RowState::Closed;
        }
        break;
    case Command::Act2:
        state.state = BankState::Open;
        activating_ &= ~(1U << bank);
        break;
    case Command::Pre:
        close(bank);
        if (entry != nullptr) {
            entry->outcome = Lpddr5RowState::Conflict;
        }
        break;
    case Command::PreAb:
        for (unsigned each = 0; each < kLpddr5Banks; ++each) {
            close(each);
        }
        break;
    default:
        refresh_due_ += refresh_period();
        refreshing_ = false;
        refresh_bank_ = (refresh_bank_ + 1) % kLpddr5RefreshSteps;
    }
}

void Lpddr5Channel::column(Lpddr5Outcome& outcome) {
    const unsigned bank = choice_.bank;
    Lpddr5Queue& from = queue();
    Lpddr5Queue::Entry& entry = from[choice_.slot];
    Command command = writing_ ? Command::Wr : Command::Rd;
    const bool first = entry.left == entry.access.bursts;
    const Lpddr5RowState found = first ? entry.outcome : Lpddr5RowState::Hit;
    ++stats_.bursts[static_cast<std::size_t>(found)];
    entry.left &= static_cast<std::uint8_t>(entry.left - 1);
    const bool last = entry.left == 0;
    if (last) {
        ++stats_.accesses[static_cast<std::size_t>(entry.outcome)];
        if (!writing_) {
            outcome.answers.push_back({entry.access.id, choice_.date + timing_->read_latency()});
        } else if (!config_.posted_writes) {
            outcome.answers.push_back({entry.access.id, choice_.date + timing_->write_latency()});
        }
        if (writing_) {
            --writes_of_hash_[hash(entry.access)];
        }
        from.remove(choice_.slot);
        if (auto_precharge_ && from.oldest_of_row(bank, banks_[bank].row) == Lpddr5Queue::kNone) {
            command = writing_ ? Command::WrA : Command::RdA;
            close(bank);
        }
    }
    issue(command, bank, banks_[bank].row);
    find_candidate(bank);
    if (last) {
        choose_direction();
    }
}

void Lpddr5Channel::close(unsigned bank) {
    Bank& state = banks_[bank];
    if (state.state != BankState::Closed) {
        state.state = BankState::Closed;
        if (--open_banks_ == 0) {
            stats_.open += clock_ - open_since_;
        }
    }
}

void Lpddr5Channel::issue(Command command, unsigned bank, unsigned row) {
    dates_.issue(command, bank, clock_);
    ++stats_.commands[static_cast<std::size_t>(command)];
    if (observer_) {
        observer_({command, clock_, bank, row});
    }
}

} // namespace degs
