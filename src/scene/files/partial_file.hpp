// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace degs {

constexpr std::size_t kMostName = 255; ///< bytes of the name of a file that file systems allow

/// A file that is being written, beside the one that it will become. It is new and no link,
/// whatever others have put into the folder, and locked, so that remove_partial_files() can tell it
/// from one that a killed process left. Gone at the end, unless it has been renamed, or when a
/// signal ends the program.
class PartialFile {
public:
    /// Makes the file, empty, for the file `path`.
    explicit PartialFile(const std::string& path);
    ~PartialFile();
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    bool exists() const { return file_ >= 0; }
    const std::string& name() const { return name_; }
    bool takes_a_byte() const;

private:
    std::string name_;
    int file_ = -1;
    int place_ = -1; ///< in the list for signals
};

} // namespace degs
