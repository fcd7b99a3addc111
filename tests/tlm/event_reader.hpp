// SPDX-License-Identifier: Apache-2.0
// Reads the events of a log again.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "tlm/event_log.hpp"

namespace degs::test {

/// An event. Its kind belongs to the log, which must outlive it.
class LoggedEvent {
public:
    const EventLog::Kind* form = nullptr;
    Cycle now = 0;
    std::vector<std::int64_t> numbers; ///< fields, then the groups of the list one after another
    std::size_t parts = 0;             ///< groups

    const std::string& kind() const { return form->name; }
    bool has(const std::string& name) const { return place_of(name) < form->fields.size(); }
    std::int64_t operator[](const std::string& name) const {
        const std::size_t place = place_of(name);
        if (place == form->fields.size()) {
            throw std::out_of_range("an event " + kind() + " has no field " + name);
        }
        return numbers[place];
    }
    /// A field of a group, by its place in the group.
    std::int64_t part(std::size_t group, std::size_t field) const {
        const std::size_t fields = form->fields.back().parts.size();
        return numbers[form->fields.size() - 1 + group * fields + field];
    }

private:
    std::size_t place_of(const std::string& name) const {
        std::size_t place = 0;
        while (place < form->fields.size() && form->fields[place].name != name) {
            ++place;
        }
        return place;
    }
};

class EventReader {
public:
    EventReader(const std::vector<EventLog::Kind>& kinds, const std::string& bytes)
        : kinds_(kinds), bytes_(bytes) {}
    bool more() const { return place_ < bytes_.size(); }
    LoggedEvent next() {
        LoggedEvent event;
        event.form = &kinds_.at(static_cast<std::size_t>(number()));
        now_ += static_cast<Cycle>(number());
        event.now = now_;
        for (const EventLog::Field& field : event.form->fields) {
            std::size_t more = 1;
            if (!field.parts.empty()) {
                event.parts = static_cast<std::size_t>(number());
                more = event.parts * field.parts.size();
            }
            for (; more > 0; --more) {
                event.numbers.push_back(number());
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

inline std::vector<LoggedEvent> events_of(const std::vector<EventLog::Kind>& kinds,
                                          const std::string& bytes) {
    std::vector<LoggedEvent> events;
    for (EventReader reader(kinds, bytes); reader.more();) {
        events.push_back(reader.next());
    }
    return events;
}
inline std::vector<LoggedEvent> events_of(const EventLog& log) {
    return events_of(log.kinds(), log.bytes());
}

} // namespace degs::test
