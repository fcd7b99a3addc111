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
    const auto takes = [](const std::string& data) {
        return accepts([&data] { decode_spz("a.spz", data); });
    };
    read_or_refuse([&file] {
        SceneContent content = decode_spz("a.spz", file);
        expect_note_of_scales(content);
        use(std::move(content));
    });
    const bool taken = takes(file);
    if (taken && takes(file + '\1')) {
        fail("a file with a byte too many was taken");
    }
    if (packed) {
        const std::string plain(rest);
        const std::string in_two = test::SpzBuilder::gzip(plain.substr(0, plain.size() / 2)) +
                                   test::SpzBuilder::gzip(plain.substr(plain.size() / 2));
        if (taken != takes(in_two)) {
            fail("two gzip members are not the same as one");
        }
        if (taken && takes(test::SpzBuilder::gzip(plain + '\1'))) {
            fail("compressed data with a byte too many was taken");
        }
    }
}
