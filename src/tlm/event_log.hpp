// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tlm/clock_domain.hpp"

namespace degs {

/// What happens at a block, event after event, in the form of docs/block-log.md. An event has a
/// kind, a cycle and whole numbers, whose names the kind knows; the last of them may be a list of
/// groups of numbers. The log is kept in memory: about twenty bytes per event.
class EventLog {
public:
    /// A number of an event; with `parts`, a list of groups of numbers, one for each part.
    struct Field {
        std::string name;
        std::vector<std::string> parts;
    };
    struct Kind {
        std::string name;
        std::vector<Field> fields;
    };
    /// A fact about the block, which somebody who replays the log has to know.
    void set(std::string name, std::int64_t value) { facts_.emplace_back(std::move(name), value); }
    /// Adds a kind, or finds it if there is one of that name.
    std::size_t kind(const std::string& name, const std::vector<Field>& fields);
    /// Begins an event. Its numbers follow in the order of the fields; the length of a list goes
    /// before its groups.
    void begin(std::size_t kind, Cycle now);
    void put(std::int64_t value);

    const std::vector<Kind>& kinds() const { return kinds_; }
    const std::vector<std::pair<std::string, std::int64_t>>& facts() const { return facts_; }
    /// The events as bytes, in the form of docs/block-log.md.
    const std::string& bytes() const { return bytes_; }

private:
    std::vector<Kind> kinds_;
    std::vector<std::pair<std::string, std::int64_t>> facts_;
    std::string bytes_;
    Cycle latest_ = 0;
};

/// A side of a ring in a log, if there is one: the events `kind` of port `port` of a block.
struct LoggedSide {
    EventLog* log = nullptr;
    std::size_t kind = 0;
    std::int64_t port = 0;

    /// Logs that an item is taken at `now` that could be read from `readable` on.
    void begin_take(Cycle readable, Cycle now) const {
        log->begin(kind, now);
        log->put(port);
        log->put(static_cast<std::int64_t>(now - readable));
    }
};

/// Collects the names of a message's fields. Messages that a log shows have
///     template <class Visitor> void visit(Visitor& visitor) const
/// which calls number() for every field, and list() for the last one if it is a list of messages.
class FieldNames {
public:
    void number(const char* name, std::int64_t /*value*/) { fields_.push_back({name, {}}); }
    template <class Part>
    void list(const char* name, const Part* /*first*/, std::size_t /*count*/) {
        FieldNames parts;
        Part().visit(parts);
        EventLog::Field list{name, {}};
        for (const EventLog::Field& part : parts.fields_) {
            list.parts.push_back(part.name);
        }
        fields_.push_back(list);
    }
    const std::vector<EventLog::Field>& fields() const { return fields_; }

private:
    std::vector<EventLog::Field> fields_;
};

/// Writes the fields of a message into a log.
class FieldValues {
public:
    explicit FieldValues(EventLog& log) : log_(log) {}
    void number(const char* /*name*/, std::int64_t value) { log_.put(value); }
    template <class Part>
    void list(const char* /*name*/, const Part* first, std::size_t count) {
        log_.put(static_cast<std::int64_t>(count));
        for (std::size_t i = 0; i < count; ++i) {
            first[i].visit(*this);
        }
    }

private:
    EventLog& log_;
};

template <class Message, class Visitor, class = void>
struct HasFields : std::false_type {};
template <class Message, class Visitor>
struct HasFields<
    Message, Visitor,
    std::void_t<decltype(std::declval<const Message&>().visit(std::declval<Visitor&>()))>>
    : std::true_type {};

/// The fields of a message. A plain number is one; messages without visit() have none.
template <class Message, class Visitor>
void visit_fields(const Message& message, Visitor& visitor) {
    if constexpr (std::is_integral_v<Message>) {
        visitor.number("value", static_cast<std::int64_t>(message));
    } else if constexpr (HasFields<Message, Visitor>::value) {
        message.visit(visitor);
    }
}

/// A block that can write what happens at its ports.
class LoggedBlock {
public:
    LoggedBlock() = default;
    LoggedBlock(const LoggedBlock&) = delete;
    LoggedBlock& operator=(const LoggedBlock&) = delete;
    virtual ~LoggedBlock() = default;
    /// Has the block write to `log`; before the simulation starts. Everything is logged in strict
    /// mode; in exact mode rows that are replayed pass without messages.
    virtual void log_to(EventLog& log) = 0;
};

} // namespace degs
