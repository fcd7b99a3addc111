// SPDX-License-Identifier: Apache-2.0
// SOG. From 128 on, the first byte makes files beside a meta.json of the list that follows; else it
// is one archive.
#include "scene/sog/sog.hpp"
#include "tests/fuzz/fuzz_archive.hpp"

namespace {

using namespace degs::fuzz;

/// Files with plain names only; nothing is written elsewhere.
std::string unbundled(std::string_view bytes) {
    Cursor input(bytes);
    const std::string root = folder() / "unbundled";
    std::filesystem::remove_all(root);
    for (int count = 0; !input.empty() && count < 20; ++count) {
        const std::string name(input.part());
        const std::string_view content = input.part();
        if (!name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                    "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
                                 std::string::npos) {
            if (name.front() != '.' && name.size() < 100) {
                folder().write("unbundled/" + name, content);
            }
        }
    }
    return root + "/meta.json";
}

} // namespace

void degs::fuzz::run(std::string_view bytes) {
    const bool archive = bytes.empty() || (static_cast<unsigned char>(bytes[0]) & 128U) == 0;
    const std::string path =
        archive ? folder().write("a.sog", archive_of(bytes)) : unbundled(bytes.substr(1));
    read_or_refuse([&path] {
        SceneContent content = read_sog(path);
        expect_note_of_scales(content);
        use(std::move(content));
    });
}
