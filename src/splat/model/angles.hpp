// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180; ///< radians

} // namespace degs
