// SPDX-License-Identifier: Apache-2.0
// Logs of blocks against the naive blocks that follow them.
#pragma once

#include "tests/modules/degs/naive_slice.hpp"
#include "tests/modules/degs/naive_slicing.hpp"
#include "tests/modules/degs/naive_span.hpp"
#include "tests/modules/degs/scheduler/naive_log.hpp"

namespace degs::test {

/// The first message that a Slicing Unit, Span Unit or slice of the array takes or sends otherwise
/// than the naive one; empty if there is none. `block`: "slicing:0", for instance.
inline std::string naive_difference(const std::string& block,
                                    const std::map<std::string, std::int64_t>& facts,
                                    const std::vector<LoggedEvent>& events) {
    const std::string kind = block.substr(0, block.find(':'));
    const std::vector<std::string> naive = kind == "span"      ? NaiveSpan(facts, events).run()
                                           : kind == "slicing" ? NaiveSlicing(facts, events).run()
                                                               : NaiveSlice(facts, events).run();
    return first_difference(port_lines(events), naive);
}

} // namespace degs::test
