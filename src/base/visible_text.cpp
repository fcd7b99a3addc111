// SPDX-License-Identifier: Apache-2.0
#include "base/visible_text.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace degs {
namespace {

/// A character, or a single byte that begins none.
struct Character {
    std::size_t bytes = 1;
    std::uint32_t code = 0;
    bool valid = false;
};

struct Lead {
    unsigned char mask, bits; ///< a first byte has these bits under this mask
    std::uint32_t least;      ///< smallest code that needs this many bytes
};
constexpr std::array<Lead, 4> kLeads{
    {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}}};

Character character_at(const std::string& text, std::size_t at) {
    const auto byte = [&text](std::size_t i) -> std::uint32_t { return text[i] & 0xff; };
    std::size_t more = 0;
    while (more < kLeads.size() && (byte(at) & kLeads[more].mask) != kLeads[more].bits) {
        ++more;
    }
    if (more == kLeads.size() || at + more >= text.size()) {
        return {};
    }
    std::uint32_t code = byte(at) & (0xffU ^ kLeads[more].mask);
    for (std::size_t i = 1; i <= more; ++i) {
        if ((byte(at + i) & 0xc0U) != 0x80U) {
            return {};
        }
        code = code << 6U | (byte(at + i) & 0x3fU);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return {more + 1, code, code >= kLeads[more].least && code <= 0x10ffff && !surrogate};
}

bool is_harmless(std::uint32_t code) {
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    const bool separator = code == 0x2028 || code == 0x2029;
    const bool reverses = code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
                          (code >= 0x2066 && code <= 0x2069);
    return !control && !separator && !reverses;
}

std::string escaped(char byte) {
    constexpr const char* kDigits = "0123456789abcdef";
    switch (byte) {
    case '\n':
        return "\\n";
    case '\r':
        return "\\r";
    case '\t':
        return "\\t";
    default:
        return std::string("\\x") + kDigits[byte >> 4 & 15] + kDigits[byte & 15];
    }
}

std::string shown(const std::string& text, bool lines) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const Character character = character_at(text, at);
        const bool keep = character.valid && is_harmless(character.code);
        for (const std::size_t end = at + (character.valid ? character.bytes : 1); at < end; ++at) {
            if (keep || (lines && text[at] == '\n')) {
                out += text[at];
            } else {
                out += escaped(text[at]);
            }
        }
    }
    return out;
}

} // namespace

std::string visible(const std::string& text) {
    return shown(text, false);
}

std::string visible_lines(const std::string& text) {
    return shown(text, true);
}

} // namespace degs
