// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy_numbers.hpp"

#include "splat/error.hpp"

namespace degs::sim {

std::string words_of(Ends ends) {
    return ends == Ends::Exact ? "exact" : "outward";
}

std::vector<std::string> span_end_names() {
    return {"exact", "outward"};
}

NumberSet numbers_of(const std::string& name, const std::string& span_ends) {
    NumberSet set = number_set(name);
    if (!span_ends.empty()) {
        set.ends = span_ends == "exact" ? Ends::Exact : Ends::Outward;
    }
    return set;
}

DataPathOptions data_path_of(const NumberSet& set) {
    DataPathOptions options;
    if (set.name != "ideal" && set.name != "fp32") {
        throw InputError("Images cannot be made in the number set '" + set.name +
                         "' yet; allowed are ideal and fp32.");
    }
    options.numbers = set.name == "ideal" ? NumberFormat::Fp64 : NumberFormat::Fp32;
    options.ends = set.ends == Ends::Exact ? SpanEnds::Exact : SpanEnds::Outward;
    return options;
}

} // namespace degs::sim
