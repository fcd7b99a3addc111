// SPDX-License-Identifier: Apache-2.0
// When the time of a run goes where: sums over steps of equal length. Processes run ahead of the
// kernel on their own dates, so nothing is sampled in kernel time: whoever knows a duration has its
// dates, and counters are read when a process passes the end of a step on its own date.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tlm/clock_domain.hpp"

namespace degs {

class FifoBase;
class Process;
class Timeline;

/// What a process did in each step, in cycles; what is missing of units x step, it was idle.
struct TimelineState {
    enum class Kind { Busy, Waits, Blocked, Memory, Other };
    std::string name; ///< "busy", "waits for slicing_0", "blocked by bank_3", ...
    Kind kind = Kind::Other;
    std::vector<std::uint64_t> cycles; ///< by step
};

/// A process of a block.
struct TimelineTrack {
    std::string name; ///< of the block, with the part if a block has several processes
    int units = 1;    ///< that work side by side
    std::vector<TimelineState> states;
};

/// How many cells of a ring were full: the integral over each step.
struct TimelineRing {
    std::string name;
    std::size_t depth = 0;                  ///< cells
    std::vector<std::uint64_t> cell_cycles; ///< by step
};

/// Something that was counted by date.
struct TimelineCounter {
    std::string group, name;
    std::vector<std::uint64_t> sums; ///< by step
};

/// The timeline of a finished run. Lists by step may be short: the rest are zeros.
struct TimelineRecord {
    Cycle step = 0; ///< cycles; 0: there is none
    Cycle end = 0;  ///< of the run
    std::vector<TimelineTrack> tracks;
    std::vector<TimelineRing> rings; ///< without those that never push back
    std::vector<TimelineCounter> counters;

    std::size_t steps() const { return step == 0 ? 0 : (end + step - 1) / step; }
};

/// Amounts by date.
class TimeSeries {
public:
    explicit TimeSeries(Timeline& timeline) : timeline_(&timeline) {}
    void add(Cycle date, std::uint64_t amount) {
        if (date - begin_ >= length_) {
            open_step(date);
        }
        sums_[index_] += amount;
    }
    /// Spreads `amount` evenly over the cycles [from, to); at `from` if there are none.
    void add(Cycle from, Cycle to, std::uint64_t amount);
    const std::vector<std::uint64_t>& sums() const { return sums_; }

private:
    friend class Timeline;
    void open_step(Cycle date);
    void coarsen();

    Timeline* timeline_;
    std::vector<std::uint64_t> sums_;
    std::size_t index_ = 0; // of the step added to last, which is [begin_, begin_ + length_)
    Cycle begin_ = 0, length_ = 0;
};

/// The counters of one process at the end of each step.
class ProcessTrack {
public:
    ProcessTrack(Timeline& timeline, Process& process) : timeline_(&timeline), process_(&process) {}
    void name(std::string block, const std::string& part, int units);
    /// Follows a counter of cycles that Process::wait_until() or an equal raises.
    void follow(TimelineState::Kind kind, const Cycle& counter, const FifoBase* ring = nullptr);
    /// A state whose dates the caller knows, in cycles of the units; "busy" if they work.
    TimeSeries& state(const std::string& name);
    /// The process goes from `before` to `after`; the time between will be counted by `counter`, if
    /// it is not null. Returns the last date that is still of the step that `after` lies in.
    Cycle pass(Cycle before, Cycle after, const Cycle* counter);

private:
    friend class Timeline;
    struct Counter {
        TimelineState::Kind kind;
        const Cycle* value;
        const FifoBase* ring;
        std::vector<Cycle> at_end; // of each step that has been passed
    };
    void coarsen();
    TimelineTrack record(std::size_t steps) const;

    Timeline* timeline_;
    Process* process_;
    std::string block_, part_, name_;
    int units_ = 1;
    std::size_t passed_ = 0; // ends of steps
    std::vector<Counter> counters_;
    std::vector<std::size_t> reads_, writes_; // rings of the timeline
    std::vector<std::pair<std::string, TimeSeries*>> states_;
};

/// Collects the timeline of one clock domain. Processes and rings that are built with a Timebase
/// that names it join by themselves; it must outlive them.
class Timeline {
public:
    struct Config {
        Cycle step = 64; ///< cycles; doubled whenever there would be more than most_steps
        std::size_t most_steps = 2000;
    };
    explicit Timeline(const Config& config) : step_(config.step), most_steps_(config.most_steps) {}
    Timeline(const Timeline&) = delete;
    Timeline& operator=(const Timeline&) = delete;

    Cycle step() const { return step_; }
    /// The series of this name, which the first call makes.
    TimeSeries& series(const std::string& group, const std::string& name);

    ProcessTrack& join(Process& process);
    void join(FifoBase& ring);
    /// When nothing is left to happen; `end` is that of the run.
    TimelineRecord record(Cycle end);

private:
    friend class TimeSeries;
    friend class ProcessTrack;
    struct Ring {
        struct Mark {
            std::uint64_t items;
            Cycle cell_cycles;
        };
        FifoBase* fifo;
        bool has_reader = false, has_writer = false;
        std::vector<Mark> read;    // items read by the end of each step that the reader has passed
        std::size_t written = 0;   // ends of steps that the writer has passed
        std::vector<Cycle> at_end; // cell cycles, of each step that both have passed
    };
    void fit(Cycle date);
    void attach(ProcessTrack& track);
    void settle(Ring& ring);
    void name_tracks();
    std::string peer(const Process* process, const FifoBase& ring) const;
    TimelineRing record_of(Ring& ring, std::size_t steps);

    Cycle step_;
    std::size_t most_steps_;
    std::deque<TimeSeries> all_series_;
    std::map<std::pair<std::string, std::string>, TimeSeries*> named_;
    std::deque<ProcessTrack> tracks_;
    std::deque<Ring> rings_;
    std::vector<std::size_t> unattached_; // rings without reader or writer so far
};

} // namespace degs
