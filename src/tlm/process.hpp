// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "degs/options.hpp"
#include "tlm/clock_domain.hpp"
#include "tlm/completion.hpp"
#include "tlm/timeline.hpp"

namespace degs {

class FifoBase;

/// The body of a process that needs no thread, because its actions follow from its input ring alone
/// and it stops where an output ring is full. In exact mode it runs inside the process that feeds
/// it or makes room for it, which costs a call instead of two context switches of the kernel; dates
/// are the same. Like a thread it takes its next item before it knows whether the result fits, and
/// holds it: somebody else may need the freed cell at that date.
class Pumped {
public:
    virtual ~Pumped() = default;
    /// Handles items of the input ring until it is empty or an output ring is full.
    virtual void pump() = 0;
    /// For a body that works only when somebody asks for what it writes, see Process::pump_asked():
    /// it goes on as far as it can. Returns the next date at which it may write something; kNever
    /// if that depends on items that are not there yet.
    virtual Cycle ask() { return kNever; }
};

/// The clock and the fidelity that all blocks of one clock domain share.
struct Timebase {
    ClockDomain clock{1.0};
    Fidelity fidelity = Fidelity::Exact;
    Timeline* timeline = nullptr; ///< which processes and rings join; null: there is none
    /// Counts how often the kernel resumed a process of a block or a memory; null: nobody counts.
    std::uint64_t* activations = nullptr;
};

/// `counter`: Timebase::activations.
inline void count_activation(std::uint64_t* counter) {
    if (counter != nullptr) {
        ++*counter;
    }
}

/// The local clock of one SC_THREAD, and how it sleeps and is woken.
///
/// Rules: local() never falls and is never behind the kernel by a cycle or more; a process sleeps
/// only up to its own date, or because it needs somebody else's item or free cell.
class Process {
public:
    explicit Process(const Timebase& time)
        : clock_(&time.clock), strict_(time.fidelity == Fidelity::Strict),
          track_(time.timeline == nullptr ? nullptr : &time.timeline->join(*this)),
          step_end_(track_ == nullptr ? kNever : 0), stop_(next_stop()),
          activations_(time.activations) {
        wake_or_timeout_ |= wake_;
        wake_or_timeout_ |= timeout_;
        if (clock_->mapping() != nullptr) {
            clock_->mapping()->join(*this);
        }
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() = default;

    Cycle local() const { return local_; }
    const ClockDomain& clock() const { return *clock_; }
    bool strict() const { return strict_; }

    void advance(Cycle cycles = 1) { advance_to(local_ + cycles); }
    /// Moves the local date forward; earlier dates are ignored.
    void advance_to(Cycle date) {
        const Cycle before = local_;
        local_ = std::max(local_, date);
        if (local_ > stop_) {
            pass_stop(before, nullptr);
        }
    }
    /// Moves the local date forward, and `counter` counts the cycles, for the timeline with their
    /// dates.
    void advance_to(Cycle date, Cycle& counter) {
        const Cycle before = local_;
        local_ = std::max(local_, date);
        if (local_ > stop_) {
            pass_stop(before, &counter);
        }
        counter += local_ - before;
    }
    void work(Cycle cycles, Cycle& busy) { advance_to(local_ + cycles, busy); }
    /// Waits for an answer of the memory; `counter` counts the cycles.
    void wait_for_memory(const Completion& answer) { wait_for_memory(answer, memory_cycles_); }
    void wait_for_memory(const Completion& answer, Cycle& counter) {
        if (!answer.known()) {
            sleep_until_known(answer);
        }
        advance_to(answer.date(), counter);
    }
    /// Shows this process in the timeline, if there is one, as `part` of `block` or as the whole
    /// block; `busy` counts the cycles in which its `units` units worked.
    void show(const sc_core::sc_object& block, const Cycle& busy, int units = 1,
              const char* part = "");
    /// Shows a process that does not work, but forwards, or has no count of it.
    void show(const sc_core::sc_object& block, const char* part = "", int units = 1);
    /// The track of this process; nullptr without a timeline.
    ProcessTrack* track() const { return track_; }
    /// Sleeps until kernel time has reached the local date.
    void sync();
    /// Tells that no more items will ever come from this process.
    void finish();

    // For ClockMapping.
    bool sleeps_to_date() const { return to_date_; }
    /// Lets the process sleep to its date anew, because that lies at another kernel time now.
    void sleep_anew() {
        if (to_date_) {
            wake_.notify(sc_core::SC_ZERO_TIME);
        }
    }

    /// The first date >= `from` at which one of `inputs` has an item, but no later than `limit`.
    /// The answer is certain: nothing dated up to it can still arrive. Does not move the local
    /// date. kNever if all inputs are closed and no limit is given. `from` and `limit` >= local().
    Cycle next_arrival(FifoBase* const* inputs, std::size_t count, Cycle from, Cycle limit);
    /// True if `input` has an item dated up to now. The answer is certain.
    inline bool arrived(FifoBase& input);

    /// True if `output`, which is full as far as the host has come, has a free cell at the local
    /// date. The answer is certain. See DatedFifo::has_room().
    bool gains_room(FifoBase& output);

    /// A lower bound of the date at which this process can act again, derived from up to `depth`
    /// blocked predecessors. It never falls, but is too high while a Pumped body has taken an item
    /// and not yet written what follows from it. If it does not lie beyond `wanted`, it need not be
    /// the highest that could be derived.
    Cycle bound(int depth, Cycle wanted = 0) const {
        ++questions_;
        return bound_again(depth, wanted);
    }
    /// bound(), or an earlier answer of it if that lies beyond `wanted`, too: many ask about the
    /// same process.
    Cycle bound_beyond(Cycle wanted, int depth) const {
        return proven_bound_ > wanted ? proven_bound_ : bound(depth, wanted);
    }

    // For FifoBase: blocking on one ring, and the wake-up of whoever is blocked.
    void block_on_item(FifoBase& fifo);
    void block_on_room(FifoBase& fifo);
    bool blocked() const { return input_count_ != 0 || room_ != nullptr || asking_; }
    /// Runs `body` in place of a thread whenever `input` has an item.
    void pump_with(Pumped& body, FifoBase& input) {
        body_ = &body;
        inputs_.front() = &input;
        input_count_ = 1;
    }
    /// Runs `body`, which reads `inputs`, when somebody asks for what it writes. At other times it
    /// rests, and others see a process that waits for these inputs.
    void pump_asked(Pumped& body, std::vector<FifoBase*> inputs) {
        body_ = &body;
        works_asked_ = true;
        inputs_ = std::move(inputs);
    }
    /// Tells that this process reads what an asked body writes.
    void ask_writers() { asks_ = true; }
    /// The asked body works, so that nothing is known of it but its date.
    void go() { input_count_ = 0; }
    void rest() { input_count_ = inputs_.size(); }
    /// Tells those who wait for a proof what this process proves. A thread does so before it
    /// sleeps, an asked body when it rests, others without a thread when their dates pass.
    void tell() {
        if (!alarms_.empty()) {
            ring_alarms();
        }
    }
    /// Wakes the thread of this process, which waits in next_arrival() or sleep_to_date(), when
    /// kernel time has passed `date`, at the latest.
    void wake_at(Cycle date);
    /// For the thread of an asked body: waits for wake_at().
    void sleep_to_date();
    /// The date at which this process, which waits in next_arrival() or begins to, acts if nothing
    /// comes that is not in its rings yet.
    Cycle next_action() const;
    /// Changes whenever the kernel has resumed a process, if anybody counts; else 0.
    std::uint64_t activation() const { return activations_ == nullptr ? 0 : *activations_; }
    /// True if kernel time says that everything dated up to `date` has happened.
    bool certain(Cycle date) const { return clock_->past_half(date, sc_core::sc_time_stamp()); }
    /// True if nothing that is not in `input` yet can be read at `date` or before. For threads and
    /// asked bodies.
    bool quiet_beyond(FifoBase& input, Cycle date) const { return quiet_until(input, date) > date; }
    /// True if `output`, which is full as far as the host has come, is full at `date`.
    static bool full_beyond(const FifoBase& output, Cycle date);
    /// A thread-less body holds a result because `room` is full; nullptr: it holds none.
    void hold_for(FifoBase* room) { room_ = room; }
    /// Wakes the process in the next delta cycle, not at the date of the item that it waits for:
    /// dates are in the rings, and kernel time only has to pass where somebody sleeps for it.
    /// Inlined everywhere, so that each caller's jump into a thread-less body has one target, which
    /// the host then foresees.
    __attribute__((always_inline)) void wake() {
        if (body_ != nullptr) {
            body_->pump();
        } else {
            wake_.notify(sc_core::SC_ZERO_TIME);
        }
    }
    /// Wakes `fifo`'s reader as soon as this process can prove that it will write nothing readable
    /// at or before `date`, see tell(). Before that it proves more and more, and whoever wants to
    /// know cannot run.
    void set_alarm(FifoBase& fifo, Cycle date);
    /// Wakes `fifo`'s writer as soon as this process, its reader, can prove that it will free no
    /// cell at or before `date`.
    void set_room_alarm(FifoBase& fifo, Cycle date);

private:
    Cycle blocked_bound(int depth, Cycle wanted) const;
    Cycle bound_by_room(int depth, Cycle wanted) const;
    Cycle bound_by_inputs(int depth, Cycle wanted) const;
    /// bound(), within the question that is being answered.
    Cycle bound_again(int depth, Cycle wanted) const {
        return depth == 0 || asking_ || !blocked() ? local_ : blocked_bound(depth, wanted);
    }
    bool arrived_after_asking(FifoBase& input);
    Cycle quiet_until(FifoBase& input, Cycle date) const;
    Cycle catch_up_writers(FifoBase* const* inputs, std::size_t count, Cycle from, Cycle limit);
    void look_at(FifoBase* const* inputs, std::size_t count, Cycle from, Cycle limit);
    static void pass_writers(FifoBase* const* inputs, std::size_t count, Cycle date);
    /// Date beyond which advance_to() has more to do: strict processes sleep to each date, and
    /// those without a thread never sleep.
    Cycle next_stop() const {
        return strict_ ? 0 : std::min(step_end_, body_ == nullptr ? kNever : first_alarm_);
    }
    void sleep();
    void sleep_until_known(const Completion& answer);
    /// Sleeps until woken, at the longest until kernel time `date` or wake_at(). May return without
    /// any of them.
    void doze_until(const sc_core::sc_time& date);
    /// The work of advance_to() beyond stop_; `counter` will count the time since `before`.
    void pass_stop(Cycle before, const Cycle* counter);
    void ring_alarms();

    const ClockDomain* clock_;
    bool strict_;
    Cycle local_ = 0;
    ProcessTrack* track_;
    Cycle step_end_;             // last date of the timeline's present step; kNever without one
    Cycle stop_;                 // see next_stop()
    std::uint64_t* activations_; // of all threads together, see Timebase
    Cycle memory_cycles_ = 0;    // waited for the memory
    Pumped* body_ = nullptr;
    bool works_asked_ = false; // body_, see pump_asked()
    bool asks_ = false;        // somebody else's
    bool to_date_ = false;     // asleep until kernel time has reached a date
    sc_core::sc_event wake_;
    sc_core::sc_event timeout_; // stays announced when the process is woken, see doze_until()
    sc_core::sc_event_or_list wake_or_timeout_;
    // The ring on which the process is blocked, for bound().
    std::vector<FifoBase*> inputs_{1, nullptr}; // the first input_count_ count
    std::size_t input_count_ = 0;
    std::size_t asked_count_ = 0;     // of them, while asked bodies go on
    Cycle from_ = 0, limit_ = kNever; // see next_arrival()
    FifoBase* room_ = nullptr;
    bool asking_ = false;    // blocked in gains_room(): may act again at its own date
    Cycle proven_bound_ = 0; // of bound(), see quiet_until()
    // A question about a bound looks at each process once: of all processes together, the last one
    // that looked at this process, and what it found, which is local_ as long as it goes on.
    static inline std::uint64_t questions_ = 0;
    mutable std::uint64_t question_ = 0;
    mutable Cycle found_ = 0;
    // Others that want to know as soon as this process proves something.
    struct Alarm {
        FifoBase* fifo = nullptr;
        Cycle date = 0;         ///< wanted: proof that nothing dated <= this is still to come
        bool room = false;      ///< the writer asks for a free cell, else the reader for an item
        Cycle own_date() const; ///< the local date from which the proof may exist
        /// True if the proof exists where this process cannot act before `bound`.
        bool proven(Cycle bound) const;
        Process& asker() const;
        std::size_t& place() const; ///< where the ring keeps that of its alarm in alarms_
    };
    void set_alarm(const Alarm& alarm);
    Cycle first_alarm_ = kNever; // the earliest own_date() of them
    std::vector<Alarm> alarms_;
};

/// The part of a ring that does not depend on its item type; see DatedFifo.
class FifoBase {
public:
    /// Depth of a FIFO that never pushes back: messages and tokens travel on wires, and whoever
    /// gets them has a register for what they say.
    static constexpr std::size_t kWire = ~std::size_t{0};
    FifoBase(Cycle forward_latency, Cycle release_latency)
        : forward_latency_(forward_latency), release_latency_(release_latency) {}
    virtual ~FifoBase() = default;

