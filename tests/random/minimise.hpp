// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "tests/random/trial.hpp"

namespace degs::trials {

/// Drops changes, frames, Gaussians and pixels while `fails` holds, in at most `most` attempts.
Trial minimised(Trial trial, const std::function<bool(const Trial&)>& fails, int most);

} // namespace degs::trials
