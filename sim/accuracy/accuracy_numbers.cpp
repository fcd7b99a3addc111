// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy/accuracy_numbers.hpp"

#include <algorithm>

#include "degs/error.hpp"
#include "modules/kit/config/number_choice.hpp"

namespace degs::sim {

std::vector<std::string> span_end_names() {
    return {"exact", "outward", "slope"};
}

std::string words_of(SpanEnds ends) {
    return span_end_names().at(static_cast<std::size_t>(ends));
}

AccuracyNumbers numbers_of(const std::string& text, const std::string& span_ends) {
    const NumberChoice choice = read_numbers(text, {"--numbers", ""});
    AccuracyNumbers numbers{choice.set(), named_numbers(name_of(choice.base), choice.parts)};
    numbers.set.name = text;
    std::replace(numbers.set.name.begin(), numbers.set.name.end(), ':', ' ');
    if (!span_ends.empty()) {
        const std::vector<std::string> names = span_end_names();
        const auto at = std::find(names.begin(), names.end(), span_ends);
        if (at == names.end()) {
            throw InputError("There are no span ends '" + span_ends +
                             "'; there are exact, outward, slope.");
        }
        numbers.set.ends = static_cast<SpanEnds>(at - names.begin());
    }
    numbers.path.ends = numbers.set.ends;
    return numbers;
}

ProjectionOptions projected_in(const NumberSet& set, ProjectionOptions options) {
    options.numbers = set.projection_numbers();
    return options;
}

} // namespace degs::sim
