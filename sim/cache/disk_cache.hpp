// SPDX-License-Identifier: Apache-2.0
// Results of earlier runs on disk, found by what they were made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace degs::sim {

/// Entries never change once they are there; any number of processes may read and write the same
/// folder. An entry appears whole or not at all, carries its key and a checksum, and is taken for
/// missing if either is wrong. A cache never makes a run fail: what cannot be read or written is
/// not cached.
class DiskCache {
public:
    /// `folder` is made when it is needed. The entries that were not used for the longest time are
    /// removed when all together exceed `most_bytes`.
    DiskCache(std::string folder, std::uint64_t most_bytes);

    /// Why the entries of a folder cannot be trusted: others own it or may write it. Empty if only
    /// this user does, and if it does not exist.
    static std::string distrust(const std::string& folder);

    /// Calls `read` with the content of the entry and returns what it returns; false without an
    /// entry. An entry that `read` refuses is removed. Only regular files of this user are read.
    bool find(const std::string& key,
              const std::function<bool(const char* content, std::size_t bytes)>& read) const;
    /// Adds an entry, unless it alone exceeds a quarter of the cache.
    void put(const std::string& key, const std::string& content) const;

private:
    std::string file_of(const std::string& key) const;
    void make_room(std::uint64_t bytes) const;

    std::string folder_;
    std::uint64_t most_bytes_;
};

} // namespace degs::sim
