// SPDX-License-Identifier: Apache-2.0
// Values as bytes for another process of this program. A message is a heading, which names its
// version, then the fields: a line with name and number of bytes, the bytes, and the end of the
// line.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/config_words.hpp"
#include "sim/simulation/frame_changes.hpp"

namespace degs::sim {

/// The fields of the changes, in their order.
template <class Fields, class Changes>
void each_change(Fields& fields, Changes& changes) {
    fields("active_overlap", changes.active_overlap);
    fields("tile_churn", changes.tile_churn);
    fields("p99_tile_candidates", changes.p99_tile_candidates);
    fields("footprint_gini", changes.footprint_gini);
}

/// Writes the fields that it is called with, in this order.
class MessageWriter {
public:
    explicit MessageWriter(const std::string& heading) : message(heading + "\n") {}
    template <class Value>
    void operator()(const std::string& name, const Value& value) {
        const std::string bytes = text(value);
        message += name + " " + std::to_string(bytes.size()) + "\n" + bytes + "\n";
    }
    std::string message;

private:
    static const std::string& text(const std::string& value) { return value; }
    static std::string text(int value) { return std::to_string(value); }
    static std::string text(std::size_t value) { return std::to_string(value); }
    /// Sentences may have any character, because names of files may; each comes after its size.
    static std::string text(const std::vector<std::string>& values) {
        std::string list;
        for (const std::string& value : values) {
            list += text(value.size()) + "\n" + value + "\n";
        }
        return list;
    }
    static std::string text(const std::vector<std::pair<std::string, double>>& values) {
        std::string lines;
        for (const auto& [name, value] : values) {
            lines += text(value) + " " + name + "\n";
        }
        return lines;
    }
    static std::string text(double value) { return config_words::number(value); }
    /// A message in the message.
    static std::string text(const FrameChanges& changes) {
        MessageWriter inner("changes");
        each_change(inner, changes);
        return inner.message;
    }
    template <class Value>
    static std::string text(const std::optional<Value>& value) {
        return value ? text(*value) : "";
    }
};

/// Reads the fields that it is called with. Throws std::runtime_error, which names the field.
class MessageReader {
public:
    MessageReader(const std::string& heading, const std::string& message) {
        if (message.rfind(heading + "\n", 0) != 0) {
            fail("it does not begin with '" + heading + "'");
        }
        for (std::size_t at = heading.size() + 1; at < message.size();) {
            at = read_field(message, at);
        }
    }
    template <class Value>
    void operator()(const std::string& name, Value& value) {
        const auto field = fields_.find(name);
        if (field == fields_.end()) {
            fail("'" + name + "' is missing");
        }
        take(name, field->second, value);
        fields_.erase(field);
    }
    void expect_nothing_left() const {
        if (!fields_.empty()) {
            fail("'" + fields_.begin()->first + "' is unknown");
        }
    }

private:
    /// Returns where the next one begins.
    std::size_t read_field(const std::string& message, std::size_t at) {
        const std::size_t line = message.find('\n', at);
        const std::size_t space = message.find(' ', at);
        if (line == std::string::npos || space >= line) {
            fail("it is cut off");
        }
        const std::string name = message.substr(at, space - at);
        std::size_t bytes = 0;
        take(name, message.substr(space + 1, line - space - 1), bytes);
        const std::size_t left = message.size() - line - 1;
        if (left == 0 || bytes > left - 1 || message[line + 1 + bytes] != '\n') {
            fail("'" + name + "' is cut off");
        }
        fields_[name] = message.substr(line + 1, bytes);
        return line + 1 + bytes + 1;
    }
    static void take(const std::string&, const std::string& text, std::string& value) {
        value = text;
    }
    static void take(const std::string& name, const std::string& text,
                     std::vector<std::string>& values) {
        values.clear();
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t line = std::min(text.find('\n', at), text.size());
            std::size_t bytes = 0;
            take(name, text.substr(at, line - at), bytes);
            const std::size_t left = text.size() - line;
            if (left < 2 || bytes > left - 2 || text[line + 1 + bytes] != '\n') {
                fail("'" + name + "' is cut off");
            }
            values.push_back(text.substr(line + 1, bytes));
            at = line + 1 + bytes + 1;
        }
    }
    static void take(const std::string& name, const std::string& text,
                     std::vector<std::pair<std::string, double>>& values) {
        values.clear();
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t space = std::min(line.find(' '), line.size());
            double value = 0;
            take(name, line.substr(0, space), value);
            values.emplace_back(line.substr(std::min(space + 1, line.size())), value);
        }
    }
    static void take(const std::string&, const std::string& text, FrameChanges& changes) {
        MessageReader inner("changes", text);
        each_change(inner, changes);
        inner.expect_nothing_left();
    }
    template <class Number>
    static void take(const std::string& name, const std::string& text, Number& value) {
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end) {
            fail("'" + name + "' is not a number");
        }
    }
    template <class Value>
    static void take(const std::string& name, const std::string& text,
                     std::optional<Value>& value) {
        value.reset();
        if (!text.empty()) {
            take(name, text, value.emplace());
        }
    }
    [[noreturn]] static void fail(const std::string& reason) {
        throw std::runtime_error("the result of the run cannot be read, " + reason);
    }
    std::map<std::string, std::string> fields_;
};

} // namespace degs::sim
