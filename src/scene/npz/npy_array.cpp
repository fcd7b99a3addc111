// SPDX-License-Identifier: Apache-2.0
#include "scene/npz/npy_array.hpp"

#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>

#include "base/byte_order.hpp"
#include "base/visible_text.hpp"
#include "scene/files/half_float.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::size_t kMaxNpyHeader = 1 << 16;
constexpr std::size_t kMaxDimensions = 8;

/// The text behind `'key':` in the Python dictionary of the header.
std::string_view value_of(std::string_view header, const std::string& key) {
    std::size_t at = header.find("'" + key + "'");
    if (at == std::string_view::npos) {
        at = header.find('"' + key + '"');
    }
    if (at == std::string_view::npos) {
        return {};
    }
    header.remove_prefix(at + key.size() + 2);
    const std::size_t begin = header.find_first_not_of(" :");
    return begin == std::string_view::npos ? std::string_view{} : header.substr(begin);
}

class NpyParser {
public:
    NpyParser(const std::string& where, const std::string& name, std::string bytes)
        : where_(where), name_(name) {
        array_.bytes = std::move(bytes);
    }

    NpyArray parse() {
        const std::string_view header = find_header();
        parse_type(value_of(header, "descr"));
        if (value_of(header, "fortran_order").substr(0, 5) != "False") {
            fail("is stored column by column, which is not supported");
        }
        parse_shape(value_of(header, "shape"));
        check_size();
        return std::move(array_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        fail_file(where_, "its array '" + visible(name_.substr(0, 100)) + "' " + what + ".");
    }

    std::string_view find_header() {
        const std::string_view file = array_.bytes;
        constexpr std::string_view kMagic = "\x93NUMPY";
        if (file.size() < 12 || file.substr(0, kMagic.size()) != kMagic || file[6] < 1 ||
            file[6] > 3) {
            fail("is no NumPy array of version 1, 2 or 3");
        }
        const std::size_t length_bytes = file[6] == 1 ? 2 : 4;
        std::size_t length = 0;
        for (std::size_t i = length_bytes; i-- > 0;) {
            length = length << 8 | static_cast<unsigned char>(file[8 + i]);
        }
        array_.data_at = 8 + length_bytes + length;
        if (length > kMaxNpyHeader || array_.data_at > file.size()) {
            fail("has a header that is longer than the array");
        }
        return file.substr(8 + length_bytes, length);
    }

    void parse_type(std::string_view text) {
        constexpr std::string_view kOrders = "<>|=";
        if (text.size() < 5 || (text[0] != '\'' && text[0] != '"') ||
            kOrders.find(text[1]) == std::string_view::npos) {
            fail("is of a compound or unknown type; numbers are needed");
        }
        array_.kind = text[2];
        array_.item_bytes = text[3] - '0';
        const int b = array_.item_bytes;
        const bool whole = b == 1 || b == 2 || b == 4 || b == 8;
        const bool known = array_.kind == 'f' ? b == 2 || b == 4 || b == 8
                           : array_.kind == 'i' || array_.kind == 'u'
                               ? whole
                               : array_.kind == 'b' && b == 1;
        if (!known || text[4] != text[0]) {
            fail("is of type " + visible(std::string(text.substr(0, 8))) +
                 "; supported are integers and floats of up to 8 bytes");
        }
        array_.swapped = b > 1 && ((text[1] == '>') != host_is_big_endian()) && text[1] != '=';
    }

    void parse_shape(std::string_view text) {
        if (text.empty() || text[0] != '(') {
            fail("has no shape");
        }
        text.remove_prefix(1);
        while (true) {
            text.remove_prefix(std::min(text.find_first_not_of(" ,"), text.size()));
            if (!text.empty() && text[0] == ')') {
                return;
            }
            std::uint64_t length = 0;
            const auto [rest, error] =
                std::from_chars(text.data(), text.data() + text.size(), length);
            if (error != std::errc() || array_.shape.size() == kMaxDimensions) {
                fail("has a shape that is no list of up to 8 lengths");
            }
            array_.shape.push_back(length);
            text.remove_prefix(rest - text.data());
        }
    }

    void check_size() const {
        const std::uint64_t items = (array_.bytes.size() - array_.data_at) / array_.item_bytes;
        std::uint64_t size = 1;
        for (const std::uint64_t length : array_.shape) {
            if (length != 0 && size > items / length) {
                size = items + 1; // too many, whatever follows
                break;
            }
            size *= length;
        }
        if (size * array_.item_bytes != array_.bytes.size() - array_.data_at) {
            fail("of shape " + array_.shape_words() + " does not have the size that this needs");
        }
    }

    const std::string& where_;
    const std::string& name_;
    NpyArray array_;
};

} // namespace

std::uint64_t NpyArray::size() const {
    return (bytes.size() - data_at) / item_bytes;
}

double NpyArray::at(std::uint64_t index) const {
    const char* const from = bytes.data() + data_at + index * item_bytes;
    const auto load = [&](auto value) { return load_value<decltype(value)>(from, swapped); };
    if (kind == 'f') {
        return item_bytes == 2   ? half_value(load(std::uint16_t{}))
               : item_bytes == 4 ? static_cast<double>(load(float{}))
                                 : load(double{});
    }
    if (kind == 'i') {
        return item_bytes == 1   ? load(std::int8_t{})
               : item_bytes == 2 ? load(std::int16_t{})
               : item_bytes == 4 ? load(std::int32_t{})
                                 : static_cast<double>(load(std::int64_t{}));
    }
    return item_bytes == 1   ? load(std::uint8_t{})
           : item_bytes == 2 ? load(std::uint16_t{})
           : item_bytes == 4 ? load(std::uint32_t{})
                             : static_cast<double>(load(std::uint64_t{}));
}

std::string NpyArray::shape_words() const {
    std::string words;
    for (const std::uint64_t length : shape) {
        words += (words.empty() ? "" : ", ") + std::to_string(length);
    }
    return "(" + words + ")";
}

NpyArray parse_npy(const std::string& where, const std::string& name, std::string bytes) {
    return NpyParser(where, name, std::move(bytes)).parse();
}

} // namespace degs
