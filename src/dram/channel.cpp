// SPDX-License-Identifier: Apache-2.0
#include "dram/channel.hpp"

#include <algorithm>
#include <cmath>

namespace degs::dram {
namespace {

unsigned entries(double share, int depth) {
    return static_cast<unsigned>(std::floor(share * depth + 0.5));
}

/// Applies `change` to every counter of `stats` and its counterpart.
template <class Change>
void each_counter(Channel::Stats& stats, const Channel::Stats& other, const Change& change) {
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

void Channel::Stats::add(const Stats& other) {
    each_counter(*this, other, [](std::uint64_t& mine, std::uint64_t its) { mine += its; });
}

void Channel::Stats::subtract(const Stats& earlier) {
    each_counter(*this, earlier, [](std::uint64_t& mine, std::uint64_t its) { mine -= its; });
}

Channel::Channel(const Timing& timing, const RuleTable& rules, const ControllerConfig& config,
                 Ck phase)
    : timing_(&timing), config_(config), scheduler_(schedulers()[config.scheduler]),
      auto_precharge_(page_policies()[config.page_policy].auto_precharge),
      write_high_(std::max(1U, entries(config.write_high, config.write_queue))),
      write_low_(entries(config.write_low, config.write_queue)), dates_(rules),
      reads_(config.read_queue), writes_(config.write_queue),
      refresh_due_(config.refresh == Refresh::None
                       ? kNoDate
                       : refresh_period() - std::min(phase, refresh_period())) {
    keys_.rest.fill(~0U);
}

Ck Channel::refresh_period() const {
    const Ck all_banks = timing_->refi;
    return config_.refresh == Refresh::PerBank ? all_banks / kRefreshSteps : all_banks;
}

bool Channel::idle() const {
    return reads_.size() == 0 && writes_.size() == 0 && reads_in_.empty() && writes_in_.empty();
}

Ck Channel::open_until(Ck date) const {
    return stats_.open + (open_banks_ != 0 && date > open_since_ ? date - open_since_ : 0);
}

bool Channel::push(Access access) {
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

void Channel::run(Ck until, Outcome& outcome) {
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

Ck Channel::next_date() {
    if (!chosen_) {
        choose();
    }
    return std::min(choice_.date, next_admission());
}

Ck Channel::next_admission() const {
    Ck date = kNoDate;
    if (!reads_in_.empty() && !reads_.full()) {
        date = reads_in_.front().date;
    }
    if (!writes_in_.empty() && !writes_.full()) {
        date = std::min(date, writes_in_.front().date);
    }
    return std::max(date, clock_);
}

void Channel::admit(Ck date, Outcome& outcome) {
    clock_ = date;
    while (!writes_in_.empty() && !writes_.full() && writes_in_.front().date <= date) {
        const Access access = writes_in_.front();
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
        const Access access = reads_in_.front();
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

void Channel::enqueue(Queue& to, const Access& access) {
    to.push(access);
    if (&to == &queue()) {
        find_candidate(access.bank);
        offer_candidate(access.bank);
    }
}

bool Channel::forward(const Access& access) const {
    const std::uint8_t slot = writes_.find(access.bank, access.row, access.block);
    return slot != Queue::kNone && (access.bursts & ~writes_[slot].access.bursts) == 0;
}

bool Channel::merge(const Access& access) {
    const std::uint8_t slot = writes_.find(access.bank, access.row, access.block);
    if (slot == Queue::kNone) {
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
void Channel::choose_direction() {
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

void Channel::perform(Outcome& outcome) {
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

void Channel::row_command(const Choice& choice) {
    const unsigned bank = choice.bank;
    change_row(choice);
    issue(choice.command, bank, banks_[bank].row);
    if (choice.command == Command::PreAb) {
        find_candidates();
    } else {
        find_candidate(bank);
        if (choice.command == Command::RefPb) {
            find_candidate(bank ^ kRefreshPartner);
        }
    }
}

void Channel::change_row(const Choice& choice) {
    const unsigned bank = choice.bank;
    Bank& state = banks_[bank];
    auto* entry = choice.slot == Queue::kNone ? nullptr : &queue()[choice.slot];
    switch (choice.command) {
    case Command::Act1:
        state = {BankState::Activating, entry->access.row};
        activating_ |= 1U << bank;
        if (open_banks_++ == 0) {
            open_since_ = choice.date;
        }
        if (entry->outcome == RowState::Hit) {
            entry->outcome = RowState::Closed;
        }
        break;
    case Command::Act2:
        state.state = BankState::Open;
        activating_ &= ~(1U << bank);
        break;
    case Command::Pre:
        close(bank);
        if (entry != nullptr) {
            entry->outcome = RowState::Conflict;
        }
        break;
    case Command::PreAb:
        for (unsigned each = 0; each < kBanks; ++each) {
            close(each);
        }
        break;
    default:
        refresh_due_ += refresh_period();
        refreshing_ = false;
        refresh_bank_ = (refresh_bank_ + 1) % kRefreshSteps;
    }
}

void Channel::column(Outcome& outcome) {
    const unsigned bank = choice_.bank;
    Queue& from = queue();
    Queue::Entry& entry = from[choice_.slot];
    Command command = writing_ ? Command::Wr : Command::Rd;
    const bool first = entry.left == entry.access.bursts;
    const RowState found = first ? entry.outcome : RowState::Hit;
    ++stats_.bursts[static_cast<std::size_t>(found)];
    entry.left &= entry.left - 1;
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
        if (auto_precharge_ && from.oldest_of_row(bank, banks_[bank].row) == Queue::kNone) {
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

void Channel::close(unsigned bank) {
    Bank& state = banks_[bank];
    if (state.state != BankState::Closed) {
        state.state = BankState::Closed;
        if (--open_banks_ == 0) {
            stats_.open += clock_ - open_since_;
        }
    }
}

void Channel::issue(Command command, unsigned bank, unsigned row) {
    dates_.issue(command, bank, clock_);
    ++stats_.commands[static_cast<std::size_t>(command)];
    if (observer_) {
        observer_({command, clock_, bank, row});
    }
}

} // namespace degs::dram
