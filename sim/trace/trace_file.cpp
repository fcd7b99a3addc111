// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/trace_file.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "base/ratio.hpp"
#include "degs/error.hpp"
#include "scene/files/output_file.hpp"

namespace degs::sim {
namespace {

// Perfetto shows one group of tracks for each "process".
enum Group { Run = 1, Units, Array, Stages, Buffers, MemoryBus, Power };

std::string quoted(const std::string& words) {
    return dump_json(nlohmann::json(words), -1, true);
}

/// The shortest text that reads back as the same number.
std::string shortest(double value) {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

/// "span_buffer_12" -> "span_buffer".
std::string family_of(const std::string& name) {
    const std::size_t digits = name.find_last_not_of("0123456789");
    const bool numbered =
        digits != std::string::npos && digits + 1 < name.size() && name[digits] == '_';
    const std::string family = numbered ? name.substr(0, digits) : name;
    return family.substr(family.rfind('.') + 1);
}

/// Units of a kind, with the part of the block if it has several processes.
std::string kind_of(const std::string& track) {
    const std::size_t space = track.find(' ');
    return space == std::string::npos ? family_of(track)
                                      : family_of(track.substr(0, space)) + track.substr(space);
}

/// Writes events one by one, a line for each.
class Events {
public:
    explicit Events(const Trace& trace)
        : timeline_(trace.timeline), step_(static_cast<double>(trace.timeline.step)),
          cycles_per_us_(1e3 * trace.clock_ghz) {}

    void name_group(Group group, const std::string& name) {
        begin("process_name", 'M', group, 0);
        text_ += R"(,"args":{"name":)" + quoted(name) + "}}";
        begin("process_sort_index", 'M', group, 0);
        text_ += R"(,"args":{"sort_index":)" + std::to_string(group) + "}}";
    }
    void name_track(Group group, std::size_t track, const std::string& name) {
        begin("thread_name", 'M', group, track);
        text_ += R"(,"args":{"name":)" + quoted(name) + "}}";
        begin("thread_sort_index", 'M', group, track);
        text_ += R"(,"args":{"sort_index":)" + std::to_string(track) + "}}";
    }
    void span(const std::string& name, Group group, std::size_t track, Cycle from, Cycle to,
              const std::string& arguments = "") {
        begin(name, 'X', group, track);
        text_ += R"(,"ts":)" + time(from) + R"(,"dur":)" + time(to - from);
        text_ += arguments.empty() ? "}" : R"(,"args":{)" + arguments + "}}";
    }
    /// `sums` by step, shown as `factor` times their mean over the cycles of a step.
    void counter(const std::string& name, Group group, const std::vector<std::uint64_t>& sums,
                 double factor) {
        std::vector<double> values;
        values.reserve(sums.size());
        for (const std::uint64_t sum : sums) {
            values.push_back(real_of(sum) / step_ * factor);
        }
        counter(name, group, values);
    }
    /// `values` by step.
    void counter(const std::string& name, Group group, const std::vector<double>& values) {
        if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) {
            return;
        }
        for (std::size_t i = 0; i <= values.size(); ++i) { // a last one ends the last step
            const double value = i < values.size() ? values[i] : 0;
            if (i == 0 || value != values[i - 1] || i == values.size()) {
                begin(name, 'C', group, 0);
                text_ += R"(,"ts":)" + time(i * timeline_.step) + R"(,"args":{"value":)" +
                         shortest(value) + "}}";
            }
        }
    }
    std::string take() { return std::move(text_); }

private:
    void begin(const std::string& name, char phase, Group group, std::size_t track) {
        text_ += text_.empty() ? "\n" : ",\n";
        text_ += R"({"name":)" + quoted(name) + R"(,"ph":")" + phase + R"(","pid":)" +
                 std::to_string(group) + R"(,"tid":)" + std::to_string(track);
    }
    std::string time(Cycle date) const { return shortest(real_of(date) / cycles_per_us_); }

    const TimelineRecord& timeline_;
    double step_;
    double cycles_per_us_;
    std::string text_;
};

/// Steps in which a unit did the same for most of the time are one span; its arguments say how much
/// of what there was. Index of the state that took the largest part, the number of states for idle.
std::size_t main_state(const TimelineTrack& track, std::size_t at, Cycle step) {
    std::uint64_t rest = step * track.units;
    std::size_t most = track.states.size();
    std::uint64_t cycles = 0;
    for (std::size_t s = 0; s < track.states.size(); ++s) {
        const std::uint64_t here = track.states[s].cycles[at];
        rest -= std::min(rest, here);
        if (here > cycles) {
            cycles = here;
            most = s;
        }
    }
    return rest > cycles ? track.states.size() : most;
}

void add_track(Events& events, const TimelineRecord& timeline, std::size_t number) {
    const TimelineTrack& track = timeline.tracks[number];
    const std::size_t steps = timeline.steps();
    for (std::size_t first = 0; first < steps;) {
        const std::size_t state = main_state(track, first, timeline.step);
        std::size_t end = first + 1;
        while (end < steps && main_state(track, end, timeline.step) == state) {
            ++end;
        }
        std::string arguments;
        for (const TimelineState& s : track.states) {
            std::uint64_t cycles = 0;
            for (std::size_t i = first; i < end; ++i) {
                cycles += s.cycles[i];
            }
            if (cycles != 0) {
                arguments +=
                    (arguments.empty() ? "" : ",") + quoted(s.name) + ":" + std::to_string(cycles);
            }
        }
        if (!arguments.empty()) {
            const std::string name =
                state == track.states.size() ? "idle" : track.states[state].name;
            events.span(name, Units, number, first * timeline.step, end * timeline.step, arguments);
        }
        first = end;
    }
}

void add_units(Events& events, const TimelineRecord& timeline) {
    events.name_group(Units, "units: what each did for most of the time");
    for (std::size_t t = 0; t < timeline.tracks.size(); ++t) {
        if (!timeline.tracks[t].states.empty()) {
            events.name_track(Units, t, timeline.tracks[t].name);
            add_track(events, timeline, t);
        }
    }
}

using Sums = std::vector<std::uint64_t>;

/// Sums of several things of a kind, kinds in the order in which they first come.
class Kinds {
public:
    struct Kind {
        std::string name;
        std::uint64_t size = 0;
        Sums sums;
    };
    void add(const std::string& name, std::uint64_t size, const Sums& sums) {
        auto kind = std::find_if(kinds_.begin(), kinds_.end(),
                                 [&](const Kind& k) { return k.name == name; });
        if (kind == kinds_.end()) {
            kind = kinds_.insert(kind, Kind{name, 0, Sums(sums.size(), 0)});
        }
        kind->size += size;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            kind->sums[i] += sums[i];
        }
    }
    const std::vector<Kind>& all() const { return kinds_; }

private:
    std::vector<Kind> kinds_;
};

void add_stages(Events& events, const TimelineRecord& timeline) {
    Kinds stages;
    for (const TimelineTrack& track : timeline.tracks) {
        for (const TimelineState& state : track.states) {
            if (state.kind == TimelineState::Kind::Busy) {
                stages.add(kind_of(track.name), track.units, state.cycles);
            }
        }
    }
    events.name_group(Stages, "stages: busy units");
    for (const Kinds::Kind& stage : stages.all()) {
        events.counter(stage.name + " (of " + std::to_string(stage.size) + ")", Stages, stage.sums,
                       1);
    }
}

void add_rings(Events& events, const TimelineRecord& timeline) {
    Kinds buffers;
    for (const TimelineRing& ring : timeline.rings) {
        buffers.add(family_of(ring.name), ring.depth, ring.cell_cycles);
    }
    events.name_group(Buffers, "buffers: full cells");
    for (const Kinds::Kind& buffer : buffers.all()) {
        events.counter(buffer.name + " (of " + std::to_string(buffer.size) + ")", Buffers,
                       buffer.sums, 1);
    }
}

void add_counters(Events& events, const Trace& trace) {
    events.name_group(Array, "array: PEs by slot class");
    events.name_group(MemoryBus, "memory: GB/s by stream");
    // Slot classes in their own order, not by name.
    for (const SlotClass& slot : kSlotClasses) {
        for (const TimelineCounter& counter : trace.timeline.counters) {
            if (counter.group == "slots" && counter.name == slot.name) {
                events.counter(counter.name, Array, counter.sums, 1);
            }
        }
    }
    Sums all(trace.timeline.steps(), 0);
    for (const TimelineCounter& counter : trace.timeline.counters) {
        if (counter.group == "memory") {
            std::transform(all.begin(), all.end(), counter.sums.begin(), all.begin(),
                           std::plus<>());
        }
    }
    events.counter("all streams", MemoryBus, all, trace.clock_ghz);
    for (const TimelineCounter& counter : trace.timeline.counters) {
        if (counter.group == "memory") {
            events.counter(counter.name, MemoryBus, counter.sums, trace.clock_ghz);
        }
    }
}

void add_power(Events& events, const Trace& trace) {
    if (trace.power.empty()) {
        return;
    }
    events.name_group(Power, "power: mW by block");
    std::vector<double> all(trace.timeline.steps(), 0);
    for (const PowerSeries& series : trace.power) {
        std::transform(all.begin(), all.end(), series.mw.begin(), all.begin(), std::plus<>());
    }
    events.counter("all blocks and memory", Power, all);
    for (const PowerSeries& series : trace.power) {
        events.counter(series.name, Power, series.mw);
    }
}

} // namespace

