// SPDX-License-Identifier: Apache-2.0
#include "config/key_text.hpp"

#include <cstring>

namespace degs {

void KeyText::add(const std::string& path, const std::string& value) {
    text_ += path + "=" + value + "\n";
}

void KeyText::integer(const std::string& path, std::int64_t& value, std::int64_t /*low*/,
                      std::int64_t /*high*/, const std::string& /*doc*/) {
    add(path, std::to_string(value));
}

// By its bits, which no rounding makes equal.
void KeyText::real(const std::string& path, double& value, double /*low*/, double /*high*/,
                   const std::string& /*doc*/) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(path, std::to_string(bits));
}

void KeyText::boolean(const std::string& path, bool& value, const std::string& /*doc*/) {
    add(path, value ? "true" : "false");
}

void KeyText::text(const std::string& path, std::string& value, const std::string& /*doc*/) {
    add(path, value);
}

void KeyText::choice(const std::string& path, int& value, const std::vector<std::string>& names,
                     const std::string& /*doc*/) {
    add(path, names[value]);
}

} // namespace degs
