// SPDX-License-Identifier: Apache-2.0
// What a user writes to name a scene.
#include "scene/scene_spec.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string text(bytes);
    read_or_refuse([&text] { parse_scene_spec(text); });
    read_or_refuse([&text] { parse_synthetic(text); }); // behind "synthetic:"
}
