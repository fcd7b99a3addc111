// SPDX-License-Identifier: Apache-2.0
// Archives as fuzz inputs: no mutation finds its way through the checksums of a zip file.
#pragma once

#include "tests/fuzz/fuzz_input.hpp"
#include "tests/scene/zip_builder.hpp"

namespace degs::fuzz {

/// The first byte chooses: 0: the rest is the file; else the rest is a list of files, each a name
/// and a content behind their lengths, which are stored (1, 3 ...) or deflated (2, 4 ...).
inline std::string archive_of(std::string_view bytes) {
    Cursor input(bytes);
    const std::uint8_t kind = input.byte();
    if (kind == 0) {
        return std::string(input.rest());
    }
    test::ZipBuilder zip;
    zip.deflated = kind % 2 == 0;
    while (!input.empty() && zip.files.size() < 20) {
        const std::string name(input.part());
        zip.files.emplace_back(name, std::string(input.part()));
    }
    return zip.file();
}

} // namespace degs::fuzz
