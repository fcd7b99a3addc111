// SPDX-License-Identifier: Apache-2.0
// cameras.json and transforms.json: the input is the file, whose content decides which it is.
#include "scene/cameras/camera_file.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("cameras.json", bytes);
    read_or_refuse([&path] { read_camera_file(path); });
}
