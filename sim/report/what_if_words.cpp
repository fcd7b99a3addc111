// SPDX-License-Identifier: Apache-2.0
#include "sim/report/what_if_words.hpp"

#include <cstdint>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

using nlohmann::ordered_json;

ordered_json what_if_json(const std::vector<WhatIf>& list) {
    ordered_json json = ordered_json::array();
    for (const WhatIf& each : list) {
        json.push_back({{"set", each.change},
                        {"estimated_before", each.cycles_before},
                        {"estimated_after", each.cycles_after},
                        {"change", each.share()},
                        {"change_interval",
                         {each.share() - each.half_width(), each.share() + each.half_width()}}});
    }
    return json;
}

std::string what_if_text(const std::vector<WhatIf>& list) {
    if (list.empty()) {
        return "";
    }
    const auto cycles = [](double value) { return grouped(static_cast<std::uint64_t>(value)); };
    TextTable table({"what if, estimated", "cycles before", "after", "change %"});
    for (const WhatIf& each : list) {
        table.add({visible(each.change), cycles(each.cycles_before), cycles(each.cycles_after),
                   (each.share() > 0 ? "+" : "") + percent(each.share()) + " ±" +
                       percent(each.half_width())});
    }
    return "\n" + table.text();
}

} // namespace degs::sim
