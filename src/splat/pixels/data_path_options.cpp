// SPDX-License-Identifier: Apache-2.0
// Numbers of a data path by name.
#include <algorithm>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "splat/numbers/number_set.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

const std::vector<const char*>& arithmetic_names() {
    static const std::vector<const char*> names{"fp32", "fp64", "ideal", "fp16", "paper", "tuned"};
    return names;
}

const char* name_of(Arithmetic arithmetic) {
    return arithmetic_names().at(static_cast<std::size_t>(arithmetic));
}

namespace {

Arithmetic arithmetic_of(const std::string& name) {
    const std::vector<const char*>& names = arithmetic_names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        throw InputError("There are no numbers '" + name + "'; there are " +
                         config_words::list({names.begin(), names.end()}) + ".");
    }
    return static_cast<Arithmetic>(at - names.begin());
}

} // namespace

DataPathOptions options_of(const NumberSet& set) {
    DataPathOptions options;
    options.ends = set.ends;
    options.delta = set.delta;
    options.set = set;
    options.projection = set.projection_numbers();
    return options;
}

ProjectionOptions projection_of(const DataPathOptions& path, bool antialiased) {
    return path.rules.options(antialiased, path.projection);
}

NumberSet set_of(Arithmetic arithmetic) {
    return number_set(arithmetic == Arithmetic::Fp64 ? "ideal" : name_of(arithmetic));
}

DataPathOptions named_numbers(const std::string& name) {
    return named_numbers(name, {});
}

DataPathOptions named_numbers(const std::string& name,
                              const std::vector<std::string>& assignments) {
    const std::vector<std::string> parts = with_record_formats(assignments);
    const Arithmetic arithmetic = arithmetic_of(name);
    const NumberSet set = number_set(set_of(arithmetic).name, assignments);
    DataPathOptions options = options_of(set);
    const bool same = std::all_of(parts.begin(), parts.end(), [](const std::string& assignment) {
        return NumberSet::makes_splats(assignment.substr(0, assignment.find('=')));
    });
    if (same) {
        options.set.reset();
        options.numbers = arithmetic;
    }
    return options;
}

} // namespace degs
