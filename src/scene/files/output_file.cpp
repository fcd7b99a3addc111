// SPDX-License-Identifier: Apache-2.0
#include "scene/files/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include <unistd.h>

#include "config/input_files.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/partial_file.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

thread_local FileSet* current_set = nullptr;

/// What a command reads, no result replaces.
void refuse_input(const std::string& path) {
    if (const std::optional<std::string> input = input_at(path)) {
        fail_file(path, "a result would replace '" + *input +
                            "', which this command reads; choose another name.");
    }
}

void check_target(const std::string& path) {
    std::error_code error;
    if (path.empty()) {
        fail_file("''", "an output file needs a name.");
    }
    require_name_fits(path);
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) { // never rename over a device
        fail_file(path, "this is a folder or device, and the name of a file to write is needed.");
    }
    const fs::path parent = fs::path(path).parent_path();
    if (!parent.empty() && !fs::is_directory(parent, error)) {
        fail_file(path, "the folder '" + parent.string() + "' does not exist; create it first.");
    }
    refuse_input(path);
}

void put_in_place(const PartialFile& file, const std::string& path) {
    std::error_code error;
    fs::rename(file.name(), path, error);
    if (error) {
        fail_file(path, "the finished file cannot be put in its place (" + error.message() + ").");
    }
}

/// No signal ends the program between the files of a set.
class HeldSignals {
public:
    HeldSignals() {
        sigset_t all;
        sigfillset(&all);
        ::pthread_sigmask(SIG_BLOCK, &all, &before_);
    }
    ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

private:
    sigset_t before_{};
};

} // namespace

FileSet::FileSet() : before_(current_set) {
    current_set = this;
}

FileSet::~FileSet() {
    current_set = before_;
}

void FileSet::publish(const std::vector<std::string>& old) {
    if (files_.empty()) {
        return;
    }
    const HeldSignals held;
    remove_results(old);
    std::stable_partition(files_.begin(), files_.end(), [&old](const Finished& finished) {
        return old.empty() || finished.path != old.front();
    });
    for (const Finished& finished : files_) {
        put_in_place(*finished.file, finished.path);
    }
    files_.clear();
}

void require_name_fits(const std::string& path) {
    const std::size_t bytes = fs::path(path).filename().string().size();
    if (bytes > kMostName) {
        fail_file(path, "the name of this file has " + std::to_string(bytes) + " bytes; at most " +
                            std::to_string(kMostName) + " are allowed.");
    }
}

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
    check_target(path);
    auto file = std::make_unique<PartialFile>(path);
    if (!file->exists()) {
        fail_file(path, "the file cannot be written, " + why_unwritten() + ".");
    }
    errno = 0;
    write(file->name());
    if (current_set != nullptr) {
        current_set->files_.push_back({std::move(file), path});
    } else {
        put_in_place(*file, path);
    }
}

void write_whole(const std::string& path, const std::function<void(std::ostream&)>& write) {
    write_atomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        write(out);
        out.close();
        if (!out) {
            fail_file(path, "the file could not be written completely, " + why_unwritten() + ".");
        }
    });
}

void write_whole(const std::string& path, const std::string& bytes) {
    write_whole(path, [&bytes](std::ostream& out) { out << bytes; });
}

std::string why_unwritten() {
    const int reason = errno;
    switch (reason) {
    case EMFILE:
    case ENFILE:
        return "because too many files are open ('ulimit -n' says how many may be)";
    case EFBIG:
        return "because the file would be larger than is allowed ('ulimit -f' says how large)";
    case ENAMETOOLONG:
        return "because its name is too long";
    case EACCES:
    case EPERM:
    case EROFS:
        return "because its folder may not be written to";
    case 0:
    case ENOSPC:
    case EDQUOT:
        return "because the disk may be full";
    default:
        return "because the system says: " + std::generic_category().message(reason);
    }
}

void remove_results(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        refuse_input(path);
    }
    for (const std::string& path : paths) {
        if (::unlink(path.c_str()) != 0 && errno != ENOENT && errno != ENOTDIR && errno != EISDIR) {
            fail_file(path, "the file of an earlier run cannot be removed (" +
                                std::generic_category().message(errno) + ").");
        }
    }
}

bool takes_files(const std::string& folder) {
    const PartialFile probe((fs::path(folder) / ".degs-probe").string());
    return probe.exists() && probe.takes_a_byte();
}

} // namespace degs
