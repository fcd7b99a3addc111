// SPDX-License-Identifier: Apache-2.0
#include "stats/statistics_document.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/number_json.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

using nlohmann::ordered_json;

class StatisticLister : public StatsVisitor {
public:
    explicit StatisticLister(bool all) : all_(all) {}
    void begin_section(const std::string& name, const std::string& sentence) override {
        open_.push_back(path(name));
        list.push_back({open_.back(), "", sentence, true, {}});
    }
    void end_section() override { open_.pop_back(); }
    void statistic(const StatDoc& doc, const StatValue& value) override {
        list.push_back({path(doc.name), doc.unit, doc.sentence, false, value});
    }
    bool wants(bool exists) const override { return exists || all_; }
    std::vector<Statistic> list;

private:
    std::string path(const std::string& name) const {
        return config_words::join_path(open_.back(), name);
    }
    bool all_;
    std::vector<std::string> open_{""};
};

struct ValueJson {
    ordered_json operator()(std::monostate) const { return {}; }
    ordered_json operator()(double value) const { return number_json(value); }
    template <class Value>
    ordered_json operator()(const Value& value) const {
        return value;
    }
};

ordered_json::json_pointer pointer(std::string path) {
    std::replace(path.begin(), path.end(), '.', '/');
    return ordered_json::json_pointer("/" + path);
}

/// "stages.span.rows" is in "stages.span"; everything is in the whole.
bool is_in(const std::string& path, const std::string& section) {
    return section.empty() || path.rfind(section + ".", 0) == 0;
}

/// Names under which several sections may share a statistic: "stages.*.busy" for
/// "stages.span.busy". The first and the last word stay.
std::vector<std::string> shared_names(const std::string& path) {
    std::vector<std::string> names;
    for (std::size_t at = path.find('.'); at != std::string::npos;) {
        const std::size_t end = path.find('.', at + 1);
        if (end != std::string::npos) {
            names.push_back(path.substr(0, at) + ".*" + path.substr(end));
        }
        at = end;
    }
    return names;
}

[[noreturn]] void fail_unknown(const std::vector<Statistic>& list, const std::string& path) {
    std::vector<std::string> names;
    names.reserve(list.size());
    for (const Statistic& row : list) {
        names.push_back(row.path);
    }
    const std::string near = config_words::nearest(path, names);
    throw InputError("There is no statistic " + config_words::quote(path) +
                     (near.empty() ? "; 'degs config --stats' lists them."
                                   : " (did you mean '" + near + "'?)."));
}

/// `text` in lines of at most 80 characters where words permit, behind `indent`.
std::string wrapped(const std::string& text, const std::string& indent) {
    constexpr std::size_t kColumns = 80;
    std::string lines;
    std::string line;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!line.empty() && indent.size() + line.size() + 1 + word.size() > kColumns) {
            lines += indent + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return line.empty() ? lines : lines + indent + line + "\n";
}

/// The place of what a family has in common: before its members.
std::vector<Statistic>::iterator shared_place(std::vector<Statistic>& list,
                                              const std::string& shared) {
    const std::string family = shared.substr(0, shared.find(".*"));
    const auto common = [&family](const Statistic& row) {
        return row.path == family || is_in(row.path, family + ".*");
    };
    return std::find_if(list.rbegin(), list.rend(), common).base();
}

std::vector<Statistic> listed(const DescribeStats& describe, bool all) {
    StatisticLister statistic_lister(all);
    describe(statistic_lister);
    return std::move(statistic_lister.list);
}

} // namespace

std::vector<Statistic> list_statistics(const DescribeStats& describe) {
    return listed(describe, false);
}

std::vector<Statistic> document_statistics(const DescribeStats& describe) {
    return listed(describe, true);
}

ordered_json statistics_json(const std::vector<Statistic>& list) {
    ordered_json json = ordered_json::object();
    for (const Statistic& row : list) {
        json[pointer(row.path)] =
            row.section ? ordered_json::object() : std::visit(ValueJson{}, row.value);
    }
    return json;
}

const Statistic& find_statistic(const std::vector<Statistic>& list, const std::string& path) {
    const auto found = std::find_if(list.begin(), list.end(), [&path](const Statistic& row) {
        return row.path == path && !row.section;
    });
    if (found == list.end()) {
        fail_unknown(list, path);
    }
    return *found;
}

std::vector<Statistic> statistics_in(const std::vector<Statistic>& list, const std::string& path) {
    std::vector<Statistic> part;
    for (const Statistic& row : list) {
        if (row.path == path || is_in(row.path, path)) {
            part.push_back(row);
        }
    }
    if (part.empty()) {
        fail_unknown(list, path);
    }
    return part;
}

std::vector<Statistic> shared_once(const std::vector<Statistic>& list) {
    using Meaning = std::pair<std::string, std::string>; // shared name and sentence
    std::map<Meaning, int> users;
    for (const Statistic& row : list) {
        for (const std::string& name : shared_names(row.path)) {
            ++users[{name, row.sentence}];
        }
    }
    std::set<Meaning> seen;
    std::vector<Statistic> once;
    for (const Statistic& row : list) {
        const std::vector<std::string> names = shared_names(row.path);
        const auto shared = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
            return users[{name, row.sentence}] > 1;
        });
        if (shared == names.end()) {
            once.push_back(row);
        } else if (seen.insert({*shared, row.sentence}).second) {
            Statistic common = row;
            common.path = *shared;
            once.insert(shared_place(once, *shared), common);
        }
    }
    return once;
}

std::string statistics_markdown(const std::vector<Statistic>& list, const std::string& section) {
    std::string table = "| Key | Unit | Meaning |\n|---|---|---|\n";
    for (const Statistic& row : list) {
        const std::string key = is_in(row.path, section) && !section.empty()
                                    ? row.path.substr(section.size() + 1)
                                    : row.path;
        if (!row.section) {
            table += "| `" + config_words::markdown_cell(key) + "` | " +
                     config_words::markdown_cell(row.unit) + " | " +
                     config_words::markdown_cell(row.sentence) + " |\n";
        }
    }
    return table;
}

std::string statistics_text(const std::vector<Statistic>& list) {
    std::string text;
    bool after_section = true; // sections without statistics of their own follow closely
    for (const Statistic& row : list) {
        const std::string sentence = row.sentence.empty() ? "" : ": " + row.sentence;
        if (row.section) {
            text += (after_section ? "" : "\n") + wrapped(row.path + sentence, "");
        } else {
            text += row.path + (row.unit.empty() ? "" : " [" + row.unit + "]") + "\n" +
                    wrapped(row.sentence, "    ");
        }
        after_section = row.section;
    }
    return text;
}

} // namespace degs
