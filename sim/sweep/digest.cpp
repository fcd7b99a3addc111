// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/digest.hpp"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace degs::sim {

void Digest::add(const std::string& text) {
    for (const char c : text + '\n') {
        value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
}

void Digest::add_file(const std::string& name) {
    add(name);
    std::ifstream file(name, std::ios::binary);
    constexpr std::size_t kBlock = 1U << 20;
    std::string block(kBlock, '\0');
    while (file) {
        file.read(block.data(), static_cast<std::streamsize>(kBlock));
        add(block.substr(0, static_cast<std::size_t>(file.gcount())));
    }
}

void Digest::add_scene(const std::string& name) {
    add_file(name);
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    add_file((folder / "cameras.json").string());
    add_file((folder.parent_path().parent_path() / "cameras.json").string());
}

std::string Digest::text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016" PRIx64, value_);
    return digits;
}

} // namespace degs::sim
