// SPDX-License-Identifier: Apache-2.0
// The log of a bank in the lines of NaiveBank, to compare them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/modules/degs/scheduler/naive_bank.hpp"

namespace degs::test {

/// What the bank has taken, issued and sent.
inline std::vector<std::string> lines_of(const std::vector<LoggedEvent>& events) {
    NaiveLines lines;
    for (const LoggedEvent& e : events) {
        const auto now = static_cast<Number>(e.now);
        if (e.kind() == "span") {
            lines.say(now, "span", {e["port"], e["tile"], e["end"], e["splat"], e["row"]});
        } else if (e.kind() == "issue") {
            lines.say(now, "issue", {e["slot"], e["ready"], e["context"], e["domain"], e["mask"]});
        } else if (e.kind() == "over") {
            lines.say(now, "over", {e["tile"], e["context"]});
        } else if (e.kind() == "packet" && e["tasks"] == 0) {
            lines.say(now, "packet", {0, e["ended_tile"], e["ended_context"]});
        } else if (e.kind() == "packet") {
            const bool ends = e["ends_tile"] != 0;
            std::vector<Number> packet{e["tasks"], ends ? e["ended_tile"] : -1,
                                       ends ? e["ended_context"] : -1, e["slot"]};
            for (std::size_t run = 0; run < e.parts; ++run) { // all fields of TaskRun
                for (std::size_t field = 0; field < e.form->fields.back().parts.size(); ++field) {
                    packet.push_back(e.part(run, field));
                }
            }
            lines.say(now, "packet", packet);
        }
    }
    return lines.lines();
}

/// The first line in which two banks differ; empty if there is none.
inline std::string first_difference(const std::vector<std::string>& model,
                                    const std::vector<std::string>& naive) {
    for (std::size_t i = 0; i < std::max(model.size(), naive.size()); ++i) {
        const std::string a = i < model.size() ? model[i] : "nothing";
        const std::string b = i < naive.size() ? naive[i] : "nothing";
        if (a != b) {
            return "line " + std::to_string(i) + ": the model has \"" + a +
                   "\", the naive block \"" + b + "\"";
        }
    }
    return "";
}

} // namespace degs::test
