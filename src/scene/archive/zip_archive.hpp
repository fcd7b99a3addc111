// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace degs {

/// The files in a zip archive, of which nothing is inflated before its size has been checked. Every
/// failure is an InputError that names the archive.
class ZipArchive {
public:
    /// Reads the directory. At most 10,000 files; names may be stored in any order.
    explicit ZipArchive(const std::string& path);

    const std::string& path() const { return path_; }
    std::uint64_t bytes() const { return bytes_; } ///< of the archive itself
    std::vector<std::string> names() const;
    bool has(const std::string& name) const;
    /// The whole file. Refused if it is missing, encrypted, damaged or packed by a method other
    /// than store and deflate, claims more than `limit_bytes`, or inflates more than 1,032 times.
    std::string read(const std::string& name, std::uint64_t limit_bytes) const;

private:
    struct Close {
        void operator()(zip* archive) const;
    };
    std::string path_;
    std::uint64_t bytes_ = 0;
    std::unique_ptr<zip, Close> archive_;
};

} // namespace degs
