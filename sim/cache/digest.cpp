// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/digest.hpp"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>
#include <vector>

#include <sys/stat.h>
#include <xxhash.h>

#include "config/input_files.hpp"
#include "scene/cameras/camera_file.hpp"
#include "scene/cameras/trained_frame.hpp"
#include "scene/dynamic_scene.hpp"
#include "scene/scene_formats.hpp"
#include "scene/scene_spec.hpp"

namespace degs::sim {

Digest::Digest(Files files) : state_(XXH3_createState()), files_(files) {
    if (state_ == nullptr) {
        throw std::bad_alloc();
    }
    XXH3_128bits_reset(state_.get());
}

void Digest::Free::operator()(XXH3_state_s* state) const {
    XXH3_freeState(state);
}

void Digest::add(const std::string& text) {
    const std::uint64_t size = text.size();
    XXH3_128bits_update(state_.get(), &size, sizeof size);
    XXH3_128bits_update(state_.get(), text.data(), text.size());
}

void Digest::add_bytes(const std::string& bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

void Digest::add_content(const std::string& name) {
    constexpr std::size_t kBlock = 1U << 20;
    std::uint64_t size = 0;
    std::ifstream file(name, std::ios::binary);
    std::vector<char> block(kBlock);
    while (file) {
        file.read(block.data(), static_cast<std::streamsize>(kBlock));
        const auto got = static_cast<std::size_t>(file.gcount());
        XXH3_128bits_update(state_.get(), block.data(), got);
        size += got;
    }
    XXH3_128bits_update(state_.get(), &size, sizeof size);
}

void Digest::add_stamp(const std::string& name) {
    struct stat status {};
    if (::stat(name.c_str(), &status) == 0) {
        for (const std::string& part :
             {std::to_string(status.st_dev), std::to_string(status.st_ino),
              std::to_string(status.st_size), std::to_string(status.st_mtim.tv_sec),
              std::to_string(status.st_mtim.tv_nsec)}) {
            add(part);
        }
    }
}

void Digest::add_file(const std::string& name) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(name, error)) { // others may block, or never end
        const std::uint64_t size = 0;
        XXH3_128bits_update(state_.get(), &size, sizeof size);
        return;
    }
    remember_input(name);
    watch_input(name);
    if (files_ == Files::Stamps) {
        add_stamp(name);
    } else {
        add_content(name);
    }
}

void Digest::add_scene(const std::string& name) {
    const SceneSpec spec = parse_scene_spec(name);
    std::vector<std::string> files;
    if (!spec.synthetic) {
        files = sequence_files(spec.path);
    }
    if (files.empty()) {
        files.push_back(spec.path);
    }
    add(name);
    for (const std::string& file : files) {
        add(file);
        add_file(file);
        for (const std::string& part : scene_external_files(file, spec.detail)) {
            add_file(part);
        }
    }
    add_cameras(cameras_beside(files.front()));
    add(trained_frame_beside(files.front()));
    add_file(trained_frame_beside(files.front()));
}

void Digest::add_cameras(const std::string& name) {
    for (const std::string& file : files_of_cameras(name)) {
        add(file);
        add_file(file);
    }
}

std::string Digest::text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    char digits[33];
    std::snprintf(digits, sizeof digits, "%016" PRIx64 "%016" PRIx64, std::uint64_t{hash.high64},
                  std::uint64_t{hash.low64});
    return digits;
}

} // namespace degs::sim
