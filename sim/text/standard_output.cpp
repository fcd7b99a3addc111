// SPDX-License-Identifier: Apache-2.0
#include "sim/text/standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/visible_text.hpp"
#include "sim/process/failure.hpp"
#include "sim/text/output_columns.hpp"

namespace degs::sim {

void print(const std::string& text) {
    const std::string shown = visible_lines(shows_utf8() ? text : in_ascii(text));
    errno = 0;
    if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size() ||
        std::fflush(stdout) != 0) {
        throw FailureError({kUserError, "The standard output cannot be written: " +
                                            std::generic_category().message(errno) + "."});
    }
}

} // namespace degs::sim
