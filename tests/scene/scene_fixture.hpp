// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs::test {

/// A folder of its own for every test, removed afterwards.
class Folder {
public:
    Folder() {
        static std::atomic<int> next{0};
        const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string("degs-") + info->test_suite_name() + "-" + info->name() +
                           "-" + std::to_string(next++);
        for (char& c : name) {
            c = c == '/' ? '-' : c;
        }
        // Unique among processes too: several build folders may run the same test at once.
        for (int attempt = 0; path_.empty(); ++attempt) {
            const auto candidate =
                std::filesystem::temp_directory_path() / (name + "-" + std::to_string(attempt));
            if (std::filesystem::create_directory(candidate)) {
                path_ = candidate;
            }
        }
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string path(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What the InputError of `function` says; empty if there is none.
template <class Function>
std::string complaint(Function&& function) {
    try {
        function();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// One sentence: ends in a full stop, and is printable on one line.
MATCHER_P(IsSentenceWith, part, "a sentence with '" + std::string(part) + "'") {
    for (const char c : arg) {
        if (c < ' ' || c > '~') {
            return false;
        }
    }
    return !arg.empty() && arg.back() == '.' && arg.find(part) != std::string::npos;
}

/// The folder of trained scenes; may not exist.
inline std::filesystem::path scenes() {
    const char* const folder = std::getenv("DEGS_SCENES");
    return folder != nullptr ? folder : DEGS_SCENES_DEFAULT;
}

} // namespace degs::test

/// Skips a test that needs a trained scene which is not there.
#define DEGS_NEEDS_SCENE(name)                                                                     \
    if (!std::filesystem::exists(degs::test::scenes() / (name))) {                                 \
        GTEST_SKIP() << "This test needs " << (degs::test::scenes() / (name))                      \
                     << "; set DEGS_SCENES to the folder of trained scenes.";                      \
    }
