// SPDX-License-Identifier: Apache-2.0
#include "tlm/process.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace degs {
namespace {

// How far next_arrival() follows blocked predecessors for a proof before it falls back to sleeping.
// From a bank to where tiles come from it is five: Span Unit, Slicing Unit, Splat Fetcher, Tile
// Dispatcher, Sorting Unit.
constexpr int kProofDepth = 5;

} // namespace

void Process::sync() {
    tell();
    if (clock_->mapping() != nullptr) {
        while (clock_->at(local_) > sc_core::sc_time_stamp()) {
            doze_until(clock_->at(local_));
        }
        return;
    }
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    const sc_core::sc_time target = clock_->at(local_);
    if (target > now) {
        sc_core::wait(target - now);
        count_activation(activations_);
    }
}

void Process::show(const sc_core::sc_object& block, const char* part, int units) {
    if (track_ != nullptr) {
        track_->name(block.name(), part, units);
        track_->follow(TimelineState::Kind::Memory, memory_cycles_);
    }
}

void Process::show(const sc_core::sc_object& block, const Cycle& busy, int units,
                   const char* part) {
    show(block, part, units);
    if (track_ != nullptr) {
        track_->follow(TimelineState::Kind::Busy, busy);
    }
}

void Process::finish() {
    local_ = kNever;
    tell();
}

void Process::sleep() {
    sc_core::wait(wake_);
    to_date_ = false; // see wake_at()
    count_activation(activations_);
}

// Others see a process that stays at its date: they wait for the kernel, which the answer cannot be
// behind.
void Process::sleep_until_known(const Completion& answer) {
    answer.when_known([this](Cycle /*date*/) { wake(); });
    tell();
    while (!answer.known()) {
        sleep();
    }
}

// Most sleeps end before their time. So a timeout is not taken back but serves later sleeps, too:
// an event keeps its earliest notification. Entering one in the kernel's timed queue costs far
// more.
void Process::doze_until(const sc_core::sc_time& date) {
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    if (date > now) {
        timeout_.notify(date - now);
        to_date_ = true;
        sleep_to_date();
    }
}

void Process::wake_at(Cycle date) {
    const sc_core::sc_time now = sc_core::sc_time_stamp(), time = clock_->half_after(date);
    timeout_.notify(time > now ? time - now : sc_core::SC_ZERO_TIME);
    to_date_ = true;
}

void Process::sleep_to_date() {
    sc_core::wait(wake_or_timeout_);
    to_date_ = false;
    count_activation(activations_);
}

bool Process::full_beyond(const FifoBase& output, Cycle date) {
    return output.full_beyond(date, kProofDepth);
}

Cycle Process::Alarm::own_date() const {
    return room ? fifo->released(date) : fifo->written(date);
}

bool Process::Alarm::proven(Cycle bound) const {
    return room ? !fifo->full() || bound + fifo->release_latency() > date
                : fifo->horizon_after(bound) > date;
}

std::size_t& Process::Alarm::place() const {
    return room ? fifo->room_alarm_ : fifo->item_alarm_;
}

Process& Process::Alarm::asker() const {
    return room ? *fifo->writer() : *fifo->reader();
}

void Process::set_alarm(FifoBase& fifo, Cycle date) {
    set_alarm(Alarm{&fifo, date, false});
}

void Process::set_room_alarm(FifoBase& fifo, Cycle date) {
    set_alarm(Alarm{&fifo, date, true});
}

void Process::set_alarm(const Alarm& alarm) {
    first_alarm_ = std::min(first_alarm_, alarm.own_date());
    stop_ = next_stop();
    std::size_t& place = alarm.place();
    if (place == FifoBase::kNoAlarm) {
        place = alarms_.size();
        alarms_.push_back(alarm);
    } else {
        alarms_[place].date = alarm.date;
    }
}

void Process::pass_stop(Cycle before, const Cycle* counter) {
    if (local_ > step_end_) {
        step_end_ = track_->pass(before, local_, counter);
    }
    if (body_ != nullptr) {
        tell();
    }
    stop_ = next_stop();
    if (strict_) {
        sync();
    }
}

