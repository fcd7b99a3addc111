// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/head_reader.hpp"

#include <algorithm>
#include <utility>

#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

HeadReader::HeadReader(std::string path, std::string place, const nlohmann::json& json)
    : path_(std::move(path)), place_(std::move(place)), json_(&json) {}

void HeadReader::refuse(const std::string& allowed) const {
    const std::string found = json_->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    fail_file(path_, "'" + place_ + "' of its head is " + in_quotes(found) + "; allowed is " +
                         allowed + ".");
}

HeadReader HeadReader::value(const std::string& name) const {
    const std::string place = place_.empty() ? name : place_ + "." + name;
    if (!json_->is_object()) {
        refuse("an object");
    }
    const auto found = json_->find(name);
    if (found == json_->end()) {
        fail_file(path_, "its head has no '" + place + "'; every key of a workload is needed.");
    }
    return {path_, place, *found};
}

void HeadReader::check(const std::string& name, bool good, const std::string& sentence) const {
    if (!good) {
        fail_file(path_, "'" + value(name).place_ + "' of its head " + sentence + ".");
    }
}

bool HeadReader::has(const std::string& name) const {
    return json_->is_object() && json_->contains(name);
}

HeadReader HeadReader::part(const std::string& name) const {
    return value(name);
}

std::vector<HeadReader> HeadReader::list(const std::string& name) const {
    const HeadReader all = value(name);
    if (!all.json_->is_array()) {
        all.refuse("a list");
    }
    std::vector<HeadReader> list;
    for (const nlohmann::json& entry : *all.json_) {
        list.emplace_back(path_, all.place_ + "[" + std::to_string(list.size()) + "]", entry);
    }
    return list;
}

std::string HeadReader::text(const std::string& name) const {
    const HeadReader found = value(name);
    if (!found.json_->is_string()) {
        found.refuse("a text");
    }
    return found.json_->get<std::string>();
}

std::size_t HeadReader::text(const std::string& name,
                             const std::vector<const char*>& allowed) const {
    const std::string found = text(name);
    const auto at = std::find(allowed.begin(), allowed.end(), found);
    if (at == allowed.end()) {
        std::string words;
        for (const char* word : allowed) {
            words += (words.empty() ? "" : " or ") + std::string(word);
        }
        value(name).refuse(words);
    }
    return static_cast<std::size_t>(at - allowed.begin());
}

std::vector<std::string> HeadReader::texts(const std::string& name) const {
    std::vector<std::string> texts;
    for (const HeadReader& entry : list(name)) {
        if (!entry.json_->is_string()) {
            entry.refuse("a text");
        }
        texts.push_back(entry.json_->get<std::string>());
    }
    return texts;
}

bool HeadReader::flag(const std::string& name) const {
    const HeadReader found = value(name);
    if (!found.json_->is_boolean()) {
        found.refuse("true or false");
    }
    return found.json_->get<bool>();
}

int HeadReader::number(const std::string& name, int least, int most) const {
    const HeadReader found = value(name);
    const nlohmann::json& json = *found.json_;
    const bool fits =
        json.is_number_integer() &&
        (json.is_number_unsigned() ? json.get<std::uint64_t>() <= static_cast<std::uint64_t>(most)
                                   : json.get<std::int64_t>() <= most) &&
        json.get<std::int64_t>() >= least;
    if (!fits) {
        found.refuse("a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
    }
    return json.get<int>();
}

std::uint64_t HeadReader::count(std::uint64_t least, std::uint64_t most) const {
    const bool fits = json_->is_number_unsigned() && json_->get<std::uint64_t>() >= least &&
                      json_->get<std::uint64_t>() <= most;
    if (!fits) {
        refuse("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return json_->get<std::uint64_t>();
}

std::uint64_t HeadReader::count(const std::string& name, std::uint64_t least,
                                std::uint64_t most) const {
    return value(name).count(least, most);
}

double HeadReader::real(double least, double most) const {
    if (!json_->is_number() || !(json_->get<double>() >= least && json_->get<double>() <= most)) {
        refuse("a number from " + decimal_text(least) + " to " + decimal_text(most));
    }
    return json_->get<double>();
}

double HeadReader::real(const std::string& name, double least, double most) const {
    return value(name).real(least, most);
}

glm::dvec3 HeadReader::vector() const {
    constexpr double kMost = 1e300;
    if (!json_->is_array() || json_->size() != 3) {
        refuse("a list of three numbers");
    }
    glm::dvec3 vector;
    for (int axis = 0; axis < 3; ++axis) {
        const HeadReader entry(path_, place_ + "[" + std::to_string(axis) + "]", (*json_)[axis]);
        vector[axis] = entry.real(-kMost, kMost);
    }
    return vector;
}

NumberFormat HeadReader::format(const std::string& name) const {
    const std::string found = text(name);
    try {
        return parse_format(found);
    } catch (const InputError&) {
        value(name).refuse("the name of a number format, such as fp32");
    }
}

} // namespace degs::sim
