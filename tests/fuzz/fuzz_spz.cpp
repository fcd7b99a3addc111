// SPDX-License-Identifier: Apache-2.0
// SPZ. The first byte chooses: the rest is the file, or what gzip compresses, because no mutation
// finds its way through a checksum.
#include "scene/spz/spz.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/scene/spz/spz_builder.hpp"

void degs::fuzz::run(std::string_view bytes) {
    Cursor input(bytes);
    const bool packed = input.byte() % 2 != 0;
    const std::string_view rest = input.rest();
    const std::string file = packed ? test::SpzBuilder::gzip(std::string(rest)) : std::string(rest);
    read_or_refuse([&file] { use(decode_spz("a.spz", file)); });
}
