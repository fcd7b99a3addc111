// SPDX-License-Identifier: Apache-2.0
// COLMAP models, binary or text: a first byte that chooses, the file of the cameras behind its
// length, and the file of the images.
#include "scene/cameras/camera_formats.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    Cursor input(bytes);
    ColmapFiles files;
    files.binary = input.byte() % 2 != 0;
    const std::string ending = files.binary ? ".bin" : ".txt";
    files.cameras = folder().write("cameras" + ending, input.part());
    files.images = folder().write("images" + ending, input.rest());
    read_or_refuse([&files] { read_colmap(files); });
}