    bool empty() const { return filled_ == 0; }
    /// Date from which the oldest item may be read. Only if not empty.
    Cycle head_date() const { return *head_; }
    bool full() const { return filled_ == room_; }
    /// Date from which the next cell may be written. Only if not full.
    Cycle free_date() const { return *free_; }
    /// Names the process that writes before it first does, so that a reader can ask for its date.
    void connect_writer(Process& writer) { writer_ = &writer; }
    void connect_reader(Process& reader) { reader_ = &reader; }
    Process* writer() const { return writer_; }
    /// Proven by Process::arrived(): no item can be read before this date.
    Cycle quiet_until() const { return quiet_until_; }
    Process* reader() const { return reader_; }
    Cycle forward_latency() const { return forward_latency_; }
    Cycle release_latency() const { return release_latency_; }
    /// First date at which an item that is not in the ring yet could be read.
    Cycle horizon(int depth) const {
        return writer_ == nullptr ? 0 : horizon_after(writer_->bound(depth));
    }
    /// horizon(), or less if that lies beyond `date`, too; if horizon() does not, anything less.
    Cycle horizon_beyond(Cycle date, int depth) const {
        return writer_ == nullptr ? 0 : horizon_after(writer_->bound_beyond(written(date), depth));
    }
    /// Last date at which something is written that can be read at `date`; 0 if there is none.
    Cycle written(Cycle date) const {
        return date > forward_latency_ ? date - forward_latency_ : 0;
    }
    /// Last date at which something is read whose cell is free at `date`; 0 if there is none.
    Cycle released(Cycle date) const {
        return date > release_latency_ ? date - release_latency_ : 0;
    }
    /// horizon() where the writer cannot act before `bound`.
    Cycle horizon_after(Cycle bound) const {
        return std::min(bound + forward_latency_, late_from_);
    }
    /// True if no cell can be free at `date`, of a FIFO that is full as far as the host has come.
    bool full_beyond(Cycle date, int depth) const {
        return reader_ != nullptr &&
               reader_->bound(depth, released(date)) + release_latency_ > date;
    }
    std::size_t depth() const { return depth_; }
    virtual const char* fifo_name() const = 0;
    /// Says that results list the cells as a buffer, or that the costs of a unit include them.
    void set_billed() { billed_ = true; }
    /// True for wires and for one or two cells as well, which are registers between two units.
    bool is_billed() const { return billed_ || depth_ == kWire || depth_ <= 2; }

