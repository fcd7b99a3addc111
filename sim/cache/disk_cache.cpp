// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/disk_cache.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <xxhash.h>

#include "sim/cache/digest.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'d', 'e', 'g', 's', 'c', 'a', 'c', '2'};
constexpr const char* kEnding = ".entry";
constexpr const char* kDraft = ".draft"; // of an entry that is being written
constexpr auto kDraftLife = std::chrono::hours(1);

struct EntryHead {
    std::array<char, 8> magic = kMagic;
    std::uint64_t key_bytes = 0, content_bytes = 0;
    std::uint64_t checksum = 0; ///< of key and content
};

std::uint64_t checksum_of(const char* key_and_content, std::size_t bytes) {
    return XXH3_64bits(key_and_content, bytes);
}

/// Whether this user alone can have written it.
bool is_own(const struct stat& status) {
    return status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Whether the name is one that file_of() gives.
bool is_entry_name(const std::string& name) {
    constexpr std::size_t kDigits = 32;
    return name.size() == kDigits + std::char_traits<char>::length(kEnding) &&
           name.find_first_not_of("0123456789abcdef") == kDigits &&
           name.compare(kDigits, std::string::npos, kEnding) == 0;
}

/// Whether the name is one that put() gives to an entry that it writes.
bool is_draft_name(const std::string& name) {
    constexpr std::size_t kLetters = 6;
    return name.size() == kLetters + std::char_traits<char>::length(kDraft) &&
           name.compare(kLetters, std::string::npos, kDraft) == 0;
}

/// A file of this user in memory; empty if it cannot be read or is too large.
class Mapping {
public:
    Mapping(const std::string& name, std::uint64_t most_bytes) {
        // A pipe would block, and a link leads to a file that is not the user's.
        const int file = ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
        struct stat status {};
        if (file >= 0 && ::fstat(file, &status) == 0 && is_own(status) && S_ISREG(status.st_mode) &&
            status.st_size > 0 && static_cast<std::uint64_t>(status.st_size) <= most_bytes) {
            void* const at = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ,
                                    MAP_PRIVATE | MAP_POPULATE, file, 0);
            if (at != MAP_FAILED) {
                data_ = static_cast<const char*>(at);
                bytes_ = static_cast<std::size_t>(status.st_size);
            }
        }
        if (file >= 0) {
            ::close(file);
        }
    }
    ~Mapping() {
        if (data_ != nullptr) {
            ::munmap(const_cast<char*>(data_), bytes_);
        }
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    const char* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    const char* data_ = nullptr;
    std::size_t bytes_ = 0;
};

/// Contents begin at a multiple of this, so that their numbers can be read where they are.
constexpr std::size_t kAlignment = 64;

std::size_t padded(std::size_t key_bytes) {
    const std::size_t with_head = sizeof(EntryHead) + key_bytes;
    return (with_head + kAlignment - 1) / kAlignment * kAlignment - sizeof(EntryHead);
}

/// Where the content of a good entry begins; nothing of another key or of a damaged one.
const char* content_of(const Mapping& file, const std::string& key, std::size_t& bytes) {
    EntryHead head;
    if (file.bytes() < sizeof head) {
        return nullptr;
    }
    std::memcpy(&head, file.data(), sizeof head);
    const std::size_t rest = file.bytes() - sizeof head, before = padded(key.size());
    const char* const body = file.data() + sizeof head;
    if (head.magic != kMagic || head.key_bytes != key.size() || rest < before ||
        head.content_bytes != rest - before || std::memcmp(body, key.data(), key.size()) != 0 ||
        head.checksum != checksum_of(body, rest)) {
        return nullptr;
    }
    bytes = head.content_bytes;
    return body + before;
}

struct FoundFile {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes = 0;
};

} // namespace

DiskCache::DiskCache(std::string folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::string DiskCache::distrust(const std::string& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) {
        return "";
    }
    return status.st_uid != ::geteuid() ? "another user owns it"
           : !is_own(status)            ? "others may write to it (chmod go-w changes that)"
                                        : "";
}

std::string DiskCache::file_of(const std::string& key) const {
    Digest digest;
    digest.add(key);
    return (fs::path(folder_) / (digest.text() + kEnding)).string();
}

bool DiskCache::find(
    const std::string& key,
    const std::function<bool(const char* content, std::size_t bytes)>& read) const {
    const std::string name = file_of(key);
    if (!distrust(folder_).empty()) {
        return false;
    }
    const Mapping file(name, most_bytes_);
    if (file.data() == nullptr) {
        return false;
    }
    std::size_t bytes = 0;
    const char* const content = content_of(file, key, bytes);
    std::error_code ignored;
    if (content == nullptr || !read(content, bytes)) {
        fs::remove(name, ignored);
        return false;
    }
    fs::last_write_time(name, fs::file_time_type::clock::now(), ignored);
    return true;
}

void DiskCache::put(const std::string& key, const std::string& content) const {
    if (content.size() > most_bytes_ / 4) {
        return;
    }
    std::error_code error;
    const fs::path parent = fs::path(folder_).parent_path();
    if (!parent.empty()) {
        fs::create_directories(parent, error);
    }
    ::mkdir(folder_.c_str(), S_IRWXU);
    if (!distrust(folder_).empty()) {
        return;
    }
    make_room(content.size());
    std::string draft = (fs::path(folder_) / "XXXXXX").string() + kDraft;
    const int file = ::mkstemps(draft.data(), static_cast<int>(std::strlen(kDraft)));
    if (file < 0) {
        return;
    }
    ::close(file);
    std::string body = key;
    body.resize(padded(key.size()), '\0');
    body += content;
    EntryHead head;
    head.key_bytes = key.size();
    head.content_bytes = content.size();
    head.checksum = checksum_of(body.data(), body.size());
    std::ofstream out(draft, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(&head), sizeof head);
    out.write(body.data(), static_cast<std::streamsize>(body.size()));
    out.close();
    if (out) {
        fs::rename(draft, file_of(key), error);
    }
    if (!out || error) {
        fs::remove(draft, error);
    }
}

void DiskCache::make_room(std::uint64_t bytes) const {
    std::vector<FoundFile> files;
    std::uint64_t total = bytes;
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
        std::error_code gone; // another process may remove it
        const std::string name = at->path().filename().string();
        const bool entry = is_entry_name(name), draft = is_draft_name(name);
        if ((!entry && !draft) || !at->is_regular_file(gone) || at->is_symlink(gone)) {
            continue; // the user's
        }
        const FoundFile file{at->path(), at->last_write_time(gone),
                             gone ? 0 : static_cast<std::uint64_t>(at->file_size(gone))};
        if (gone) {
            continue;
        }
        if (draft && now - file.used > kDraftLife) { // of a process that was killed
            fs::remove(file.path, gone);
            continue;
        }
        total += file.bytes;
        if (entry) {
            files.push_back(file);
        }
    }
    std::sort(files.begin(), files.end(),
              [](const FoundFile& a, const FoundFile& b) { return a.used < b.used; });
    for (const FoundFile& file : files) {
        if (total <= most_bytes_) {
            return;
        }
        std::error_code gone;
        fs::remove(file.path, gone);
        total -= file.bytes;
    }
}

} // namespace degs::sim
