// SPDX-License-Identifier: Apache-2.0
// Numbers of a data path by name.
#include <algorithm>

#include "config/error.hpp"
#include "splat/data_path.hpp"
#include "splat/numbers/number_override.hpp"

namespace degs {

const std::vector<const char*>& arithmetic_names() {
    static const std::vector<const char*> names{"fp32", "fp64", "ideal", "fp16", "paper", "tuned"};
    return names;
}

DataPathOptions options_of(const NumberSet& set) {
    DataPathOptions options;
    options.ends = set.ends;
    options.delta = set.delta;
    options.set = set;
    options.projection = set.projection;
    return options;
}

DataPathOptions named_numbers(const std::string& name) {
    const std::vector<const char*>& names = arithmetic_names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        std::string known;
        for (const char* each : names) {
            known += (known.empty() ? "" : ", ") + std::string(each);
        }
        throw InputError("There are no numbers '" + name + "'; there are " + known + ".");
    }
    DataPathOptions options = options_of(number_set(name == "fp64" ? "ideal" : name));
    options.set.reset();
    options.numbers = static_cast<Arithmetic>(at - names.begin());
    return options;
}

DataPathOptions named_numbers(const std::string& name,
                              const std::vector<std::string>& assignments) {
    DataPathOptions options = named_numbers(name);
    const NumberSet set = number_set(name == "fp64" ? "ideal" : name, assignments);
    const bool same =
        std::all_of(assignments.begin(), assignments.end(), [](const std::string& assignment) {
            return assignment.rfind("projection=", 0) == 0;
        });
    if (!same) {
        return options_of(set);
    }
    options.projection = set.projection;
    return options;
}

} // namespace degs
