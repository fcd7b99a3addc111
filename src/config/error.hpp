// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace degs {

/// A mistake of the user (file, configuration, scene): one full sentence that names the place,
/// the reason and what is allowed. Caught once, in sim/.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& sentence) : std::runtime_error(sentence) {}
};

} // namespace degs
