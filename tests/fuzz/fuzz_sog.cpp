// SPDX-License-Identifier: Apache-2.0
// SOG. From 128 on, the first byte makes files beside a meta.json of the list that follows, and
// from 192 on beside the lod-meta.json of a streamed scene; else it is one archive.
#include "scene/sog/sog.hpp"
#include "scene/sog/streamed_sog.hpp"
#include "tests/fuzz/fuzz_archive.hpp"

namespace {

using namespace degs::fuzz;

/// Files with plain names only; nothing is written elsewhere.
std::string unbundled(std::string_view bytes, const std::string& index) {
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
    return root + "/" + index;
}

/// The lowest bits of `first` choose the levels of detail.
void read_streamed(unsigned first, std::string_view bytes) {
    degs::SceneDetail detail;
    if ((first & 1U) != 0) {
        detail.level = static_cast<int>(first >> 1 & 1U);
    } else if ((first & 2U) != 0) {
        detail.budget = first >> 2 & 15U;
    }
    const std::string path = unbundled(bytes, "lod-meta.json");
    read_or_refuse([&] { use(degs::read_streamed_sog(path, detail)); });
    read_or_refuse([&] { degs::streamed_sog_files(path, detail); });
}

} // namespace

void degs::fuzz::run(std::string_view bytes) {
    const unsigned first = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]);
    constexpr unsigned kFiles = 128, kStreamed = 192;
    if (first >= kStreamed) {
        return read_streamed(first, bytes.substr(1));
    }
    const std::string path = first < kFiles ? folder().write("a.sog", archive_of(bytes))
                                            : unbundled(bytes.substr(1), "meta.json");
    read_or_refuse([&path] {
        SceneContent content = read_sog(path);
        expect_note_of_scales(content);
        use(std::move(content));
    });
}
