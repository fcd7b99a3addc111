// SPDX-License-Identifier: Apache-2.0
// The files that this process reads, so that no result replaces one of them.
#pragma once

#include <optional>
#include <string>

namespace degs {

/// Which file a name stands for: links and other spellings of a path have the same.
struct FileIdentity {
    unsigned long long device = 0, number = 0;
    friend bool operator<(const FileIdentity& a, const FileIdentity& b) {
        return a.device != b.device ? a.device < b.device : a.number < b.number;
    }
    friend bool operator==(const FileIdentity& a, const FileIdentity& b) {
        return a.device == b.device && a.number == b.number;
    }
};

/// Empty if there is no such file.
std::optional<FileIdentity> identity_of_file(const std::string& path);

/// Notes that `path` is read. Any thread may call it.
void remember_input(const std::string& path);

/// The name of an input that `path` stands for as well.
std::optional<std::string> input_at(const std::string& path);

} // namespace degs
