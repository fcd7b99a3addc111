// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Message types of what degs::Accelerator reports through SC_REPORT, for sc_report_handler. The
/// description begins with the hierarchical name of the accelerator. After an error, which throws
/// sc_core::sc_report unless the platform has chosen other actions, the constructor or function
/// throws std::invalid_argument: what is refused is not built, and changes nothing.
namespace degs::reports {

constexpr const char* kConfig = "/DeGS/accelerator/config";     ///< error: a rule of the design
constexpr const char* kOptions = "/DeGS/accelerator/options";   ///< error or warning
constexpr const char* kClock = "/DeGS/accelerator/clock";       ///< error or warning
constexpr const char* kPower = "/DeGS/accelerator/power";       ///< error: an operating point
constexpr const char* kProtocol = "/DeGS/accelerator/protocol"; ///< error of an AT target

} // namespace degs::reports
