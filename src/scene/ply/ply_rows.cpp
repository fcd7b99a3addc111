// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_rows.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "base/byte_order.hpp"
#include "scene/ply/ply_values.hpp"

namespace degs {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// Decimal text of any magnitude. Through long double, so that 1e-400 is 0 and 1e400 is infinite
/// (and dropped later, with a count) and not a syntax error.
std::optional<double> parse_number(std::string_view text) {
    const char* begin = text.data();
    const char* const end = begin + text.size();
    begin += text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
    double value = 0;
    auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc::result_out_of_range) {
        long double wide = 0;
        error = std::from_chars(begin, end, wide).ec;
        value = static_cast<double>(wide);
    }
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

} // namespace

bool PlyWords::peek(char& c) {
    if (begin_ == end_) {
        begin_ = 0;
        end_ = file_->read_some(buffer_.data(), buffer_.size());
        if (end_ == 0) {
            return false;
        }
    }
    c = buffer_[begin_];
    return true;
}

std::string_view PlyWords::next() {
    std::size_t length = 0;
    for (char c = 0; peek(c); ++begin_) {
        if (!is_blank(c)) {
            if (length == word_.size()) {
                fail_file(file_->path(), "a value of the ASCII body is longer than " +
                                             std::to_string(kMaxWord) + " characters.");
            }
            word_[length++] = c;
        } else if (length > 0) {
            break;
        } else {
            line_ += c == '\n' || c == '\r' ? 1 : 0;
        }
    }
    return {word_.data(), length};
}

bool PlyWords::at_end() {
    for (char c = 0; peek(c); ++begin_) {
        if (!is_blank(c)) {
            return false;
        }
        line_ += c == '\n' || c == '\r' ? 1 : 0;
    }
    return true;
}

PlyRows::PlyRows(InputFile& file, const PlyHeader& header, const PlyElement& element)
    : file_(&file), header_(&header), next_(header.elements.data()), format_(header.format),
      words_(file) {
    swap_ =
        format_ != PlyFormat::Ascii && (format_ == PlyFormat::BigEndian) != host_is_big_endian();
    move_to(element);
}

void PlyRows::move_to(const PlyElement& later) {
    skip_to(&later);
    check_size(later);
    next_ = &later + 1;
    element_ = current_ = &later;
    row_ = 0;
    lay_out();
}

void PlyRows::skip_to(const PlyElement* end) {
    for (; next_ != end; ++next_) {
        check_size(*next_);
        skip_element(*next_);
    }
}

void PlyRows::finish() {
    const std::uint64_t at = file_->size() - words_.remaining(); // binary files have no words
    const PlyElement* const end = header_->elements.data() + header_->elements.size();
    if (words_.remaining() > 0 && !(format_ == PlyFormat::Ascii && words_.at_end())) {
        skip_to(end);
    }
    std::uint64_t left = format_ == PlyFormat::Ascii ? 0 : file_->remaining();
    while (format_ == PlyFormat::Ascii && !words_.next().empty()) {
        ++left;
    }
    if (left > 0) {
        fail_file(file_->path(),
                  std::to_string(left) + (format_ == PlyFormat::Ascii ? " value(s)" : " byte(s)") +
                      " are left over behind its last element " + in_quotes(end[-1].name) +
                      " (the rows read end at byte " + std::to_string(at) + " of " +
                      std::to_string(file_->size()) + ")" +
                      "; the header and the data do not agree, so that all values may be misread.");
    }
}

void PlyRows::lay_out() {
    columns_.clear();
    row_bytes_ = 0;
    for (const PlyProperty& property : element_->properties) {
        const PlyType type = format_ == PlyFormat::Ascii ? PlyType::Float64 : property.type;
        columns_.push_back({type, row_bytes_});
        row_bytes_ += property.list_count ? 0 : size_of(type);
    }
}

PlyColumn PlyRows::column(const std::string& property) const {
    const auto found = std::find_if(element_->properties.begin(), element_->properties.end(),
                                    [&](const PlyProperty& p) { return p.name == property; });
    return columns_.at(found - element_->properties.begin());
}

void PlyRows::read(char* destination, std::size_t count) {
    if (format_ != PlyFormat::Ascii && !element_->has_lists()) {
        file_->read_exactly(destination, count * row_bytes_);
        return;
    }
    for (std::size_t i = 0; i < count; ++i, ++row_) {
        if (format_ == PlyFormat::Ascii) {
            read_ascii_row(destination + i * row_bytes_);
        } else {
            read_listed_row(destination + i * row_bytes_);
        }
    }
}

