// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "platform/accelerator_registers.hpp"
#include "sim/registers/register_formats.hpp"

namespace degs::sim {
namespace {

std::string hexadecimal(std::uint32_t value, int digits) {
    char text[16] = {};
    std::snprintf(text, sizeof text, "0x%0*X", digits, value);
    return text;
}

/// "bit 0 DONE: a frame is done; bit 1 ..." of a register of bits, "0 RGBA8: ..." of one with names
/// for values.
std::string details(const RegisterInfo& info) {
    std::string text;
    const auto add = [&text](const std::string& words) {
        text += (text.empty() ? "" : "; ") + words;
    };
    for (const RegisterField& field : info.fields) {
        add("bit " + std::to_string(field.bit) + " " + field.name + ": " + field.meaning);
    }
    if (info.offset != Register::ErrorCode) { // whose values have a table of their own
        for (const RegisterValue& value : info.values) {
            add(std::to_string(value.value) + " " + value.name + ": " + value.meaning);
        }
    }
    return text;
}

const char* access_word(Access access) {
    return access == Access::Read        ? "r"
           : access == Access::ReadWrite ? "rw"
           : access == Access::Command   ? "w"
                                         : "w1c";
}

std::string without_quotes(std::string text) {
    text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
    return text;
}

std::string define(const std::string& name, const std::string& value, const std::string& comment) {
    std::string line = "#define DEGS_" + name + " ";
    line.resize(std::max<std::size_t>(line.size(), 40), ' ');
    line += value;
    return line + (comment.empty() ? "" : " /* " + without_quotes(comment) + " */") + "\n";
}

std::string defines(const RegisterInfo& info) {
    std::string lines;
    const std::string words = info.words == 1 ? "" : std::to_string(info.words) + " words: ";
    lines +=
        define("REG_" + std::string(info.name),
               hexadecimal(static_cast<std::uint32_t>(info.offset), 3) + "u", words + info.meaning);
    for (const RegisterField& field : info.fields) {
        lines += define(std::string(info.name) + "_" + field.name,
                        "(1u << " + std::to_string(field.bit) + ")", field.meaning);
    }
    for (const RegisterValue& value : info.values) {
        lines += define(std::string(info.name) + "_" + value.name,
                        std::to_string(value.value) + "u", value.meaning);
    }
    return lines;
}

std::string entry_defines(const ViewFieldInfo& field) {
    const std::string words = field.words == 1 ? "" : std::to_string(field.words) + " words: ";
    std::string lines = define(std::string("ENTRY_") + field.name,
                               hexadecimal(static_cast<std::uint32_t>(field.offset), 3) + "u",
                               words + field.meaning);
    for (const RegisterValue& value : field.values) {
        lines += define(std::string(field.name) + "_" + value.name,
                        std::to_string(value.value) + "u", value.meaning);
    }
    return lines;
}

} // namespace

std::string registers_markdown() {
    std::string table = "| offset | name | words | access | meaning |\n|---|---|---|---|---|\n";
    for (const RegisterInfo& info : register_map()) {
        const std::string more = details(info);
        table += "| " + hexadecimal(static_cast<std::uint32_t>(info.offset), 3) + " | " +
                 info.name + " | " + std::to_string(info.words) + " | " + access_word(info.access) +
                 " | " + (info.reset == 0 ? "" : hexadecimal(info.reset, 8) + ": ") + info.meaning +
                 (more.empty() ? "" : ". " + more) + " |\n";
    }
    return table;
}

std::string view_entry_markdown() {
    std::string table = "| offset | name | words | meaning |\n|---|---|---|---|\n";
    for (const ViewFieldInfo& field : view_layout()) {
        std::string more;
        for (const RegisterValue& value : field.values) {
            more += (more.empty() ? ". " : "; ") + std::to_string(value.value) + " " + value.name +
                    ": " + value.meaning;
        }
        table += "| " + hexadecimal(static_cast<std::uint32_t>(field.offset), 3) + " | " +
                 field.name + " | " + std::to_string(field.words) + " | " + field.meaning + more +
                 " |\n";
    }
    return table;
}

std::string registers_c() {
    std::string text =
        "/* SPDX-License-Identifier: Apache-2.0 */\n"
        "/* Registers of the DeGS accelerator: offsets in bytes, bits and values. Written by\n"
        " * degs registers --format c */\n"
        "#ifndef DEGS_REGISTERS_H\n#define DEGS_REGISTERS_H\n\n";
    text += define("REGISTER_BYTES", hexadecimal(kRegisterBytes, 3) + "u",
                   "size of the register window");
    text += define("ID_VALUE", hexadecimal(kAcceleratorId, 8) + "u", "what ID holds");
    text +=
        define("VERSION_VALUE", hexadecimal(kAcceleratorVersion, 8) + "u", "what VERSION holds");
    text +=
        define("BASE_ALIGNMENT", std::to_string(kBaseAlignment) + "u", "of all addresses, bytes");
    for (const RegisterInfo& info : register_map()) {
        text += "\n" + defines(info);
    }
    text +=
        "\n/* An entry of the table of views: its size, and offsets of its fields in bytes. */\n";
    text += define("VIEW_BYTES", std::to_string(kViewBytes) + "u", "of an entry");
    text += define("MOST_VIEWS", std::to_string(kMostViews) + "u", "entries of a table");
    for (const ViewFieldInfo& field : view_layout()) {
        text += entry_defines(field);
    }
    return text + "\n#endif\n";
}

} // namespace degs::sim
