// SPDX-License-Identifier: Apache-2.0
#include "sim/serve/request.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs::sim {
namespace {

void refuse_unknown_keys(const nlohmann::json& object) {
    const std::vector<std::string> known{"id", "arguments", "folder", "stop"};
    for (const auto& entry : object.items()) {
        if (std::find(known.begin(), known.end(), entry.key()) == known.end()) {
            const std::string meant = config_words::nearest(entry.key(), known);
            throw InputError(
                "The key " + config_words::quote(entry.key()) + " of the request is unknown" +
                (meant.empty() ? "" : ", did you mean " + config_words::quote(meant) + "?") +
                " (allowed: " + config_words::list(known) + ").");
        }
    }
}

std::string id_of(const nlohmann::json& object) {
    const auto id = object.find("id");
    if (id == object.end() || !(id->is_number_integer() || id->is_string())) {
        throw InputError("A request needs an 'id', an integer or a text, which its answers carry.");
    }
    return dump_json(*id);
}

/// A text that a command line or the name of a folder can hold.
std::string text_of(const nlohmann::json& value, const char* what) {
    if (!value.is_string()) {
        throw InputError(std::string(what) + " of the request must be a text in quotes.");
    }
    std::string text = value.get<std::string>();
    if (text.find('\0') != std::string::npos) {
        throw InputError(std::string(what) +
                         " of the request holds a zero, which no command line can.");
    }
    return text;
}

std::vector<std::string> arguments_of(const nlohmann::json& object) {
    const auto list = object.find("arguments");
    if (list == object.end() || !list->is_array()) {
        throw InputError("A request needs 'arguments', a list of the words behind 'degs'.");
    }
    std::vector<std::string> words;
    for (const nlohmann::json& word : *list) {
        words.push_back(text_of(word, "An argument"));
    }
    return words;
}

void read(const nlohmann::json& object, Request& request) {
    if (!object.is_object()) {
        throw InputError("A request is an object of JSON on one line, as in {\"id\": 1, "
                         "\"arguments\": [\"help\", \"run\"]}.");
    }
    request.id = id_of(object);
    refuse_unknown_keys(object);
    if (const auto stop = object.find("stop"); stop != object.end()) {
        request.stop = stop->is_boolean() && stop->get<bool>();
        if (!request.stop || object.size() > 2) {
            throw InputError("A request with 'stop' is {\"id\": ID, \"stop\": true}, and ends the "
                             "request with this id.");
        }
        return;
    }
    request.arguments = arguments_of(object);
    if (const auto folder = object.find("folder"); folder != object.end()) {
        request.folder = text_of(*folder, "The folder");
    }
}

std::string line_of(const nlohmann::ordered_json& rest, const std::string& id) {
    return "{\"id\":" + id + "," + dump_json(rest).substr(1) + "\n";
}

} // namespace

Request read_request(const std::string& line) {
    Request request;
    try {
        read(parse_json(line), request);
    } catch (const InputError& error) {
        request.mistake = error.what();
    }
    return request;
}

std::string said_line(const std::string& id, const std::string& text) {
    return line_of({{"said", text}}, id);
}

std::string ended_line(const std::string& id, int code, const std::string& printed) {
    return line_of({{"code", code}, {"printed", printed}}, id);
}

} // namespace degs::sim
