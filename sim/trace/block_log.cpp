// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/block_log.hpp"

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/files/output_file.hpp"
#include "sim/trace/trace_options.hpp"

namespace degs::sim {

namespace {

std::string block_log_text(const std::string& design, const std::string& block,
                           const EventLog& log) {
    nlohmann::ordered_json header;
    header["format"] = "degs-block-log";
    header["version"] = 1;
    header["design"] = design;
    header["block"] = block;
    for (const auto& [name, value] : log.facts()) {
        header["facts"][name] = value;
    }
    for (const EventLog::Kind& kind : log.kinds()) {
        nlohmann::ordered_json fields = nlohmann::ordered_json::array();
        for (const EventLog::Field& field : kind.fields) {
            if (field.parts.empty()) {
                fields.push_back(field.name);
            } else {
                fields.push_back({{field.name, field.parts}});
            }
        }
        header["events"].push_back({{"name", kind.name}, {"fields", fields}});
    }
    header["bytes"] = log.bytes().size();
    return dump_json(header) + "\n" + log.bytes();
}

} // namespace

void check_block_log(const BlockLogRequest& request) {
    claim_output(request.file());
}

void write_block_log(const std::string& design, const BlockLogRequest& request,
                     const EventLog& log) {
    write_whole(request.file(), block_log_text(design, request.block(), log));
}

} // namespace degs::sim
