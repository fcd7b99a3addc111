// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs {

/// Message types of what degs::Accelerator reports through SC_REPORT, for sc_report_handler. The
/// description begins with the hierarchical name of the accelerator.
namespace reports {
constexpr const char* kConfig =
    "/DeGS/accelerator/config"; ///< error: problem() of the configuration
constexpr const char* kOptions = "/DeGS/accelerator/options";   ///< error or warning
constexpr const char* kClock = "/DeGS/accelerator/clock";       ///< error or warning
constexpr const char* kProtocol = "/DeGS/accelerator/protocol"; ///< error of an AT target
} // namespace reports

/// Reports an error, which throws sc_core::sc_report unless the platform has chosen other actions,
/// and then throws std::invalid_argument: what is refused is not built.
[[noreturn]] void refuse(const char* type, const std::string& who, const std::string& why);

} // namespace degs
