// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace degs {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1 << 20;
constexpr std::size_t kMaxLine = 4096;
constexpr std::size_t kMaxProperties = 4096;
constexpr std::size_t kMaxElements = 64;

constexpr std::array<std::size_t, 8> kTypeBytes{1, 1, 2, 2, 4, 4, 4, 8};
constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames{{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::UInt8},
    {"uint8", PlyType::UInt8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::UInt16},
    {"uint16", PlyType::UInt16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::UInt32},
    {"uint32", PlyType::UInt32},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
    constexpr std::string_view kBlank = " \t\r";
    Words words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(kBlank);
        if (begin == std::string_view::npos) {
            return words;
        }
        line.remove_prefix(begin);
        const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

class HeaderParser {
public:
    explicit HeaderParser(InputFile& file) : file_(file) {
        text_.resize(std::min<std::uint64_t>(file.remaining(), kMaxHeaderBytes));
        file.read_exactly(text_.data(), text_.size());
        find_line_end();
    }

    PlyHeader parse() {
        if (const Words magic = next_line(); magic != Words{"ply"}) {
            fail_file(
                file_.path(),
                std::string("this is not a PLY file; its first line must be 'ply'") +
                    (text_.rfind(kByteOrderMark, 0) == 0 ? ", without a byte order mark." : "."));
        }
        parse_format(next_line());
        while (true) {
            const Words words = next_line();
            if (words == Words{"end_header"}) {
                break;
            }
            parse_statement(words);
        }
        header_.data_begin = cursor_;
        file_.seek(cursor_);
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& sentence) const {
        fail_file(file_.path(), "line " + std::to_string(line_) + " of the header: " + sentence);
    }

    /// What ends the first line ends all of them. The CR of CRLF counts as a blank, but the one of
    /// LFCR must not be taken for the first byte of the data.
    void find_line_end() {
        constexpr const char* kBreaks = "\r\n";
        const std::size_t begin = std::min(text_.find_first_of(kBreaks), text_.size());
        const std::size_t end = std::min(text_.find_first_not_of(kBreaks, begin), text_.size());
        const std::string_view breaks = std::string_view(text_).substr(begin, end - begin);
        reversed_ = breaks == "\n\r";
        line_end_ = !breaks.empty() && breaks.find('\n') == std::string_view::npos ? '\r' : '\n';
    }

    std::string_view raw_line() {
        const std::string_view rest = std::string_view(text_).substr(cursor_);
        const std::size_t end = std::min(rest.find(line_end_), rest.size());
        ++line_;
        if (end > kMaxLine) {
            fail("the line is longer than the " + std::to_string(kMaxLine) +
                 " characters allowed; perhaps this is no PLY file.");
        }
        if (rest.empty()) {
            fail_file(file_.path(), "the PLY header is not closed by 'end_header' within " +
                                        std::to_string(text_.size()) +
                                        " bytes; the file is truncated or not a PLY file.");
        }
        const bool skip = reversed_ && end + 1 < rest.size() && rest[end + 1] == '\r';
        cursor_ += std::min(end + (skip ? 2 : 1), rest.size());
        return rest.substr(0, end);
    }

    /// The words of the next line that is neither empty nor a comment.
    Words next_line() {
        while (true) {
            Words words = split(raw_line());
            if (!words.empty() && words[0] != "comment" && words[0] != "obj_info") {
                return words;
            }
            if (words.size() > 1 && words[0] == "comment") {
                keep_comment(words);
            }
        }
    }

    /// With one blank between its words.
    void keep_comment(const Words& words) {
        std::string text(words[1]);
        for (std::size_t i = 2; i < words.size(); ++i) {
            text += ' ';
            text += words[i];
        }
        header_.comments.push_back(std::move(text));
    }

    void parse_format(const Words& words) {
        constexpr std::array<std::string_view, 3> kFormats{"ascii", "binary_little_endian",
                                                           "binary_big_endian"};
        const auto* const name = words.size() == 3
                                     ? std::find(kFormats.begin(), kFormats.end(), words[1])
                                     : kFormats.end();
        if (name == kFormats.end() || words[0] != "format" || words[2] != "1.0") {
            fail("here must stand 'format', one of ascii, binary_little_endian or "
                 "binary_big_endian, and '1.0'.");
        }
        header_.format = static_cast<PlyFormat>(name - kFormats.begin());
    }

    void parse_statement(const Words& words) {
        if (words[0] == "element") {
            parse_element(words);
        } else if (words[0] == "property") {
            parse_property(words);
        } else {
            fail(in_quotes(words[0]) +
                 " is unknown; allowed are element, property, comment, obj_info "
                 "and end_header.");
        }
    }

    void parse_element(const Words& words) {
        PlyElement element;
        if (words.size() != 3) {
            fail("an element needs a name and a count.");
        }
        const char* const end = words[2].data() + words[2].size();
        const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
        if (error != std::errc() || stop != end) {
            fail("the count " + in_quotes(words[2]) + " of element " + in_quotes(words[1]) +
                 " is not an integer from 0 to 18446744073709551615.");
        }
        element.name = words[1];
        if (header_.find(element.name) != nullptr) {
            fail("element " + in_quotes(words[1]) + " is declared twice.");
        }
        header_.elements.push_back(std::move(element));
        if (header_.elements.size() > kMaxElements) {
            fail("more than " + std::to_string(kMaxElements) + " elements are not allowed.");
        }
    }

    void parse_property(const Words& words) {
        if (header_.elements.empty()) {
            fail("a property stands before the first element.");
        }
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) {
            fail("a property is 'property TYPE NAME' or 'property list COUNT_TYPE TYPE NAME'.");
        }
        PlyProperty property{std::string(words.back()), type_named(words[words.size() - 2]), {}};
        if (is_list) {
            property.list_count = type_named(words[2]);
            if (!is_integer(*property.list_count)) {
                fail("the length of list " + in_quotes(property.name) +
                     " must have an integer type.");
            }
        }
        if (header_.elements.back().has(property.name)) {
            fail("property " + in_quotes(property.name) + " is declared twice.");
        }
        if (++properties_ > kMaxProperties) {
            fail("more than " + std::to_string(kMaxProperties) + " properties are not allowed.");
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type_named(std::string_view name) const {
        for (const auto& [known, type] : kTypeNames) {
            if (name == known) {
                return type;
            }
        }
        fail("type " + in_quotes(name) +
             " is unknown; allowed are char, uchar, short, ushort, int, uint, float, double and "
             "int8, uint8, int16, uint16, int32, uint32, float32, float64.");
    }

    InputFile& file_;
    std::string text_;
    std::size_t cursor_ = 0;
    std::size_t line_ = 0;
    char line_end_ = '\n';
    bool reversed_ = false; ///< lines end with LF and CR, in this order
    std::size_t properties_ = 0;
    PlyHeader header_;
};

} // namespace

std::size_t size_of(PlyType type) {
    return kTypeBytes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) {
    return type != PlyType::Float32 && type != PlyType::Float64;
}

bool PlyElement::has(const std::string& property) const {
    return std::any_of(properties.begin(), properties.end(),
                       [&](const PlyProperty& p) { return p.name == property; });
}

bool PlyElement::has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& p) { return p.list_count.has_value(); });
}

std::uint64_t PlyElement::minimum_row_bytes(PlyFormat format) const {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : properties) {
        bytes +=
            format == PlyFormat::Ascii ? 2 : size_of(property.list_count.value_or(property.type));
    }
    return bytes;
}

const PlyElement* PlyHeader::find(const std::string& element) const {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [&](const PlyElement& e) { return e.name == element; });
    return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(InputFile& file) {
    return HeaderParser(file).parse();
}

void check_claimed_size(const std::string& path, const PlyElement& element, PlyFormat format,
                        std::uint64_t remaining) {
    const std::uint64_t row = element.minimum_row_bytes(format);
    // The last value of an ASCII file needs no separator behind it.
    const std::uint64_t available = remaining + (format == PlyFormat::Ascii ? 1 : 0);
    if (row != 0 && element.count > available / row) {
        fail_file(path, "the header promises " + std::to_string(element.count) +
                            " rows of element " + in_quotes(element.name) + " of at least " +
                            std::to_string(row) + " bytes each, but only " +
                            std::to_string(remaining) +
                            " bytes follow; the file is truncated or its header is wrong.");
    }
}

} // namespace degs
