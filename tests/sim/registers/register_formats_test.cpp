// SPDX-License-Identifier: Apache-2.0
// The register map in all formats, against the map itself.
#include "sim/registers/register_formats.hpp"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/accelerator_registers.hpp"

namespace degs::sim {
namespace {

using testing::HasSubstr;

std::string hex(std::uint64_t value) {
    std::ostringstream out;
    out << std::hex << std::uppercase << value;
    return out.str();
}

/// The numbers in elements of this name, in their order.
std::vector<std::uint64_t> numbers(const std::string& xml, const std::string& element) {
    std::vector<std::uint64_t> found;
    const std::string begin = "<" + element + ">";
    for (std::size_t at = xml.find(begin); at != std::string::npos; at = xml.find(begin, at + 1)) {
        const std::size_t digits = xml.find_first_of("xh", at + begin.size()) + 1; // 0x or 'h
        found.push_back(std::stoull(xml.substr(digits), nullptr, 16));
    }
    return found;
}

TEST(RegisterFormats, SvdHasEveryRegisterWithItsWordsAndReset) {
    std::vector<std::uint64_t> offsets, resets, words;
    for (const RegisterInfo& info : register_map()) {
        offsets.push_back(static_cast<std::uint64_t>(info.offset));
        resets.push_back(info.reset);
        if (info.words > 1) {
            words.push_back(info.words);
        }
    }
    const std::string svd = registers_svd();
    EXPECT_EQ(numbers(svd, "addressOffset"), offsets);
    EXPECT_EQ(numbers(svd, "resetValue"), resets);
    EXPECT_EQ(numbers(svd, "dim"), words);
    EXPECT_EQ(numbers(svd, "dimIncrement"), std::vector<std::uint64_t>(words.size(), 4));
}

TEST(RegisterFormats, IpXactHasTheResetOfEveryField) {
    std::vector<std::uint64_t> offsets, resets, widths;
    for (const RegisterInfo& info : register_map()) {
        offsets.push_back(static_cast<std::uint64_t>(info.offset));
        for (const RegisterField& field : info.fields) {
            widths.push_back(1);
            resets.push_back((info.reset & (std::uint32_t{1} << field.bit)) != 0 ? 1 : 0);
        }
        if (info.fields.empty()) {
            widths.push_back(32);
            resets.push_back(info.reset);
        }
        for (std::size_t v = 0; info.fields.empty() && v < info.values.size(); ++v) {
            resets.push_back(info.values[v].value); // names of values are in elements alike
        }
    }
    const std::string ip_xact = registers_ip_xact();
    EXPECT_EQ(numbers(ip_xact, "ipxact:addressOffset"), offsets);
    EXPECT_EQ(numbers(ip_xact, "ipxact:bitWidth"), widths);
    EXPECT_EQ(numbers(ip_xact, "ipxact:value"), resets);
    EXPECT_NE(std::count_if(resets.begin(), resets.end(), [](auto r) { return r != 0; }), 0);
}

TEST(RegisterFormats, TheTableSaysWhoMayReadAndWrite) {
    const std::string table = registers_markdown();
    for (const RegisterInfo& info : register_map()) {
        const char* access = info.access == Access::Read        ? "r"
                             : info.access == Access::Command   ? "w"
                             : info.access == Access::ReadWrite ? "rw"
                                                                : "w1c";
        EXPECT_THAT(table, HasSubstr(std::string(info.name) + " | " + std::to_string(info.words) +
                                     " | " + access + " | "));
        EXPECT_THAT(registers_c(), HasSubstr("#define DEGS_REG_" + std::string(info.name) + " "));
        if (info.reset != 0) {
            EXPECT_THAT(table, HasSubstr(hex(info.reset) + ": " + info.meaning));
        }
    }
}

TEST(RegisterFormats, TheLayoutOfAViewIsInItsTableAndInTheHeader) {
    const std::string table = view_entry_markdown();
    for (const ViewFieldInfo& field : view_layout()) {
        EXPECT_THAT(table, HasSubstr("| " + std::string(field.name) + " | " +
                                     std::to_string(field.words) + " | " + field.meaning));
        EXPECT_THAT(registers_c(),
                    HasSubstr("#define DEGS_ENTRY_" + std::string(field.name) + " "));
    }
    EXPECT_THAT(table, HasSubstr("| 0x098 | LENS | 1 | kind of lens. 0 PINHOLE: "));
    EXPECT_THAT(registers_c(), HasSubstr("#define DEGS_LENS_FISHEYE "));
}

} // namespace
} // namespace degs::sim
