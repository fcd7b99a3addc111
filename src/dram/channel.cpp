// SPDX-License-Identifier: Apache-2.0
#include "dram/channel.hpp"

#include <algorithm>

namespace degs::dram {
namespace {

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
    change(stats.forwarded_bursts, other.forwarded_bursts);
    change(stats.merged_bursts, other.merged_bursts);
    change(stats.drains, other.drains);
    change(stats.open, other.open);
}

void describe_rows(const ByRowState& counts, StatsVisitor& v, const char* unit) {
    v.count("hits", counts[0], unit, "The row was open.");
    v.count("closed", counts[1], unit, "The bank was closed, and had to be activated.");
    v.count("conflicts", counts[2], unit, "Another row was open, and had to be closed first.");
}

} // namespace

void Channel::Stats::describe(StatsVisitor& v) const {
    v.real("row_hit_rate", hit_rate(bursts), "share", "bursts.hits / all bursts.");
    v.real("access_hit_rate", hit_rate(accesses), "share", "accesses.hits / all accesses.");
    v.begin_section("bursts", "Bursts by the state in which they found their bank.");
    describe_rows(bursts, v, "bursts");
    v.end_section();
    v.begin_section("accesses", "Accesses of up to 64 B by the state in which their first burst "
                                "found its bank.");
    describe_rows(accesses, v, "accesses");
    v.end_section();
    v.count("forwarded", forwarded, "accesses", "Reads answered from a queued write.");
    v.count("merged", merged, "accesses", "Writes that a queued write of the same place took in.");
    v.count("write_batches", drains, "batches", "Turns from reads to writes.");
    v.begin_section("commands", "Commands on the bus, by kind.");
    for (std::size_t c = 0; c < kCommands; ++c) {
        const auto command = static_cast<Command>(c);
        v.count(command_name(command), commands[c], "commands", command_sentence(command));
    }
    v.end_section();
}

std::uint64_t Channel::Stats::column_commands() const {
    std::uint64_t sum = 0;
    for (const Command command : {Command::Rd, Command::RdA, Command::Wr, Command::WrA}) {
        sum += of_kind(commands, command);
    }
    return sum;
}

void Channel::Stats::add(const Stats& other) {
    each_counter(*this, other, [](std::uint64_t& mine, std::uint64_t its) { mine += its; });
}

void Channel::Stats::subtract(const Stats& earlier) {
    each_counter(*this, earlier, [](std::uint64_t& mine, std::uint64_t its) { mine -= its; });
}

Channel::Channel(const Timing& timing, const RuleTable& rules, const ControllerConfig& config,
                 Ck phase)
    : timing_(&timing), rules_(&rules),
      bus_ck_(timing.command_buses == 1 ? static_cast<Ck>(timing.command_ck) : 0),
      posted_writes_(config.posted_writes),
      auto_precharge_(page_policies()[config.page_policy].auto_precharge),
      read_latency_(timing.read_latency()), state_{0, Banks(rules), Queues(config),
                                                   Refresher(timing, config, phase)},
      chooser_(config.policies[config.scheduler]) {}

void Channel::run(Ck until, Outcome& outcome) {
    for (;;) {
        const Ck command = choice().date;
        const Ck admission = next_admission();
        if (std::min(admission, command) > until) {
            return;
        }
        proceed(command, admission, outcome);
    }
}

Ck Channel::step(Outcome& outcome) {
    const Ck command = choice().date;
    const Ck admission = next_admission();
    proceed(command, admission, outcome);
    return std::min(command, admission);
}

// An access may send its first command in the CK in which it comes.
inline void Channel::proceed(Ck command, Ck admission, Outcome& outcome) {
    if (admission <= command) {
        admit(admission, outcome);
    } else {
        perform(outcome);
    }
}

void Channel::admit(Ck date, Outcome& outcome) {
    state_.clock = date;
    while (state_.queues.write_ready(date)) {
        const Access access = state_.queues.take_write();
        outcome.admitted.push_back(access.id);
        if (posted_writes_) {
            outcome.answer(access.id, date + 1);
        }
        const std::uint8_t same =
            posted_writes_ ? state_.queues.write_to_merge(access) : Queue::kNone;
        if (same != Queue::kNone) {
            ++stats_.merged;
            stats_.merged_bursts += state_.queues.merge(same, access);
            continue;
        }
        state_.queues.enqueue_write(access);
        if (state_.queues.writing()) {
            chooser_.add(access.bank, state_);
        }
    }
    while (state_.queues.read_ready(date)) {
        const Access access = state_.queues.take_read(date);
        outcome.admitted.push_back(access.id);
        if (access.after_write && state_.queues.covered(access)) {
            ++stats_.forwarded;
            stats_.forwarded_bursts += bursts_of(access.bursts);
            outcome.answer(access.id, date + 1);
            continue;
        }
        state_.queues.enqueue_read(access);
        if (!state_.queues.writing()) {
            chooser_.add(access.bank, state_);
        }
    }
    turn();
}

