// SPDX-License-Identifier: Apache-2.0
// The files that this process reads, so that no result replaces one of them, and none is kept of a
// file that changed in between.
#pragma once

#include <cstdint>
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

/// From now on no result replaces a file that this process reads. For programs: who calls functions
/// may read a file and write it again.
void spare_inputs();
/// Notes that `path` is read. Any thread may call it.
void remember_input(const std::string& path);

/// While one lives, every file that is read has to stay what it was when it was first opened, by
/// whatever read it: what has the key of a file is made from the same bytes as the key. Watches
/// follow each other or lie within each other.
class InputWatch {
public:
    InputWatch();
    ~InputWatch();
    InputWatch(const InputWatch&) = delete;
    InputWatch& operator=(const InputWatch&) = delete;

    /// Throws InputError if a file that was opened since the watch began has another size, date or
    /// inode than when it was first opened, or had when it was opened again. A file may be removed.
    void require_unchanged() const;

private:
    std::uint64_t begin_;
};

/// Notes what a file is, before it is opened.
void watch_input(const std::string& path);

/// The name of an input that `path` stands for as well.
std::optional<std::string> input_at(const std::string& path);

} // namespace degs
