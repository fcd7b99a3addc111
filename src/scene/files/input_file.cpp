// SPDX-License-Identifier: Apache-2.0
#include "scene/files/input_file.hpp"

#include <filesystem>

#include "base/visible_text.hpp"
#include "config/nearby_file.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

std::uint64_t checked_size(const std::string& path) {
    require_regular(path);
    std::error_code error;
    watch_input(path);
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) {
        fail_file(path, "its size cannot be read (" + error.message() + ").");
    }
    if (size == 0) {
        fail_file(path, "the file is empty.");
    }
    return size;
}

} // namespace

void fail_file(const std::string& path, const std::string& sentence) {
    throw InputError(path + ": " + sentence);
}

void require_sane_growth(const std::string& path, const std::string& what, std::uint64_t packed,
                         std::uint64_t plain) {
    constexpr std::uint64_t kFree = std::uint64_t{64} << 20U;
    constexpr std::uint64_t kMostTimes = 100; // numbers of scenes shrink to a tenth at most
    if (plain > kFree && plain / kMostTimes > packed) {
        fail_file(path, what + " would grow from " + std::to_string(packed) + " to " +
                            std::to_string(plain) + " bytes; beyond " + std::to_string(kFree) +
                            ", at most " + std::to_string(kMostTimes) + " times are allowed.");
    }
}

void require_utf8(const std::string& path, std::string_view head) {
    using namespace std::string_view_literals;
    for (const std::string_view mark : {"\xff\xfe"sv, "\xfe\xff"sv, "\0\0\xfe\xff"sv}) {
        if (head.substr(0, mark.size()) == mark) {
            fail_file(path, "this is text in UTF-16 or UTF-32, and UTF-8 is needed.");
        }
    }
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string out = "'";
    for (const char c : text.substr(0, kLongest)) {
        out += c >= ' ' && c <= '~' ? c : '?';
    }
    return out + (text.size() > kLongest ? "...'" : "'");
}

std::filesystem::path absolute_path(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path absolute = std::filesystem::absolute(path, error);
    return error ? path : absolute;
}

bool name_exists(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

void require_regular(const std::string& path) {
    if (path.find('\0') != std::string::npos) { // the system would not see what follows
        throw InputError("The name of a file holds a zero: '" + visible(path) + "'.");
    }
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
        const fs::path target = fs::read_symlink(path, error);
        fail_file(path, error ? "there is no such file" + nearby_file(path) + "."
                              : "this is a link to '" + visible(target.string()) +
                                    "', which does not exist.");
    }
    if (fs::is_directory(status)) {
        fail_file(path, "this is a folder, and a file is needed.");
    }
    if (!fs::status_known(status)) {
        fail_file(path, "the file cannot be looked at (" + error.message() + ").");
    }
    if (!fs::is_regular_file(status)) {
        fail_file(path, "this is a pipe, socket or device, and a regular file is needed.");
    }
}

InputFile::InputFile(const std::string& path)
    : path_(path), size_(checked_size(path)), stream_(path, std::ios::binary) {
    if (!stream_) {
        fail_file(path, "the file cannot be opened for reading.");
    }
    remember_input(path);
}

void InputFile::seek(std::uint64_t position) {
    stream_.clear();
    stream_.seekg(position);
    position_ = position;
}

void InputFile::skip(std::uint64_t bytes) {
    constexpr std::size_t kSeekWorth = 4096; // a seek throws the stream's buffer away
    char scratch[kSeekWorth];
    if (bytes > kSeekWorth) {
        seek(position_ + bytes);
    } else {
        read_exactly(scratch, bytes);
    }
}

std::size_t InputFile::read_some(char* destination, std::size_t bytes) {
    stream_.read(destination, bytes);
    const std::size_t got = stream_.gcount();
    position_ += got;
    return got;
}

void InputFile::read_exactly(char* destination, std::size_t bytes) {
    if (read_some(destination, bytes) != bytes) {
        fail_file(path_, "the file ended at byte " + std::to_string(position_) +
                             " while it was being read, before all of its data was found.");
    }
}

void InputFile::require_at_most(std::uint64_t limit_bytes) const {
    if (size_ > limit_bytes) {
        fail_file(path_, "the file has " + std::to_string(size_) + " bytes; at most " +
                             std::to_string(limit_bytes) + " are allowed for a file of this kind.");
    }
}

std::string read_text(const std::string& path, std::uint64_t limit_bytes) {
    const InputWatch watch;
    InputFile file(path);
    file.require_at_most(limit_bytes);
    std::string text(file.size(), '\0');
    file.read_exactly(text.data(), text.size());
    watch.require_unchanged();
    require_utf8(path, text);
    if (text.rfind(kByteOrderMark, 0) == 0) {
        text.erase(0, kByteOrderMark.size());
    }
    return text;
}

} // namespace degs
