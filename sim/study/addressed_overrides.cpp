// SPDX-License-Identifier: Apache-2.0
#include "sim/study/addressed_overrides.hpp"

#include <algorithm>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

/// Empty if the override is for all.
std::string addressee(const std::string& text) {
    const std::string key = override_path(text);
    const std::size_t colon = key.find(':');
    return colon == std::string::npos ? "" : key.substr(0, colon);
}

} // namespace

std::string override_path(const std::string& override_text) {
    return override_text.substr(0, override_text.find('='));
}

std::vector<std::string> overrides_of(const std::string& name,
                                      const std::vector<std::string>& overrides) {
    std::vector<std::string> own;
    for (const std::string& text : overrides) {
        const std::string to = addressee(text);
        if (to.empty()) {
            own.push_back(text);
        } else if (to == name) {
            own.push_back(text.substr(to.size() + 1));
        }
    }
    return own;
}

void check_addressees(const std::vector<std::string>& overrides,
                      const std::vector<std::string>& names) {
    for (const std::string& text : overrides) {
        const std::string to = addressee(text);
        if (!to.empty() && std::find(names.begin(), names.end(), to) == names.end()) {
            std::string sentence = "--set ";
            sentence.append(text).append(" is for '").append(to);
            throw InputError(sentence.append("', but no configuration is called so."));
        }
    }
}

} // namespace degs::sim
