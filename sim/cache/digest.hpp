// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

struct XXH3_state_s;

namespace degs::sim {

/// A number of 128 bits that tells contents apart (XXH3); it does not protect against intent.
class Digest {
public:
    /// What stands for a file: its bytes, or which file it is, with its size and date, which takes
    /// microseconds.
    enum class Files { Bytes, Stamps };
    explicit Digest(Files files = Files::Bytes);
    /// Texts that follow each other are kept apart.
    void add(const std::string& text);
    /// Bytes as they are: their digest is that of XXH3 in 128 bits.
    void add_bytes(const std::string& bytes);
    /// The content of a file, or its stamp; one that is no regular file or cannot be read has
    /// none.
    void add_file(const std::string& name);
    /// A scene with the files in which its cameras may be, see docs/cameras.md: the name and the
    /// content. InputError if it has options that no scene has.
    void add_scene(const std::string& name);
    /// The files of cameras that `name` stands for, see read_camera_file().
    void add_cameras(const std::string& name);
    /// 32 hexadecimal digits.
    std::string text() const;

private:
    void add_content(const std::string& name);
    void add_stamp(const std::string& name);

    struct Free {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, Free> state_;
    Files files_;
};

} // namespace degs::sim
