// SPDX-License-Identifier: Apache-2.0
#include "tlm/timeline.hpp"

#include <algorithm>

#include "tlm/process.hpp"

namespace degs {
namespace {

/// Keeps what holds at the end of every second step.
template <class Value>
void keep_every_second(std::vector<Value>& at_end) {
    for (std::size_t i = 0; 2 * i + 1 < at_end.size(); ++i) {
        at_end[i] = at_end[2 * i + 1];
    }
    at_end.resize(at_end.size() / 2);
}

/// What a counter gained in each of `steps` steps; by the end of the run it had come to `total`.
std::vector<std::uint64_t> gains(const std::vector<Cycle>& at_end, Cycle total, std::size_t steps) {
    std::vector<std::uint64_t> gained(steps, 0);
    Cycle before = 0;
    for (std::size_t i = 0; i < steps; ++i) {
        const bool known = i < at_end.size() && i + 1 < steps;
        const Cycle now = known ? std::min(at_end[i], total) : total;
        gained[i] = now - before;
        before = now;
    }
    return gained;
}

bool pushes_back(const FifoBase& ring) {
    return ring.depth() != FifoBase::kWire;
}

} // namespace

void TimeSeries::open_step(Cycle date) {
    timeline_->fit(date);
    length_ = timeline_->step();
    index_ = date / length_;
    begin_ = index_ * length_;
    if (index_ >= sums_.size()) {
        sums_.resize(index_ + 1, 0);
    }
}

// Rounded down at the end of each step, so that the parts add up.
void TimeSeries::add(Cycle from, Cycle to, std::uint64_t amount) {
    if (from - begin_ < length_ && to - begin_ <= length_) {
        sums_[index_] += amount;
        return;
    }
    const Cycle cycles = to > from ? to - from : 0;
    timeline_->fit(to);
    std::uint64_t added = 0;
    for (Cycle at = from; at < to;) {
        const Cycle step = timeline_->step();
        const Cycle end = std::min(to, (at / step + 1) * step);
        const std::uint64_t share =
            amount / cycles * (end - from) + amount % cycles * (end - from) / cycles;
        add(at, share - added);
        added = share;
        at = end;
    }
    if (cycles == 0) {
        add(from, amount);
    }
}

void TimeSeries::coarsen() {
    for (std::size_t i = 0; 2 * i < sums_.size(); ++i) {
        const std::uint64_t second = 2 * i + 1 < sums_.size() ? sums_[2 * i + 1] : 0;
        sums_[i] = sums_[2 * i] + second;
    }
    sums_.resize((sums_.size() + 1) / 2);
    length_ = 0; // no step is open
}

void ProcessTrack::name(std::string block, const std::string& part, int units) {
    block_ = std::move(block);
    part_ = part;
    units_ = units;
}

void ProcessTrack::follow(TimelineState::Kind kind, const Cycle& counter, const FifoBase* ring) {
    counters_.push_back({kind, &counter, ring, std::vector<Cycle>(passed_, 0)});
}

TimeSeries& ProcessTrack::state(const std::string& name) {
    timeline_->all_series_.emplace_back(*timeline_);
    states_.emplace_back(name, &timeline_->all_series_.back());
    return *states_.back().second;
}

// The counters hold what happened up to `before`: the process raises them at its own dates.
Cycle ProcessTrack::pass(Cycle before, Cycle after, const Cycle* counter) {
    if (after >= kNever) {
        return kNever;
    }
    timeline_->fit(after);
    timeline_->attach(*this);
    const Cycle step = timeline_->step();
    while ((passed_ + 1) * step <= after) {
        const Cycle end = ++passed_ * step;
        for (Counter& c : counters_) {
            c.at_end.push_back(*c.value + (c.value == counter && end > before ? end - before : 0));
        }
        for (const std::size_t number : reads_) {
            Timeline::Ring& ring = timeline_->rings_[number];
            const FifoBase::Use use = ring.fifo->use();
            ring.read.push_back({use.items, use.occupied_cycles});
            timeline_->settle(ring);
        }
        for (const std::size_t number : writes_) {
            Timeline::Ring& ring = timeline_->rings_[number];
            ++ring.written;
            timeline_->settle(ring);
        }
    }
    return (passed_ + 1) * step - 1;
}

void ProcessTrack::coarsen() {
    passed_ /= 2;
    for (Counter& counter : counters_) {
        keep_every_second(counter.at_end);
    }
}

// States of one name, such as those of several rings between two blocks, are one.
TimelineTrack ProcessTrack::record(std::size_t steps) const {
    TimelineTrack track;
    track.name = name_;
    track.units = units_;
    const auto add = [&](const std::string& name, TimelineState::Kind kind,
                         const std::vector<std::uint64_t>& cycles, std::uint64_t times) {
        auto state = std::find_if(track.states.begin(), track.states.end(),
                                  [&](const TimelineState& s) { return s.name == name; });
        if (state == track.states.end()) {
            state = track.states.insert(state, {name, kind, std::vector<std::uint64_t>(steps, 0)});
        }
        for (std::size_t i = 0; i < std::min(steps, cycles.size()); ++i) {
            state->cycles[i] += cycles[i] * times;
        }
    };
    for (const Counter& counter : counters_) {
        if (*counter.value == 0) {
            continue;
        }
        const std::vector<std::uint64_t> cycles = gains(counter.at_end, *counter.value, steps);
        switch (counter.kind) {
        case TimelineState::Kind::Waits:
            add("waits for " + timeline_->peer(counter.ring->writer(), *counter.ring), counter.kind,
                cycles, units_);
            break;
        case TimelineState::Kind::Blocked:
            add("blocked by " + timeline_->peer(counter.ring->reader(), *counter.ring),
                counter.kind, cycles, units_);
            break;
        case TimelineState::Kind::Memory:
            add("waits for memory", counter.kind, cycles, units_);
            break;
        default:
            add("busy", counter.kind, cycles, 1);
        }
    }
    for (const auto& [name, series] : states_) {
        const bool busy = name == "busy";
        add(name, busy ? TimelineState::Kind::Busy : TimelineState::Kind::Other, series->sums(), 1);
    }
    return track;
}

TimeSeries& Timeline::series(const std::string& group, const std::string& name) {
    TimeSeries*& series = named_[{group, name}];
    if (series == nullptr) {
        all_series_.emplace_back(*this);
        series = &all_series_.back();
    }
    return *series;
}

ProcessTrack& Timeline::join(Process& process) {
    tracks_.emplace_back(*this, process);
    return tracks_.back();
}

void Timeline::join(FifoBase& ring) {
    unattached_.push_back(rings_.size());
    rings_.push_back({&ring, false, false, {}, 0, {}});
}

// Doubles the step until there are few enough of them.
void Timeline::fit(Cycle date) {
    while (date / step_ >= most_steps_) {
        step_ *= 2;
        for (TimeSeries& series : all_series_) {
            series.coarsen();
        }
        for (ProcessTrack& track : tracks_) {
            track.coarsen();
        }
        for (Ring& ring : rings_) {
            keep_every_second(ring.read);
            keep_every_second(ring.at_end);
            ring.written /= 2;
        }
    }
}

// A ring knows its sides from the end of elaboration on, or from the first item: the sides that
// this process then turns out to be have done nothing before.
void Timeline::attach(ProcessTrack& track) {
    const auto complete = [&](std::size_t number) {
        Ring& ring = rings_[number];
        if (!ring.has_reader && ring.fifo->reader() == track.process_) {
            ring.has_reader = true;
            track.follow(TimelineState::Kind::Waits, *ring.fifo->use().empty_cycles, ring.fifo);
            if (pushes_back(*ring.fifo)) {
                ring.read.assign(track.passed_, {0, 0});
                track.reads_.push_back(number);
            }
        }
        if (!ring.has_writer && ring.fifo->writer() == track.process_) {
            ring.has_writer = true;
            track.follow(TimelineState::Kind::Blocked, *ring.fifo->use().full_cycles, ring.fifo);
            if (pushes_back(*ring.fifo)) {
                ring.written = track.passed_;
                track.writes_.push_back(number);
            }
        }
        return ring.has_reader && ring.has_writer;
    };
    unattached_.erase(std::remove_if(unattached_.begin(), unattached_.end(), complete),
                      unattached_.end());
}

// Once both sides have passed the end of a step, all that was written before it is in the ring or
// has been read, and no cell of an item read since has been written anew.
void Timeline::settle(Ring& ring) {
    while (ring.at_end.size() < std::min(ring.read.size(), ring.written)) {
        const Ring::Mark& mark = ring.read[ring.at_end.size()];
        const Cycle end = (ring.at_end.size() + 1) * step_;
        ring.at_end.push_back(mark.cell_cycles + ring.fifo->residence(mark.items, end));
    }
}

// The last part of a name says enough, unless two blocks share it.
void Timeline::name_tracks() {
    const auto last_part = [](const std::string& block) {
        return block.substr(block.rfind('.') + 1); // npos + 1 is 0
    };
    std::map<std::string, int> count;
    for (const ProcessTrack& track : tracks_) {
        count[last_part(track.block_) + track.part_]++;
    }
    for (ProcessTrack& track : tracks_) {
        std::string block = last_part(track.block_);
        const std::size_t dot = track.block_.rfind('.');
        if (count[block + track.part_] > 1 && dot != std::string::npos) {
            block.insert(0, last_part(track.block_.substr(0, dot)).append(" "));
        }
        track.name_ = block + (track.part_.empty() ? "" : " " + track.part_);
    }
}

std::string Timeline::peer(const Process* process, const FifoBase& ring) const {
    for (const ProcessTrack& track : tracks_) {
        if (track.process_ == process && !track.block_.empty()) {
            return track.name_;
        }
    }
    return ring.fifo_name();
}

// A side that has finished passes no more ends of steps.
TimelineRing Timeline::record_of(Ring& ring, std::size_t steps) {
    const FifoBase::Use use = ring.fifo->use();
    const Cycle total = use.occupied_cycles;
    ring.read.resize(std::max(ring.read.size(), steps), {use.items, total});
    ring.written = std::max(ring.written, steps);
    settle(ring);
    // What nobody reads any more is not counted.
    for (Cycle& cycles : ring.at_end) {
        cycles = std::min(cycles, total);
    }
    return {ring.fifo->fifo_name(), ring.fifo->depth(), gains(ring.at_end, total, steps)};
}

TimelineRecord Timeline::record(Cycle end) {
    fit(end == 0 ? 0 : end - 1);
    for (ProcessTrack& track : tracks_) { // rings that were used in the last step only
        attach(track);
    }
    name_tracks();
    TimelineRecord record;
    record.end = end;
    record.step = step_;
    for (const TimeSeries& series : all_series_) {
        if (series.sums().size() > record.steps()) { // the step is not known any closer
            record.end = series.sums().size() * step_;
        }
    }
    const std::size_t steps = record.steps();
    for (const ProcessTrack& track : tracks_) {
        if (!track.block_.empty()) {
            record.tracks.push_back(track.record(steps));
        }
    }
    for (Ring& ring : rings_) {
        if (pushes_back(*ring.fifo)) {
            record.rings.push_back(record_of(ring, steps));
        }
    }
    for (const auto& [name, series] : named_) {
        record.counters.push_back({name.first, name.second, series->sums()});
        record.counters.back().sums.resize(steps, 0);
    }
    return record;
}

} // namespace degs
