// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// A part of an image: its first column and row, its width and height. Nothing: the whole image.
struct Crop {
    int x = 0, y = 0, width = 0, height = 0; ///< px
};

struct Arguments {
    std::string design, scene, firmware; ///< files
    bool lpddr5 = false;
    std::string memory; ///< a file; empty: the default of degs::Lpddr5
    Crop crop;
    double limit_ms = 1000; ///< of simulated time
    std::vector<std::size_t> cameras;
};

/// Throws std::runtime_error, how the program is called, if the words make no sense.
Arguments parse(int argc, char* argv[]);
