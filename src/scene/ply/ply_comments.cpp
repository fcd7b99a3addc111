// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_comments.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/visible_text.hpp"

namespace degs {
namespace {

std::string trimmed(const std::string& text) {
    constexpr const char* kBlanks = " \t:=";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin == std::string::npos
               ? ""
               : text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// What stands behind `key` in the last comment that begins with it.
std::optional<std::string> last_value(const std::vector<std::string>& comments,
                                      const std::string& key) {
    std::optional<std::string> value;
    for (const std::string& comment : comments) {
        const std::string text = lower(trimmed(comment));
        if (text.rfind(key, 0) == 0) {
            value = trimmed(text.substr(key.size()));
        }
    }
    return value;
}

} // namespace

void read_ply_comments(const std::vector<std::string>& comments, SceneContent& content) {
    if (const auto mode = last_value(comments, "splatrendermode")) {
        take_render_model("SplatRenderMode", *mode, content);
    }
    if (const auto antialiased = last_value(comments, "antialiased")) {
        if (*antialiased == "1" || *antialiased == "true") {
            content.traits.antialiased = true;
        } else if (*antialiased == "0" || *antialiased == "false") {
            content.traits.antialiased = false;
        }
    }
    const auto vertical = last_value(comments, "vertical axis");
    if (vertical && !vertical->empty()) {
        content.notes.push_back("The comment 'Vertical axis: " + visible(vertical->substr(0, 40)) +
                                "' was passed over: axes stay as they are in the file; '?axes=' "
                                "behind its name turns them.");
    }
}

} // namespace degs
