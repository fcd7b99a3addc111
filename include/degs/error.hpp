// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace degs {

/// A mistake of the user in a file, a configuration or on the command line: one full
/// sentence that names the place, the reason and what is allowed. One class is enough,
/// because its catchers only pass the sentence on; a type per room would have to be caught next
/// to this one everywhere.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& sentence) : std::runtime_error(sentence) {}
};

} // namespace degs