std::vector<TraceSpan> spans_of(const AcceleratorResult& run) {
    std::vector<TraceSpan> spans;
    if (run.window.empty()) {
        return {{"run", 0, run.cycles}};
    }
    if (run.window.first > 0) {
        spans.push_back({"before the first task", 0, run.window.first});
    }
    spans.push_back({"blending", run.window.first, run.window.last + 1});
    if (run.cycles > run.window.last + 1) {
        spans.push_back({"after the last task", run.window.last + 1, run.cycles});
    }
    return spans;
}

std::string trace_text(const Trace& trace) {
    Events events(trace);
    events.name_group(Run, trace.design);
    events.name_track(Run, 0, "run");
    for (const TraceSpan& span : trace.spans) {
        events.span(span.name, Run, 0, span.from, span.to);
    }
    add_units(events, trace.timeline);
    add_counters(events, trace);
    add_stages(events, trace.timeline);
    add_rings(events, trace.timeline);
    add_power(events, trace);
    return R"({"displayTimeUnit":"ns","otherData":{"design":)" + quoted(trace.design) +
           R"(,"clock_ghz":)" + shortest(trace.clock_ghz) + R"(,"step_cycles":)" +
           std::to_string(trace.timeline.step) + R"(,"cycles":)" +
           std::to_string(trace.timeline.end) + R"(},"traceEvents":[)" + events.take() + "\n]}\n";
}

void write_trace(const Trace& trace, const std::string& path) {
    write_whole(path, trace_text(trace));
}

} // namespace degs::sim
