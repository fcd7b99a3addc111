// SPDX-License-Identifier: Apache-2.0
// SOG, bundled.
#include "scene/sog/sog.hpp"
#include "tests/fuzz/fuzz_archive.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("a.sog", archive_of(bytes));
    read_or_refuse([&path] { use(read_sog(path)); });
}
