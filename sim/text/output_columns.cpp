// SPDX-License-Identifier: Apache-2.0
#include "sim/text/output_columns.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include <sys/ioctl.h>
#include <unistd.h>

#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kNarrowest = 20, kUsual = 80;

/// What COLUMNS says, or 0.
std::size_t columns_of_environment() {
    const char* const text = std::getenv("COLUMNS");
    std::size_t columns = 0;
    if (text != nullptr) {
        const std::string words = text;
        const auto [rest, error] =
            std::from_chars(words.data(), words.data() + words.size(), columns);
        if (error == std::errc::result_out_of_range && *rest == '\0') {
            return kUnlimited;
        }
        if (error != std::errc() || rest != words.data() + words.size()) {
            return 0;
        }
    }
    return columns;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool starts_with(const std::string& text, std::size_t at, const char* words) {
    return text.compare(at, std::char_traits<char>::length(words), words) == 0;
}

/// How well a line may break at the blank `at`: 2 at a separator, 1 between words, 0 not at all.
int worth_of_break(const std::string& line, std::size_t at) {
    if (starts_with(line, at, " · ") || starts_with(line, at, "  ")) {
        return 2;
    }
    if (at == 0 || at + 1 >= line.size() || line[at - 1] == ' ') {
        return 0;
    }
    const bool symbol_follows = starts_with(line, at + 1, "·");
    return is_digit(line[at - 1]) || symbol_follows ? 0 : 1;
}

/// Where the line breaks so that what stands before has at most `width` characters, if possible;
/// npos: nowhere. A separator is better than a blank between words.
std::size_t break_of(const std::string& line, std::size_t width, std::size_t indent) {
    constexpr std::size_t kNowhere = std::string::npos;
    std::size_t separator = kNowhere, blank = kNowhere, shown = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const bool found = separator != kNowhere || blank != kNowhere;
        if (shown > width && found) {
            break;
        }
        if (line[at] == ' ' && shown > indent) {
            const int worth = worth_of_break(line, at);
            separator = worth == 2 ? at : separator;
            blank = worth == 1 ? at : blank;
        }
        shown += starts_character(line[at]) ? 1 : 0;
    }
    return separator != kNowhere ? separator : blank;
}

std::string folded_line(std::string line, std::size_t width, std::size_t indent) {
    std::string lines;
    while (characters(line) > width) {
        const std::size_t at = break_of(line, width, indent);
        if (at == std::string::npos) {
            break;
        }
        lines += line.substr(0, at) + "\n";
        std::size_t next = at;
        while (next < line.size() && (line[next] == ' ' || starts_with(line, next, "· "))) {
            next += line[next] == ' ' ? 1 : std::char_traits<char>::length("·");
        }
        line = std::string(indent, ' ') + line.substr(next);
    }
    return lines + line;
}

} // namespace

std::size_t output_columns() {
    if (const std::size_t columns = columns_of_environment(); columns > 0) {
        return std::max(kNarrowest, columns);
    }
    if (::isatty(STDOUT_FILENO) == 0) {
        return kUnlimited;
    }
    winsize size{};
    const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col != 0;
    return known ? std::max<std::size_t>(kNarrowest, size.ws_col) : kUsual;
}

std::string folded(const std::string& text, std::size_t width, std::size_t indent) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        result += folded_line(text.substr(begin, end - begin), width, indent);
        result += end < text.size() ? "\n" : "";
        begin = end + 1;
    }
    return result;
}

bool shows_utf8() {
    for (const char* const name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const char* const value = std::getenv(name);
        if (value == nullptr || *value == '\0') {
            continue;
        }
        std::string locale = value;
        std::transform(locale.begin(), locale.end(), locale.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        return locale.find("utf-8") != std::string::npos ||
               locale.find("utf8") != std::string::npos;
    }
    return true;
}

std::string in_ascii(const std::string& text) {
    static const std::vector<std::pair<std::string, std::string>> symbols{
        {"×", "x"},   {"·", "-"}, {"²", "2"},  {"°", " deg"}, {"–", "-"},
        {"…", "..."}, {"µ", "u"}, {"≤", "<="}, {"≥", ">="},   {"→", "->"}};
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const auto symbol = std::find_if(symbols.begin(), symbols.end(), [&](const auto& known) {
            return text.compare(at, known.first.size(), known.first) == 0;
        });
        if (symbol == symbols.end()) {
            result += text[at++];
        } else {
            result += symbol->second;
            at += symbol->first.size();
        }
    }
    return result;
}

} // namespace degs::sim
