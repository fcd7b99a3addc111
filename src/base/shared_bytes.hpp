// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace degs {

/// Byte strings by key, which a process shares with its forks: whoever makes one first writes it,
/// once, and it never changes. Processes may write and read at the same time, and one that is
/// killed while it writes loses only what it was writing.
class SharedBytes {
public:
    /// Room for `bytes` in all, which the system hands out as it is used. If it refuses, nothing is
    /// ever kept. The forks of this process keep what they have when this object goes.
    explicit SharedBytes(std::size_t bytes);
    ~SharedBytes();
    SharedBytes(const SharedBytes&) = delete;
    SharedBytes& operator=(const SharedBytes&) = delete;

    /// What put() has written under this key; without data() if there is nothing. It lies at the
    /// same address in all processes, aligned to eight bytes.
    std::string_view find(std::string_view key) const;
    /// Does nothing if another one is writing or has written it, or if there is no room.
    void put(std::string_view key, std::string_view bytes);
    /// Bytes that have been taken.
    std::size_t used() const;

private:
    struct Slot;
    struct Head;

    Slot* place(std::uint64_t hash, std::size_t step) const;
    char* allocate(std::size_t bytes);

    std::size_t size_ = 0;
    Head* head_ = nullptr; ///< of the shared memory; slots and bytes follow
};

} // namespace degs
