// SPDX-License-Identifier: Apache-2.0
// Entries of the cache. The first byte chooses the kind of the entry, and whether the rest is its
// content or all of its file.
#include "tests/fuzz/fuzz_cache.hpp"

void degs::fuzz::run(std::string_view bytes) {
    static const KeptEntries kept;
    Cursor input(bytes);
    const std::uint8_t choice = input.byte();
    const auto kind = static_cast<Entry>(choice % 3);
    const std::string rest(input.rest());
    if (choice / 3 % 4 == 0) {
        if (kept.takes_file(kind, rest) && !KeptEntries::has_checksum(rest)) {
            fail("an entry with a wrong checksum was taken");
        }
        return;
    }
    if (kept.takes_content(kind, rest) && kept.takes_content(kind, rest + '\1')) {
        fail("an entry with a byte too many was taken");
    }
}
