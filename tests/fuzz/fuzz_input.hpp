// SPDX-License-Identifier: Apache-2.0
// What the fuzz targets share: bytes as files, and what a reader may do with them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "degs/error.hpp"
#include "scene/files/activation_scan.hpp"
#include "scene/files/axes.hpp"
#include "scene/files/scene_content.hpp"

namespace degs::fuzz {

/// A folder of this process in memory, removed at its end.
class MemoryFolder {
public:
    MemoryFolder() {
        std::error_code none;
        const std::filesystem::path memory = "/dev/shm";
        std::string name = ((std::filesystem::is_directory(memory, none)
                                 ? memory
                                 : std::filesystem::temp_directory_path()) /
                            "degs-fuzz-XXXXXX")
                               .string();
        if (::mkdtemp(name.data()) == nullptr) {
            std::perror("degs fuzz target: folder");
            std::exit(1);
        }
        path_ = name;
    }
    ~MemoryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;

    std::string write(const std::string& name, std::string_view bytes) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file.string();
    }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

inline const MemoryFolder& folder() {
    static const MemoryFolder made;
    return made;
}

/// Aborts: the fuzzer then keeps the input.
[[noreturn]] inline void fail(const std::string& what) {
    std::fprintf(stderr, "degs fuzz target: %s\n", what.c_str());
    std::abort();
}

/// Calls `read`; whether it did not refuse.
template <class Read>
bool accepts(const Read& read) {
    try {
        read();
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Runs a reader. It may refuse its input with an InputError that says something; every other
/// exception ends the process. Whoever prints the sentence makes its control characters visible.
template <class Read>
void read_or_refuse(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        if (std::string_view(error.what()).empty()) {
            fail("an error says nothing");
        }
    }
}

/// To RDF and back only signs change, so that nothing does.
inline void turn_and_turn_back(const SceneContent& content) {
    GaussianCloud turned = content.cloud;
    convert_axes(turned, content.axes, Axes{});
    convert_axes(turned, Axes{}, content.axes);
    const std::size_t bytes = turned.means.size() * sizeof(glm::dvec3);
    if (bytes > 0 && std::memcmp(turned.means.data(), content.cloud.means.data(), bytes) != 0) {
        fail("positions change when axes are turned and turned back");
    }
}

/// Expects a note from formats with logarithms of scales if all scales look activated.
inline void expect_note_of_scales(const SceneContent& content) {
    const auto small = [](const glm::vec3& s) { return s.x < 1 || s.y < 1 || s.z < 1; };
    const std::vector<glm::vec3>& scales = content.cloud.scales;
    const bool activated = scales.size() >= kFewestToJudge &&
                           std::none_of(scales.begin(), scales.end(), small) &&
                           !sizes_fit_scene(content.cloud.means, scales);
    const auto says = [](const std::string& note) {
        return note.find("hold its scales as they are") != std::string::npos ||
               note.find("hold both as they are") != std::string::npos;
    };
    if (activated != std::any_of(content.notes.begin(), content.notes.end(), says)) {
        fail("a note of activated scales is missing, or one too many");
    }
}

/// What holds for every scene that a reader accepts, and what every command does with it next.
inline void use(SceneContent content) {
    GaussianCloud& cloud = content.cloud;
    const auto consistent = [&cloud] {
        const std::size_t n = cloud.size();
        return cloud.sh_degree >= 0 && cloud.sh_degree <= 3 && cloud.scales.size() == n &&
               cloud.rotations.size() == n && cloud.opacities.size() == n &&
               cloud.sh.size() == n * 3 * cloud.sh_coefficients();
    };
    if (!consistent()) {
        fail("the arrays of the cloud disagree");
    }
    turn_and_turn_back(content);
    sanitize(cloud);
    if (!consistent()) {
        fail("the arrays of the cloud disagree after sanitize()");
    }
}

/// Takes parts off the front of an input.
class Cursor {
public:
    explicit Cursor(std::string_view bytes) : rest_(bytes) {}
    bool empty() const { return rest_.empty(); }
    std::uint8_t byte() {
        const std::string_view one = take(1);
        return one.empty() ? 0 : static_cast<std::uint8_t>(one[0]);
    }
    /// Up to `bytes`.
    std::string_view take(std::size_t bytes) {
        const std::string_view part = rest_.substr(0, bytes);
        rest_.remove_prefix(part.size());
        return part;
    }
    /// A part behind its length, 16 bits with the low byte first.
    std::string_view part() {
        const std::size_t low = byte();
        return take(low | std::size_t{byte()} << 8);
    }
    std::string_view rest() { return take(rest_.size()); }

private:
    std::string_view rest_;
};

/// The target: one input.
void run(std::string_view bytes);

} // namespace degs::fuzz

extern "C" __attribute__((used)) inline int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                                                   std::size_t size) {
    degs::fuzz::run({reinterpret_cast<const char*>(data), size});
    return 0;
}
