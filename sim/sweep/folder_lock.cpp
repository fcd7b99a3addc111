// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/folder_lock.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace degs::sim {

FolderLock::FolderLock(const std::string& folder)
    : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}

FolderLock::~FolderLock() {
    if (file_ >= 0) {
        ::close(file_);
    }
}

bool FolderLock::lock(int operation) {
    int result = 0;
    do {
        result = file_ < 0 ? 0 : ::flock(file_, operation);
    } while (result != 0 && errno == EINTR);
    return result == 0 || errno != EWOULDBLOCK;
}

bool FolderLock::take_alone() {
    return lock(LOCK_EX | LOCK_NB);
}

void FolderLock::share() {
    lock(LOCK_SH);
}

} // namespace degs::sim
