// SPDX-License-Identifier: Apache-2.0
// A file of any format: its first bytes choose the reader.
#include "scene/scene_formats.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("scene", bytes);
    read_or_refuse([&path] { use(read_scene_file(path)); });
    read_or_refuse([&path] { read_scene_cameras(path); });
    scene_external_files(path);
}