void PlyRows::check_size(const PlyElement& element) const {
    // Until the first word is asked for, the two agree, and binary files have no words.
    check_claimed_size(file_->path(), element, format_, words_.remaining());
}

void PlyRows::skip_element(const PlyElement& element) {
    if (element.properties.empty()) {
        return; // rows of nothing, whatever their number
    }
    if (format_ != PlyFormat::Ascii && !element.has_lists()) {
        file_->skip(element.count * element.minimum_row_bytes(format_));
        return;
    }
    current_ = &element;
    for (row_ = 0; row_ < element.count; ++row_) {
        skip_row();
    }
}

void PlyRows::skip_row() {
    for (const PlyProperty& property : current_->properties) {
        if (format_ == PlyFormat::Ascii) {
            const std::uint64_t values = property.list_count ? list_length(property) : 1;
            for (std::uint64_t i = 0; i < values; ++i) {
                next_number(property);
            }
        } else if (property.list_count) {
            skip_binary_list(property);
        } else {
            file_->skip(size_of(property.type));
        }
    }
    end_row();
}

/// Rows may share a line, or take several. One that begins behind another and goes on in the next
/// line shows that a row has a value too many or too few, and all that follow would be shifted.
void PlyRows::end_row() {
    const bool behind = row_begun_ && row_ > 0 && row_line_ == last_line_;
    if (behind && words_.line() != row_line_) {
        fail_file(file_->path(),
                  "row " + std::to_string(row_) + " of element " + in_quotes(current_->name) +
                      " begins in the line of the row before it and ends in another "
                      "one, so that a line holds more values than its " +
                      std::to_string(current_->properties.size()) + " properties take.");
    }
    last_line_ = words_.line();
    row_begun_ = false;
}

void PlyRows::skip_binary_list(const PlyProperty& list) {
    const std::uint64_t bytes = list_length(list) * size_of(list.type); // at most 2^32 * 8
    if (bytes > file_->remaining()) {
        fail_at(list, "the list claims " + std::to_string(bytes) + " bytes, but only " +
                          std::to_string(file_->remaining()) +
                          " follow; the file is truncated or damaged.");
    }
    file_->skip(bytes);
}

std::uint64_t PlyRows::list_length(const PlyProperty& list) {
    double length = 0;
    if (format_ == PlyFormat::Ascii) {
        length = next_number(list);
    } else {
        char bytes[sizeof(double)];
        file_->read_exactly(bytes, size_of(*list.list_count));
        with_type(*list.list_count, [&](auto value) {
            length = static_cast<double>(load_value<decltype(value)>(bytes, swap_));
        });
    }
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    if (!(length >= 0 && length <= kMost) || length != static_cast<double>(std::uint64_t(length))) {
        fail_at(list, "the length of the list is not an integer from 0 to 4294967295.");
    }
    return static_cast<std::uint64_t>(length);
}

void PlyRows::read_listed_row(char* destination) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const PlyProperty& property = element_->properties[i];
        if (property.list_count) {
            skip_binary_list(property);
        } else {
            file_->read_exactly(destination + columns_[i].offset, size_of(property.type));
        }
    }
}

void PlyRows::read_ascii_row(char* destination) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const PlyProperty& property = element_->properties[i];
        if (property.list_count) {
            for (std::uint64_t left = list_length(property); left > 0; --left) {
                next_number(property);
            }
        } else {
            const double value = next_number(property);
            std::memcpy(destination + columns_[i].offset, &value, sizeof value);
        }
    }
    end_row();
}

double PlyRows::next_number(const PlyProperty& property) {
    const std::string_view word = words_.next();
    row_line_ = row_begun_ ? row_line_ : words_.line();
    row_begun_ = true;
    if (word.empty()) {
        fail_at(property,
                "the file ends here, before the rows its header promises; it is truncated.");
    }
    const std::optional<double> value = parse_number(word);
    if (!value) {
        fail_at(property, "this is not a number; ASCII PLY files hold decimal numbers only.");
    }
    return *value;
}

void PlyRows::fail_at(const PlyProperty& property, const std::string& sentence) const {
    fail_file(file_->path(), "row " + std::to_string(row_) + " of element '" + current_->name +
                                 "', property '" + property.name + "': " + sentence);
}

} // namespace degs
