// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy_numbers.hpp"

#include <algorithm>

#include "splat/error.hpp"

namespace degs::sim {

std::vector<std::string> span_end_names() {
    return {"exact", "outward", "slope"};
}

std::string words_of(SpanEnds ends) {
    return span_end_names().at(static_cast<std::size_t>(ends));
}

NumberSet numbers_of(const std::string& name, const std::string& span_ends) {
    NumberSet set = number_set(name);
    if (!span_ends.empty()) {
        const std::vector<std::string> names = span_end_names();
        const auto at = std::find(names.begin(), names.end(), span_ends);
        if (at == names.end()) {
            throw InputError("There are no span ends '" + span_ends +
                             "'; there are exact, outward, slope.");
        }
        set.ends = static_cast<SpanEnds>(at - names.begin());
    }
    return set;
}

DataPathOptions data_path_of(const NumberSet& set) {
    DataPathOptions options = named_numbers(set.name);
    options.ends = set.ends;
    options.delta = set.delta;
    return options;
}

} // namespace degs::sim
