// SPDX-License-Identifier: Apache-2.0
// .splat: the input is the file.
#include "scene/splat_file/splat_file.hpp"
#include "tests/fuzz/fuzz_input.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("a.splat", bytes);
    read_or_refuse([&path] { use(read_splat_file(path)); });
    if (accepts([&path] { read_splat_file(path); })) {
        const std::string more = folder().write("b.splat", std::string(bytes) + '\1');
        if (accepts([&more] { read_splat_file(more); })) {
            fail("a file with a byte too many was taken");
        }
    }
}
