// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace {

const char* const kUsage =
    "usage: riscv DESIGN.yaml SCENE FIRMWARE.elf [--lpddr5 | --memory FILE] [--crop X,Y,WxH] "
    "[--limit-ms MS] [CAMERA ...]";

void require(bool holds) {
    if (!holds) {
        throw std::runtime_error(kUsage);
    }
}

Crop crop_of(const char* text) {
    Crop crop;
    char rest = 0;
    require(std::sscanf(text, "%d,%d,%dx%d%c", &crop.x, &crop.y, &crop.width, &crop.height,
                        &rest) == 4);
    require(crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0);
    return crop;
}

double limit_of(const char* text) {
    char* end = nullptr;
    const double limit = std::strtod(text, &end);
    require(end != text && *end == 0 && limit >= 1e-3 && limit <= 1e9);
    return limit;
}

std::size_t camera_of(const std::string& text) {
    require(!text.empty() && text.find_first_not_of("0123456789") == std::string::npos);
    return std::strtoul(text.c_str(), nullptr, 10);
}

} // namespace

Arguments parse(int argc, char* argv[]) {
    Arguments to;
    std::vector<std::string*> files{&to.firmware, &to.scene, &to.design}; // the last is the next
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            require(i + 1 < argc);
            return argv[++i];
        };
        if (word == "--lpddr5") {
            to.lpddr5 = true;
        } else if (word == "--memory") {
            to.lpddr5 = true;
            to.memory = value();
        } else if (word == "--crop") {
            to.crop = crop_of(value());
        } else if (word == "--limit-ms") {
            to.limit_ms = limit_of(value());
        } else if (!files.empty() && word.compare(0, 2, "--") != 0) {
            *files.back() = word;
            files.pop_back();
        } else {
            to.cameras.push_back(camera_of(word));
        }
    }
    require(files.empty());
    if (to.cameras.empty()) {
        to.cameras.push_back(0);
    }
    return to;
}