// Rings only where the proof exists now: two processes that ask each other in vain would otherwise
// wake each other for ever.
void Process::ring_alarms() {
    std::size_t kept = 0;
    const Cycle own = bound(kProofDepth, first_alarm_);
    first_alarm_ = kNever;
    for (std::size_t i = 0; i < alarms_.size(); ++i) {
        const Alarm alarm = alarms_[i];
        if (alarm.proven(own)) {
            alarm.place() = FifoBase::kNoAlarm;
            // Whoever is awake asks again by itself.
            if (Process& asker = alarm.asker(); asker.blocked() || asker.body_ != nullptr) {
                asker.wake();
            }
        } else {
            first_alarm_ = std::min(first_alarm_, alarm.own_date());
            alarm.place() = kept;
            alarms_[kept++] = alarm;
        }
    }
    alarms_.resize(kept);
}

void Process::block_on_item(FifoBase& fifo) {
    if (body_ != nullptr) {
        throw std::logic_error(std::string(fifo.fifo_name()) +
                               ": a process without a thread read an empty ring");
    }
    inputs_.front() = &fifo;
    input_count_ = 1;
    limit_ = kNever;
    tell(); // blocked now: our bound may reach further than our date
    sleep();
    input_count_ = 0;
}

void Process::block_on_room(FifoBase& fifo) {
    if (body_ != nullptr) {
        throw std::logic_error(std::string(fifo.fifo_name()) +
                               ": a process without a thread wrote to a full ring");
    }
    room_ = &fifo;
    tell();
    sleep();
    room_ = nullptr;
}

// Processes that wait for each other in a circle can act at their own dates, as far as the circle
// says; and of many ways to one process the first one counts.
Cycle Process::blocked_bound(int depth, Cycle wanted) const {
    if (question_ != questions_) {
        question_ = questions_;
        found_ = local_;
        found_ = room_ != nullptr ? bound_by_room(depth, wanted) : bound_by_inputs(depth, wanted);
    }
    return found_;
}

Cycle Process::bound_by_room(int depth, Cycle wanted) const {
    if (!room_->full()) {
        return std::max(local_, room_->free_date());
    }
    const Process* const reader = room_->reader();
    if (reader == nullptr) {
        return local_;
    }
    const Cycle read = reader->bound_again(depth - 1, room_->released(wanted));
    return std::max(local_, read + room_->release_latency());
}

// One input that may have an item at `wanted` is enough to stop, and says nothing of the others.
Cycle Process::bound_by_inputs(int depth, Cycle wanted) const {
    const Cycle least = std::max(local_, wanted);
    Cycle earliest = limit_;
    const Process* writer = nullptr; // rings of one often lie beside each other
    Cycle bound = 0;
    for (std::size_t i = 0; i < input_count_ && earliest > least; ++i) {
        const FifoBase& fifo = *inputs_[i];
        if (!fifo.empty()) {
            earliest = std::min(earliest, fifo.head_date());
            continue;
        }
        if (fifo.writer() != writer) {
            writer = fifo.writer();
            bound = writer == nullptr ? 0 : writer->bound_again(depth - 1, fifo.written(wanted));
        }
        earliest = std::min(earliest, writer == nullptr ? 0 : fifo.horizon_after(bound));
    }
    return earliest > least ? earliest : local_;
}

// Reads of cycle t may be decided as late as half a cycle after t, so they are certain at t + 1.
bool Process::gains_room(FifoBase& output) {
    const Cycle release = output.release_latency();
    const Cycle after = local_ < release ? 0 : local_ - release + 1;
    while (output.full()) {
        const sc_core::sc_time certain = clock_->at(after);
        if (strict_ || output.full_beyond(local_, kProofDepth) ||
            sc_core::sc_time_stamp() >= certain) {
            return false;
        }
        output.reader()->set_room_alarm(output, local_);
        asking_ = true;
        tell();
        doze_until(certain);
        asking_ = false;
    }
    return output.free_date() <= local_;
}

bool Process::arrived_after_asking(FifoBase& input) {
    FifoBase* const inputs[] = {&input};
    next_arrival(inputs, 1, local_, local_);
    return !input.empty() && input.head_date() <= local_;
}