void Channel::begin_direction() {
    stats_.drains += state_.queues.writing() ? 1 : 0;
    chooser_.update_all(state_);
    chooser_.drop();
}

void Channel::perform(Outcome& outcome) {
    // Not a copy, for the reason that Outcome::answer() gives.
    const Chooser::Choice& choice = this->choice();
    chooser_.drop();
    state_.clock = choice.date;
    if (choice.start_refresh) {
        state_.refresher.start();
        return;
    }
    if (is_column(choice.command)) {
        column(choice, outcome);
    } else {
        row_command(choice);
    }
    state_.clock += bus_ck_;
}

void Channel::row_command(const Chooser::Choice& choice) {
    const unsigned bank = choice.bank;
    change_row(choice);
    issue(choice.command, bank);
    if (choice.command == Command::PreAb) {
        chooser_.update_all(state_);
        return;
    }
    chooser_.update(bank, state_);
    if (choice.command == Command::RefPb) {
        chooser_.update(rules_->refresh_partner(bank), state_);
    }
}

void Channel::change_row(const Chooser::Choice& choice) {
    const unsigned bank = choice.bank;
    Policy& policy = chooser_.policy();
    auto* entry = choice.slot == Queue::kNone ? nullptr : &state_.queues.current()[choice.slot];
    switch (choice.command) {
    case Command::Act1:
        state_.banks.activate(bank, entry->access.row, state_.clock);
        policy.opened(bank, entry->access.row);
        if (entry->outcome == RowState::Hit) {
            entry->outcome = RowState::Closed;
        }
        if (!timing_->has_act2()) {
            state_.banks.open(bank);
        }
        break;
    case Command::Act2:
        state_.banks.open(bank);
        break;
    case Command::Pre:
        state_.banks.close(bank, state_.clock);
        policy.closed(bank);
        if (entry != nullptr) {
            entry->outcome = RowState::Conflict;
        }
        break;
    case Command::PreAb:
        state_.banks.close_all(state_.clock);
        for (unsigned each = 0; each < state_.banks.count(); ++each) {
            policy.closed(each);
        }
        break;
    default:
        state_.refresher.finish();
    }
}

void Channel::column(const Chooser::Choice& choice, Outcome& outcome) {
    const unsigned bank = choice.bank;
    Queue::Entry& entry = state_.queues.current()[choice.slot];
    const bool first = entry.left == entry.access.bursts;
    ++of_kind(stats_.bursts, first ? entry.outcome : RowState::Hit);
    entry.left &= entry.left - 1;
    Command command = choice.command;
    const bool last = entry.left == 0;
    if (last) {
        ++of_kind(stats_.accesses, entry.outcome);
        answer(entry.access, outcome);
        chooser_.policy().served(entry);
        state_.queues.remove(choice.slot);
        if (auto_precharge_ &&
            state_.queues.current().oldest_of_row(bank, state_.banks.row(bank)) == Queue::kNone) {
            command = state_.queues.writing() ? Command::WrA : Command::RdA;
            state_.banks.close(bank, state_.clock);
            chooser_.policy().closed(bank);
        }
    }
    issue(command, bank);
    chooser_.update(bank, state_);
    if (last) {
        turn();
    }
}

void Channel::answer(const Access& access, Outcome& outcome) const {
    if (!access.write) {
        outcome.answer(access.id, state_.clock + read_latency_);
    } else if (!posted_writes_) {
        outcome.answer(access.id, state_.clock + timing_->write_latency());
    }
}

void Channel::issue(Command command, unsigned bank) {
    state_.banks.issue(command, bank, state_.clock);
    ++of_kind(stats_.commands, command);
    stats_.open = state_.banks.open_time();
    if (observer_) {
        observer_({command, state_.clock, bank, state_.banks.row(bank)});
    }
}

Ck Channel::admission_bound() {
    if (waiting() == 0) {
        return kNoDate;
    }
    choice();
    return state_.queues.held_up()
               ? std::min(next_admission(), chooser_.column_bound(state_, timing_->rcd))
               : next_admission();
}

} // namespace degs::dram