    // For a timeline.
    /// Items read so far, the cycles that they were inside, and the cycles that the sides waited.
    struct Use {
        std::uint64_t items;
        Cycle occupied_cycles;
        const Cycle* full_cycles;
        const Cycle* empty_cycles;
    };
    virtual Use use() const = 0;
    /// Cycles up to `date` for which items were inside that were written before and are not among
    /// the first `items`. Writer and reader must have passed the date, and none of these items may
    /// have been read before it.
    virtual Cycle residence(std::uint64_t items, Cycle date) const = 0;

protected:
    friend class Process;
    Cycle quiet_until_ = 0; // proven: no item can be read before this date
    Cycle forward_latency_;
    Cycle release_latency_;
    std::size_t filled_ = 0;
    std::size_t depth_ = 0;
    bool billed_ = false;
    std::size_t room_ = 0; // depth without the cells of items whose memory has not answered yet
    Cycle late_from_ = ~Cycle{0}; // no such item can be read before this date
    const Cycle* head_ = nullptr;
    const Cycle* free_ = nullptr;
    Process* writer_ = nullptr;
    Process* reader_ = nullptr;
    // Places of the alarms of the reader and of the writer in the lists of the other side.
    static constexpr std::size_t kNoAlarm = ~std::size_t{0};
    std::size_t item_alarm_ = kNoAlarm, room_alarm_ = kNoAlarm;
};

inline bool Process::arrived(FifoBase& input) {
    if (local_ < input.quiet_until_) { // never in strict mode
        return false;
    }
    if (!strict_) {
        const Cycle next = input.empty() ? input.horizon_beyond(local_, 1) : input.head_date();
        if (next > local_) {
            input.quiet_until_ = next;
            return false;
        }
        if (!input.empty()) {
            return true;
        }
    }
    return arrived_after_asking(input);
}

} // namespace degs
