// SPDX-License-Identifier: Apache-2.0
#include "sim/text/warnings.hpp"

#include <algorithm>
#include <iostream>

#include "base/visible_text.hpp"

namespace degs::sim {

void add_warnings(std::vector<std::string>& all, const std::string& name,
                  const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) {
        std::string warning = name;
        warning.append(": ").append(sentence);
        if (std::find(all.begin(), all.end(), warning) == all.end()) {
            all.push_back(warning);
        }
    }
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        std::cerr << "degs: warning: " << visible(warning) << '\n';
    }
}

} // namespace degs::sim