// The first date at which an item could be read that is not in the empty ring yet. Proofs are kept:
// asks for a new one only if the last does not reach beyond `date`. Only threads ask here. While a
// body works, its input may be empty although it has still to write what it has taken, so that
// others seem to wait for each other: what is found then, for alarms, is not kept.
Cycle Process::quiet_until(FifoBase& input, Cycle date) const {
    if (strict_) {
        return input.horizon(kProofDepth);
    }
    Process* const writer = input.writer();
    if (input.quiet_until_ <= date && writer != nullptr) {
        const Cycle bound = writer->bound_beyond(input.written(date), kProofDepth);
        writer->proven_bound_ = std::max(writer->proven_bound_, bound);
        input.quiet_until_ = std::max(input.quiet_until_, input.horizon_after(bound));
    }
    return input.quiet_until_;
}

// What this process waits for, or is about to.
void Process::look_at(FifoBase* const* inputs, std::size_t count, Cycle from, Cycle limit) {
    inputs_.resize(std::max(inputs_.size(), count));
    std::copy_n(inputs, count, inputs_.begin());
    from_ = from;
    limit_ = limit;
}

Cycle Process::next_action() const {
    const std::size_t count = std::max(input_count_, asked_count_);
    if (count == 0) {
        return local_;
    }
    Cycle date = limit_;
    for (std::size_t i = 0; i < count; ++i) {
        if (!inputs_[i]->empty()) {
            date = std::min(date, std::max(inputs_[i]->head_date(), from_));
        }
    }
    return date;
}

// Asked bodies that write to `inputs` go on. Returns the next date at which something may become
// readable because of what they have in hand.
Cycle Process::catch_up_writers(FifoBase* const* inputs, std::size_t count, Cycle from,
                                Cycle limit) {
    Cycle date = kNever;
    const Process* last = nullptr; // rings of one often lie beside each other
    for (std::size_t i = 0; i < count; ++i) {
        Process* const writer = inputs[i]->writer();
        if (writer != nullptr && writer->works_asked_ && writer != last && inputs[i]->empty()) {
            if (last == nullptr) {
                look_at(inputs, count, from, limit);
                asked_count_ = count;
            }
            date = std::min(date, writer->body_->ask() + inputs[i]->forward_latency());
            last = writer;
        }
    }
    asked_count_ = 0;
    return date;
}

// Asked bodies that write to empty `inputs` have done all that is dated up to `date`.
void Process::pass_writers(FifoBase* const* inputs, std::size_t count, Cycle date) {
    for (std::size_t i = 0; i < count; ++i) {
        Process* const writer = inputs[i]->writer();
        if (writer != nullptr && writer->works_asked_ && inputs[i]->empty()) {
            writer->advance_to(date + 1);
        }
    }
}

Cycle Process::next_arrival(FifoBase* const* inputs, std::size_t count, Cycle from, Cycle limit) {
    for (;;) {
        const Cycle due = asks_ ? catch_up_writers(inputs, count, from, limit) : kNever;
        Cycle known = limit;
        for (std::size_t i = 0; i < count; ++i) {
            if (!inputs[i]->empty()) {
                known = std::min(known, std::max(inputs[i]->head_date(), from));
            }
        }
        if (strict_ && known != kNever) {
            if (certain(known)) {
                return known;
            }
        } else {
            // An item that is not visible yet comes later than a proof says.
            std::size_t i = 0;
            while (i < count && (!inputs[i]->empty() || quiet_until(*inputs[i], known) > known)) {
                ++i;
            }
            if (i == count) {
                return known;
            }
            if (known != kNever && certain(known)) {
                if (asks_) {
                    pass_writers(inputs, count, known);
                }
                return known;
            }
            if (inputs[i]->writer() != nullptr) {
                inputs[i]->writer()->set_alarm(*inputs[i], known);
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            inputs[i]->connect_reader(*this);
        }
        look_at(inputs, count, from, limit);
        input_count_ = count;
        tell();
        if (const Cycle date = std::min(known, due); date == kNever) {
            sleep_to_date();
        } else {
            doze_until(clock_->half_after(date));
        }
        input_count_ = 0;
    }
}

} // namespace degs
