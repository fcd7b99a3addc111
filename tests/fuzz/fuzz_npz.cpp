// SPDX-License-Identifier: Apache-2.0
// NPZ, Gaussians and cameras.
#include "scene/npz/npz.hpp"
#include "scene/npz/npz_cameras.hpp"
#include "tests/fuzz/fuzz_archive.hpp"

void degs::fuzz::run(std::string_view bytes) {
    const std::string path = folder().write("a.npz", archive_of(bytes));
    read_or_refuse([&path] { use(read_npz(path)); });
    read_or_refuse([&path] { read_npz_cameras(path); });
}
