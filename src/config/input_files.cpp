// SPDX-License-Identifier: Apache-2.0
#include "config/input_files.hpp"

#include <map>
#include <mutex>
#include <tuple>

#include <sys/stat.h>

#include "degs/error.hpp"

namespace degs {
namespace {

struct Inputs {
    bool spared = false;
    std::mutex mutex;
    std::map<FileIdentity, std::string> names;
};

Inputs& inputs() {
    static Inputs known;
    return known;
}

/// What a file is at a moment: device, inode, size and date.
using Stamp = std::tuple<dev_t, ino_t, off_t, time_t, long>;

std::optional<Stamp> stamp_of(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return {};
    }
    return Stamp{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                 status.st_mtim.tv_nsec};
}

struct WatchedFile {
    Stamp first;
    bool changed = false;     ///< when it was opened again
    std::uint64_t opened = 0; ///< the last time
};

struct Watched {
    std::mutex mutex;
    int watches = 0;
    std::uint64_t openings = 0;
    std::map<std::string, WatchedFile> files;
};

Watched& watched() {
    static Watched all;
    return all;
}

} // namespace

std::optional<FileIdentity> identity_of_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return {};
    }
    return FileIdentity{status.st_dev, status.st_ino};
}

void spare_inputs() {
    Inputs& known = inputs();
    const std::lock_guard<std::mutex> lock(known.mutex);
    known.spared = true;
    known.names.clear(); // a fork of a server is a new command
}

void remember_input(const std::string& path) {
    const std::optional<FileIdentity> identity = identity_of_file(path);
    Inputs& known = inputs();
    const std::lock_guard<std::mutex> lock(known.mutex);
    if (identity && known.spared) {
        known.names.insert_or_assign(*identity, path);
    }
}

void watch_input(const std::string& path) {
    Watched& all = watched();
    const std::lock_guard<std::mutex> lock(all.mutex);
    const std::optional<Stamp> stamp = all.watches > 0 ? stamp_of(path) : std::nullopt;
    if (stamp) {
        WatchedFile& file = all.files.try_emplace(path, WatchedFile{*stamp}).first->second;
        file.changed = file.changed || file.first != *stamp;
        file.opened = ++all.openings;
    }
}

InputWatch::InputWatch() {
    Watched& all = watched();
    const std::lock_guard<std::mutex> lock(all.mutex);
    ++all.watches;
    begin_ = all.openings;
}

InputWatch::~InputWatch() {
    Watched& all = watched();
    const std::lock_guard<std::mutex> lock(all.mutex);
    if (--all.watches == 0) {
        all.files.clear();
    }
}

void InputWatch::require_unchanged() const {
    Watched& all = watched();
    const std::lock_guard<std::mutex> lock(all.mutex);
    for (auto& [path, file] : all.files) {
        if (file.opened <= begin_) {
            continue;
        }
        const std::optional<Stamp> now = stamp_of(path);
        file.changed = file.changed || (now && *now != file.first);
        if (file.changed) {
            throw InputError(path + ": the file changed while it was being read, so nothing is "
                                    "kept of it; the command can be run again once the file is "
                                    "complete.");
        }
    }
}

std::optional<std::string> input_at(const std::string& path) {
    const std::optional<FileIdentity> identity = identity_of_file(path);
    if (!identity) {
        return {};
    }
    Inputs& known = inputs();
    const std::lock_guard<std::mutex> lock(known.mutex);
    const auto found = known.names.find(*identity);
    // A system gives the number of a removed file to another.
    const bool same = found != known.names.end() && identity_of_file(found->second) == identity;
    return same ? std::optional(found->second) : std::nullopt;
}

} // namespace degs
