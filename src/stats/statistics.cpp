// SPDX-License-Identifier: Apache-2.0
#include "stats/statistics.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace degs {

void Counters::begin_section(const std::string& name, const std::string&) {
    throw std::logic_error("the counters of a unit have no section, but '" + name + "' is one");
}

void Counters::end_section() {
    throw std::logic_error("the counters of a unit have no sections");
}

std::uint64_t& Counters::counter(const StatDoc& doc) {
    const auto known =
        std::find_if(counters_.begin(), counters_.end(), [&doc](const Counter& counter) {
            return std::strcmp(counter.doc.name, doc.name) == 0;
        });
    return known != counters_.end() ? known->value : counters_.emplace_back(Counter{doc, 0}).value;
}

void Counters::statistic(const StatDoc& doc, const StatValue& value) {
    const auto* whole = std::get_if<std::uint64_t>(&value);
    if (whole == nullptr) {
        throw std::logic_error(std::string("the counter '") + doc.name + "' is not a whole number");
    }
    counter(doc) += *whole;
}

void Counters::peak(const StatDoc& doc, std::uint64_t value) {
    std::uint64_t& highest = counter(doc);
    highest = std::max(highest, value);
}

void Counters::describe(StatsVisitor& visitor) const {
    for (const Counter& counter : counters_) {
        visitor.statistic(counter.doc, counter.value);
    }
}

} // namespace degs
