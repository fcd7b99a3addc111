// SPDX-License-Identifier: Apache-2.0
// What the naive blocks of a bank share.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace degs::test {

using Number = std::int64_t;

/// What a log says about its block, by name.
class NaiveFacts {
public:
    explicit NaiveFacts(std::map<std::string, Number> facts) : facts_(std::move(facts)) {}
    Number operator[](const char* name) const { return facts_.at(name); }

private:
    std::map<std::string, Number> facts_;
};

/// What a block does, in lines of numbers.
class NaiveLines {
public:
    void say(Number now, const char* what, const std::vector<Number>& numbers) {
        std::string line = std::to_string(now) + " " + what;
        for (const Number number : numbers) {
            line += " " + std::to_string(number);
        }
        lines_.push_back(line);
    }
    const std::vector<std::string>& lines() const { return lines_; }

private:
    std::vector<std::string> lines_;
};

/// A segment of a row in a bank.
struct NaiveSegment {
    Number tile, context, domain, splat, row, column, sequence, entry;
    std::uint32_t mask;
};

} // namespace degs::test
