// SPDX-License-Identifier: Apache-2.0
// What naive blocks that are driven from a log (docs/block-log.md) share: the messages that came
// in, the places behind the block, and what it does as lines of text.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/modules/degs/scheduler/naive_facts.hpp"
#include "tests/tlm/event_reader.hpp"

namespace degs::test {

/// Messages by port and cycle. Which port comes first within a cycle is not compared.
class PortLines {
public:
    void say(Number now, const std::string& kind, Number port, const std::vector<Number>& numbers) {
        Line line{now, kind + " " + std::to_string(port), ""};
        for (const Number number : numbers) {
            line.rest += " " + std::to_string(number);
        }
        lines_.push_back(line);
    }
    std::vector<std::string> sorted() {
        std::stable_sort(lines_.begin(), lines_.end(), [](const Line& a, const Line& b) {
            return std::tie(a.now, a.port) < std::tie(b.now, b.port);
        });
        std::vector<std::string> texts;
        for (const Line& line : lines_) {
            texts.push_back(std::to_string(line.now) + " " + line.port + line.rest);
        }
        return texts;
    }

private:
    struct Line {
        Number now;
        std::string port, rest;
    };
    std::vector<Line> lines_;
};

/// The messages that the block of a log has taken and sent, with the dates from which they could be
/// read.
inline std::vector<std::string> port_lines(const std::vector<LoggedEvent>& events) {
    PortLines lines;
    for (const LoggedEvent& event : events) {
        const auto now = static_cast<Number>(event.now);
        if (event.kind() == "splat") {
            lines.say(now, "splat", 0, {event["tile"], event["entry"]});
        }
        if (!event.has("port")) {
            continue; // a fact about what the block computes
        }
        const bool waited = event.has("waited");
        const std::vector<Number> rest(event.numbers.begin() + (waited ? 2 : 1),
                                       event.numbers.end());
        if (event.kind() == "taken") {
            lines.say(now - event["waited"], "readable", event["port"], {});
        } else {
            lines.say(now, event.kind(), event["port"], rest);
        }
    }
    return lines.sorted();
}

class NaiveBlock {
public:
    NaiveBlock(std::map<std::string, Number> facts, const std::vector<LoggedEvent>& events)
        : facts_(std::move(facts)) {
        for (const LoggedEvent& event : events) {
            const auto now = static_cast<Number>(event.now);
            end_ = std::max(end_, now);
            if (event.kind() == "taken") {
                taken_[event["port"]].push_back(now);
            } else if (event.has("waited")) { // it came in
                messages_[event.kind()][event["port"]].push_back({event, now - event["waited"]});
            }
        }
    }

    virtual ~NaiveBlock() = default;
    /// Messages by port and cycle.
    std::vector<std::string> run() {
        try {
            follow();
        } catch (const Stuck&) {
            lines_.say(now_, "waits for ever", 0, {});
        }
        return lines_.sorted();
    }

protected:
    /// Thrown when the log has long ended.
    struct Stuck {};
    virtual void follow() = 0;
    void next_cycle() {
        if (++now_ > end_ + kPatience) {
            throw Stuck();
        }
    }
    void wait_for(const std::string& kind, Number port = 0) {
        while (!arrived(kind, port)) {
            next_cycle();
        }
    }
    void wait_for_room(Number port) {
        while (!room(port, 0)) {
            next_cycle();
        }
    }
    struct Message {
        LoggedEvent event;
        Number readable;
    };
    Number fact(const char* name) const { return facts_.at(name); }
    std::deque<Message>& messages(const std::string& kind, Number port = 0) {
        return messages_[kind][port];
    }
    bool left(const std::string& kind) {
        const auto& ports = messages_[kind];
        return std::any_of(ports.begin(), ports.end(),
                           [](const auto& port) { return !port.second.empty(); });
    }
    bool arrived(const std::string& kind, Number port = 0) {
        const std::deque<Message>& waiting = messages(kind, port);
        return !waiting.empty() && waiting.front().readable <= now_;
    }
    LoggedEvent take(const std::string& kind, Number port = 0) {
        LoggedEvent event = std::move(messages(kind, port).front().event);
        messages(kind, port).pop_front();
        lines_.say(now_, kind, port, {event.numbers.begin() + 2, event.numbers.end()});
        return event;
    }
    /// True if a place behind a port is free that its reader has freed `release` cycles ago.
    bool room(Number port, Number release) {
        std::deque<Number>& taken = taken_[port];
        for (; !taken.empty() && taken.front() + release <= now_; taken.pop_front()) {
            --inside_[port];
        }
        return inside_[port] < fact("places");
    }
    void send(const std::string& kind, Number port, const std::vector<Number>& numbers) {
        lines_.say(now_, kind, port, numbers);
    }
    /// Into a place behind the port, from which it can be read `latency` cycles later.
    void fill(const std::string& kind, Number port, const std::vector<Number>& numbers,
              Number latency) {
        send(kind, port, numbers);
        lines_.say(now_ + latency, "readable", port, {});
        ++inside_[port];
    }

    static constexpr Number kNobody = 0xFFFFFFFF; // in place of a tile: nothing follows
    Number now_ = 0;
    PortLines lines_;

private:
    static constexpr Number kPatience = 10000; // cycles
    Number end_ = 0;                           // of the log
    std::map<std::string, Number> facts_;
    std::map<std::string, std::map<Number, std::deque<Message>>> messages_;
    std::map<Number, std::deque<Number>> taken_;
    std::map<Number, Number> inside_;
};

} // namespace degs::test
