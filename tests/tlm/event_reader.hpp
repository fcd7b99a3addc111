// SPDX-License-Identifier: Apache-2.0
// Reads the events of a log again.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tlm/event_log.hpp"

namespace degs::test {

/// An event: its numbers by name, and the groups of its list.
struct LoggedEvent {
    std::string kind;
    Cycle now = 0;
    std::map<std::string, std::int64_t> numbers;
    std::vector<std::map<std::string, std::int64_t>> parts;
    std::int64_t operator[](const std::string& name) const { return numbers.at(name); }
};

class EventReader {
public:
    EventReader(const std::vector<EventLog::Kind>& kinds, const std::string& bytes)
        : kinds_(kinds), bytes_(bytes) {}
    bool more() const { return place_ < bytes_.size(); }
    LoggedEvent next() {
        const EventLog::Kind& kind = kinds_.at(static_cast<std::size_t>(number()));
        now_ += static_cast<Cycle>(number());
        LoggedEvent event{kind.name, now_, {}, {}};
        for (const EventLog::Field& field : kind.fields) {
            if (field.parts.empty()) {
                event.numbers[field.name] = number();
                continue;
            }
            event.parts.resize(static_cast<std::size_t>(number()));
            for (auto& part : event.parts) {
                for (const std::string& name : field.parts) {
                    part[name] = number();
                }
            }
        }
        return event;
    }

private:
    std::int64_t number() {
        std::uint64_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(bytes_.at(place_++));
            value |= std::uint64_t{byte & 0x7FU} << shift;
            if (byte < 0x80) {
                return static_cast<std::int64_t>(value >> 1U) ^
                       -static_cast<std::int64_t>(value & 1U);
            }
        }
    }
    const std::vector<EventLog::Kind>& kinds_;
    const std::string& bytes_;
    std::size_t place_ = 0;
    Cycle now_ = 0;
};

inline std::vector<LoggedEvent> events_of(const EventLog& log) {
    std::vector<LoggedEvent> events;
    for (EventReader reader(log.kinds(), log.bytes()); reader.more();) {
        events.push_back(reader.next());
    }
    return events;
}

} // namespace degs::test
