// SPDX-License-Identifier: Apache-2.0
// PLY and compressed PLY: the input is the file.
#include "scene/ply/ply.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("a.ply", bytes);
    read_or_refuse([&path] { use(read_ply(path)); });
    if (accepts([&path] { read_ply(path); })) {
        const std::string more = folder().write("b.ply", std::string(bytes) + " 7");
        if (accepts([&more] { read_ply(more); })) {
            fail("what is left over behind the last element was passed over");
        }
    }
}
