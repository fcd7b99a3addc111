// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "config/input_files.hpp"

namespace degs {

/// Throws InputError "<path>: <sentence>".
[[noreturn]] void fail_file(const std::string& path, const std::string& sentence);

/// Whether there is something of this name, and be it a link that leads nowhere: whoever reads it
/// then says what is wrong with it.
bool name_exists(const std::filesystem::path& path);

/// Throws InputError if `path` is not a regular file, or a link to one.
void require_regular(const std::string& path);

/// Throws InputError if a text begins with the byte order mark of UTF-16 or UTF-32.
void require_utf8(const std::string& path, std::string_view head);

/// Throws InputError if `packed` bytes would become far more than scenes ever do: a small file
/// could fill the memory. `what` is the subject of the sentence.
void require_sane_growth(const std::string& path, const std::string& what, std::uint64_t packed,
                         std::uint64_t plain);

/// Text of a file in a message: in quotes, printable and short, whatever the file holds.
std::string in_quotes(std::string_view text);

/// From the root on, but as it is if the working folder has been removed.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// A regular file of known size, read in blocks. Every failure is an InputError that names it.
class InputFile {
public:
    /// Throws InputError if the file is missing, a directory, unreadable or empty.
    explicit InputFile(const std::string& path);

    const std::string& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    std::uint64_t position() const { return position_; }
    std::uint64_t remaining() const { return size_ - position_; }

    void seek(std::uint64_t position);
    /// Moves on by `bytes`, which must not exceed `remaining()`.
    void skip(std::uint64_t bytes);
    /// Up to `bytes`; fewer at the end of the file only.
    std::size_t read_some(char* destination, std::size_t bytes);
    /// Exactly `bytes`; InputError if the file ends before (it shrank while we read).
    void read_exactly(char* destination, std::size_t bytes);

    /// Throws InputError if the file is larger.
    void require_at_most(std::uint64_t limit_bytes) const;
    /// For a parser that reads by itself; position() does not follow it.
    std::istream& stream() { return stream_; }

private:
    std::string path_;
    std::uint64_t size_ = 0;
    std::uint64_t position_ = 0;
    std::ifstream stream_;
};

/// The mark of UTF-8, with which some programs begin their texts.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// The whole file as text, without a mark of UTF-8 in front; InputError if it is larger than
/// `limit_bytes`.
std::string read_text(const std::string& path, std::uint64_t limit_bytes);

} // namespace degs
