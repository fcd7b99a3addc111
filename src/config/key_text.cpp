// SPDX-License-Identifier: Apache-2.0
#include "config/key_text.hpp"

#include <cstring>

namespace degs {

void KeyText::see(const std::string& path, const std::string& value) {
    text_ += path + "=" + value + "\n";
}

void KeyText::real(const std::string& path, double& value, double /*low*/, double /*high*/,
                   const std::string& /*doc*/) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    see(path, std::to_string(bits));
}

} // namespace degs
