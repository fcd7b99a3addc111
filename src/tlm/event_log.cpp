// SPDX-License-Identifier: Apache-2.0
#include "tlm/event_log.hpp"

#include <algorithm>

namespace degs {

std::size_t EventLog::kind(const std::string& name, const std::vector<Field>& fields) {
    const auto found = std::find_if(kinds_.begin(), kinds_.end(),
                                    [&](const Kind& kind) { return kind.name == name; });
    if (found != kinds_.end()) {
        return static_cast<std::size_t>(found - kinds_.begin());
    }
    kinds_.push_back({name, fields});
    return kinds_.size() - 1;
}

void EventLog::begin(std::size_t kind, Cycle now) {
    put(static_cast<std::int64_t>(kind));
    put(static_cast<std::int64_t>(now - latest_));
    latest_ = now;
}

// Numbers near zero are short: the sign goes to the lowest bit, and a byte has seven bits.
void EventLog::put(std::int64_t value) {
    std::uint64_t rest =
        static_cast<std::uint64_t>(value) << 1U ^ static_cast<std::uint64_t>(value >> 63U);
    while (rest >= 0x80) {
        bytes_.push_back(static_cast<char>(rest | 0x80));
        rest >>= 7U;
    }
    bytes_.push_back(static_cast<char>(rest));
}

} // namespace degs
