// SPDX-License-Identifier: Apache-2.0
// A message is a line with its name and version, then the fields: a line with name and number of
// bytes, the bytes, and the end of the line.
#include "sim/compare/run_summary.hpp"

#include <array>
#include <charconv>
#include <map>
#include <sstream>
#include <stdexcept>

#include "config/config_words.hpp"

namespace degs::sim {
namespace {

std::string heading() {
    return "degs-run-summary " + std::to_string(kSummaryVersion) + "\n";
}

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error("the result of the run cannot be read, " + reason);
}

/// The fields of a message, in its order: writing and reading use this one list.
template <class Fields, class Summary>
void each_field(Fields& fields, Summary& summary) {
    fields("accelerator", summary.accelerator);
    fields("pes", summary.pes);
    fields("tile_size", summary.tile_size);
    fields("view.scene", summary.view.scene);
    fields("view.source", summary.view.source);
    fields("view.camera_name", summary.view.camera_name);
    fields("view.camera", summary.view.camera);
    fields("view.width", summary.view.width);
    fields("view.height", summary.view.height);
    fields("view.gaussians", summary.view.gaussians);
    fields("view.visible", summary.view.visible);
    fields("view.fragments", summary.view.fragments);
    for_each_measure([&](Measure m) { fields("measure." + name_of(m), summary.measures[m]); });
    fields("warnings", summary.warnings);
    fields("report", summary.report);
}

class Writer {
public:
    template <class Value>
    void operator()(const std::string& name, const Value& value) {
        const std::string bytes = text(value);
        message += name + " " + std::to_string(bytes.size()) + "\n" + bytes + "\n";
    }
    std::string message = heading();

private:
    static const std::string& text(const std::string& value) { return value; }
    static std::string text(int value) { return std::to_string(value); }
    static std::string text(std::size_t value) { return std::to_string(value); }
    /// Sentences end at the ends of lines.
    static std::string text(const std::vector<std::string>& values) {
        std::string lines;
        for (const std::string& value : values) {
            lines += value + "\n";
        }
        return lines;
    }
    static std::string text(double value) { return config_words::number(value); }
    template <class Value>
    static std::string text(const std::optional<Value>& value) {
        return value ? text(*value) : "";
    }
};

class Reader {
public:
    explicit Reader(const std::string& message) {
        if (message.rfind(heading(), 0) != 0) {
            fail("it is not of version " + std::to_string(kSummaryVersion));
        }
        for (std::size_t at = heading().size(); at < message.size();) {
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
    static void take(const std::string&, const std::string& text,
                     std::vector<std::string>& values) {
        values.clear();
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            values.push_back(line);
        }
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
    std::map<std::string, std::string> fields_;
};

} // namespace

RunSummary summary_of(const RunResult& result, int camera) {
    RunSummary summary;
    summary.accelerator = result.config.kind();
    summary.pes = result.accelerator.pes;
    summary.tile_size = result.workload.tile_size;
    summary.view = {result.scene.name,
                    result.scene.source,
                    result.camera.name,
                    camera,
                    result.camera.width,
                    result.camera.height,
                    result.workload.gaussians,
                    result.workload.visible,
                    std::nullopt};
    if (result.workload.reference) {
        summary.view.fragments = result.workload.reference->fragments;
    }
    summary.measures = measures_of(result);
    summary.warnings = result.warnings;
    return summary;
}

std::string message_of(const RunSummary& summary) {
    Writer writer;
    each_field(writer, summary);
    return std::move(writer.message);
}

RunSummary summary_from(const std::string& message) {
    Reader reader(message);
    RunSummary summary;
    each_field(reader, summary);
    reader.expect_nothing_left();
    return summary;
}

} // namespace degs::sim
