// SPDX-License-Identifier: Apache-2.0
// glTF. The first byte chooses: the rest is the file, or the JSON behind its length and the binary
// chunk of a GLB, whose lengths then agree.
#include "scene/gltf/gltf.hpp"
#include "scene/gltf/gltf_source.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

std::string four(std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 255);
    }
    return bytes;
}

std::string glb_of(std::string_view json, std::string_view data) {
    std::string text(json), bin(data);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    const std::string chunks =
        four(text.size()) + "JSON" + text +
        (bin.empty() ? "" : four(bin.size()) + std::string("BIN\0", 4) + bin);
    return "glTF" + four(2) + four(12 + chunks.size()) + chunks;
}

} // namespace

void degs::fuzz::run(std::string_view bytes) {
    Cursor input(bytes);
    std::string file;
    if (input.byte() % 2 == 0) {
        file = input.rest();
    } else {
        const std::string_view json = input.part();
        file = glb_of(json, input.rest());
    }
    const std::string path = folder().write("a.glb", file);
    read_or_refuse([&path] { use(read_gltf(path)); });
    read_or_refuse([&path] { read_gltf_cameras(path); });
}
