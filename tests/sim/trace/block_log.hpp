// SPDX-License-Identifier: Apache-2.0
// Logs of blocks, written by the program and read again.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/sim/process/child.hpp"
#include "tests/tlm/event_reader.hpp"

namespace degs::sim_test {

struct BlockLog {
    nlohmann::json about;
    std::unique_ptr<std::vector<EventLog::Kind>> kinds; ///< events point at them
    std::vector<degs::test::LoggedEvent> events;

    std::map<std::string, std::int64_t> facts() const {
        return about["facts"].get<std::map<std::string, std::int64_t>>();
    }
    std::size_t count(const std::string& kind) const {
        return std::count_if(events.begin(), events.end(),
                             [&](const auto& event) { return event.kind() == kind; });
    }
};

inline BlockLog read_log(const std::string& path) {
    const std::string text = read_file(path);
    const std::size_t end = text.find('\n');
    BlockLog log{nlohmann::json::parse(text.substr(0, end)),
                 std::make_unique<std::vector<EventLog::Kind>>(),
                 {}};
    for (const nlohmann::json& kind : log.about["events"]) {
        log.kinds->push_back({kind["name"], {}});
        for (const nlohmann::json& field : kind["fields"]) {
            const bool list = !field.is_string();
            log.kinds->back().fields.push_back(
                list ? EventLog::Field{field.begin().key(),
                                       field.begin().value().get<std::vector<std::string>>()}
                     : EventLog::Field{field, {}});
        }
    }
    const std::string bytes = text.substr(end + 1);
    EXPECT_EQ(log.about["bytes"], bytes.size());
    log.events = degs::test::events_of(*log.kinds, bytes);
    return log;
}

inline BlockLog logged(const std::vector<std::string>& view, const std::string& design,
                       const std::string& block) {
    const Folder folder;
    std::vector<std::string> arguments{"run", config(design)};
    arguments.insert(arguments.end(), view.begin(), view.end());
    for (const std::string& word :
         {std::string("--no-reference"), std::string("--array-only"), std::string("--out"),
          folder / "out", std::string("--block-log"), block, folder / "log"}) {
        arguments.push_back(word);
    }
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_log(folder / "log");
}

} // namespace degs::sim_test
