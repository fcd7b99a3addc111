// SPDX-License-Identifier: Apache-2.0
#include "scene/files/partial_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <random>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/files/output_file.hpp"

namespace degs {
namespace {

constexpr const char* kPartial = ".partial-";
constexpr int kAttempts = 100;

/// A file that a signal must remove, and the process that made it: a fork has the list, too.
struct Droppable {
    std::atomic<bool> taken{false};
    std::atomic<const char*> name{nullptr};
    std::atomic<pid_t> owner{0};
};
/// More files than these at a time are left to the next run.
std::array<Droppable, 256> droppables;
std::atomic<bool> dropped{false}; ///< a signal is ending the program

int remember_droppable(const char* name) {
    for (std::size_t i = 0; i < droppables.size(); ++i) {
        if (!droppables[i].taken.exchange(true)) {
            droppables[i].owner = ::getpid();
            droppables[i].name = name;
            return static_cast<int>(i);
        }
    }
    return -1;
}

void forget_droppable(int place) {
    if (place >= 0) {
        droppables[place].name = nullptr;
        droppables[place].taken = false;
    }
}

/// Unique among the threads of this process and, by its random part, among processes.
std::string partial_name(const std::string& path) {
    static std::atomic<unsigned> next{0};
    const std::string ending =
        kPartial + std::to_string(std::random_device{}()) + "-" + std::to_string(next++);
    const std::filesystem::path file(path);
    const std::string name = file.filename().string();
    if (name.size() <= kMostName && name.size() + ending.size() > kMostName) {
        return (file.parent_path() / (name.substr(0, kMostName - ending.size()) + ending)).string();
    }
    return path + ending;
}

/// NAME.partial-DIGITS-DIGITS
bool is_partial_name(const std::string& name) {
    const std::size_t at = name.rfind(kPartial);
    if (at == 0 || at == std::string::npos) {
        return false;
    }
    const std::string numbers = name.substr(at + std::char_traits<char>::length(kPartial));
    const std::size_t dash = numbers.find('-');
    return dash != 0 && dash != std::string::npos && dash + 1 < numbers.size() &&
           numbers.find_first_not_of("0123456789-") == std::string::npos &&
           numbers.find('-', dash + 1) == std::string::npos;
}

/// Removes a regular file, unless another process is writing it. It goes while it is locked, so
/// that one who has just made it finds out (see lock()).
void remove_abandoned(const std::string& name) {
    const int file = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        return;
    }
    struct stat status {};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
        ::flock(file, LOCK_EX | LOCK_NB) == 0) {
        ::unlink(name.c_str());
    }
    ::close(file);
}

/// Locks a file that was just made; false if another process took it for abandoned before that.
bool lock(int file) {
    ::flock(file, LOCK_EX); // others hold it for a moment only
    struct stat status {};
    return ::fstat(file, &status) != 0 || status.st_nlink > 0;
}

} // namespace

// A signal may come between any two lines, and on another thread: the name is in the list before
// the file is there, and a file that is made after the list was read goes at once.
PartialFile::PartialFile(const std::string& path) {
    for (int i = 0; i < kAttempts && file_ < 0; ++i) {
        name_ = partial_name(path);
        place_ = remember_droppable(name_.c_str());
        file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file_ < 0) {
            const bool is_there = errno == EEXIST;
            forget_droppable(place_);
            if (!is_there) {
                return;
            }
        } else if (!lock(file_)) {
            ::close(file_);
            file_ = -1;
            forget_droppable(place_);
        }
    }
    if (file_ >= 0 && dropped) {
        ::unlink(name_.c_str());
    }
}

PartialFile::~PartialFile() {
    if (file_ < 0) {
        return;
    }
    ::unlink(name_.c_str()); // if it has not been renamed
    forget_droppable(place_);
    ::close(file_);
}

bool PartialFile::takes_a_byte() const {
    return ::write(file_, "\n", 1) == 1;
}

void remove_partial_files(const std::string& folder) {
    namespace fs = std::filesystem;
    std::vector<std::string> left;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (is_partial_name(at->path().filename().string())) {
            left.push_back(at->path().string());
        }
    }
    for (const std::string& name : left) {
        remove_abandoned(name);
    }
}

void drop_partial_files() {
    dropped = true;
    for (const Droppable& droppable : droppables) {
        const char* const name = droppable.name;
        if (name != nullptr && droppable.owner == ::getpid()) {
            ::unlink(name);
        }
    }
}

} // namespace degs
