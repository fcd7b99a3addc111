// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace degs::sim {

/// A number of 64 bits that tells studies apart (FNV-1a); it does not protect against intent.
class Digest {
public:
    void add(const std::string& text);
    /// The name of a file and its content; a file that does not exist has none.
    void add_file(const std::string& name);
    /// A scene with the files in which its cameras may be, see docs/cameras.md.
    void add_scene(const std::string& name);
    /// 16 hexadecimal digits.
    std::string text() const;

private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

} // namespace degs::sim
