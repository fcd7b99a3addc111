// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/svg.hpp"

#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr const char* kFonts = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// At most two decimals, without zeros at the end.
std::string number(double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.2f", value);
    std::string text = buffer;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + number(value) + "\"";
}

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}

/// Valid UTF-8, whatever came in: the JSON library replaces what is not.
std::string valid_utf8(const std::string& text) {
    const std::string quoted = dump_json(nlohmann::json(text));
    return parse_json(quoted).get<std::string>();
}

/// XML has no U+FFFE and U+FFFF, which become U+FFFD.
std::string without_non_characters(std::string text) {
    for (const char* none : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
        for (std::size_t at = text.find(none); at != std::string::npos; at = text.find(none, at)) {
            text[at + 2] = '\xbd';
        }
    }
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (char c : without_non_characters(valid_utf8(text))) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default: // XML has no control characters
            result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    }
    return result;
}

std::string joined(const Svg::Points& points) {
    std::string text;
    for (const auto& [x, y] : points) {
        text += (text.empty() ? "" : " ") + number(x) + "," + number(y);
    }
    return text;
}

/// See state_command().
std::string& stated() {
    static std::string command;
    return command;
}

} // namespace

void state_command(const std::string& command) {
    stated() = command;
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& fill) {
    body_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
             attribute("height", height) + attribute("fill", fill) + "/>\n";
}

void Svg::line(double x0, double y0, double x1, double y1, const std::string& colour,
               double width) {
    body_ += "<line" + attribute("x1", x0) + attribute("y1", y0) + attribute("x2", x1) +
             attribute("y2", y1) + attribute("stroke", colour) + attribute("stroke-width", width) +
             "/>\n";
}

void Svg::polyline(const Points& points, const std::string& colour, double width) {
    body_ += "<polyline" + attribute("points", joined(points)) + attribute("stroke", colour) +
             attribute("stroke-width", width) + " fill=\"none\" stroke-linejoin=\"round\"/>\n";
}

void Svg::marker(Marker shape, double x, double y, const std::string& colour) {
    const std::string paint =
        attribute("fill", colour) + " stroke=\"#ffffff\" stroke-width=\"1\"/>\n";
    constexpr double kSize = 5; // px from the centre
    switch (shape) {
    case Marker::Circle:
        body_ +=
            "<circle" + attribute("cx", x) + attribute("cy", y) + attribute("r", kSize) + paint;
        break;
    case Marker::Square:
        body_ += "<rect" + attribute("x", x - kSize + 0.5) + attribute("y", y - kSize + 0.5) +
                 attribute("width", 2 * kSize - 1) + attribute("height", 2 * kSize - 1) + paint;
        break;
    case Marker::Triangle:
        body_ += "<polygon" +
                 attribute("points", joined({{x, y - kSize - 1},
                                             {x + kSize + 0.5, y + kSize - 1},
                                             {x - kSize - 0.5, y + kSize - 1}})) +
                 paint;
        break;
    case Marker::Diamond:
        body_ += "<polygon" +
                 attribute("points", joined({{x, y - kSize - 1},
                                             {x + kSize + 1, y},
                                             {x, y + kSize + 1},
                                             {x - kSize - 1, y}})) +
                 paint;
        break;
    }
}

void Svg::text(double x, double y, const std::string& words, const TextStyle& style) {
    body_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("font-size", style.size) +
             attribute("fill", style.colour) + attribute("text-anchor", style.anchor) +
             (style.bold ? " font-weight=\"bold\"" : "") + ">" + escaped(words) + "</text>\n";
}

std::string Svg::document(double width, double height, const std::string& title) const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
           attribute("height", height) +
           attribute("viewBox", "0 0 " + number(width) + " " + number(height)) +
           attribute("font-family", kFonts) + " role=\"img\">\n<title>" + escaped(title) +
           "</title>\n" + (stated().empty() ? "" : "<desc>" + escaped(stated()) + "</desc>\n") +
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + body_ + "</svg>\n";
}

double text_width(const std::string& words, double size, bool bold) {
    return static_cast<double>(characters(words)) * size * (bold ? 0.6 : 0.56);
}

std::string fitting(const std::string& words, double size, double width) {
    if (text_width(words, size) <= width) {
        return words;
    }
    std::string kept; // from the front, because names may be long
    for (std::size_t at = 0; at < words.size();) {
        std::string next(1, words[at]);
        while (++at < words.size() && !starts_character(words[at])) {
            next += words[at];
        }
        if (text_width(kept + next + "…", size) > width) {
            break;
        }
        kept += next;
    }
    return kept + "…";
}

double tick_of(double value, int lines) {
    const double power = std::pow(10.0, std::floor(std::log10(value / lines)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power * lines >= value) {
            return factor * power;
        }
    }
    return 10 * power;
}

} // namespace degs::sim
