// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs {

/// Reports an error of a type of messages.hpp, which throws sc_core::sc_report unless the platform
/// has chosen other actions, and then throws std::invalid_argument: what is refused is not built.
[[noreturn]] void refuse(const char* type, const std::string& who, const std::string& why);

} // namespace degs
