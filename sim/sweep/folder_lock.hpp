// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// The right to use a folder, until the process ends it or is killed. On file systems without locks
/// everybody has it.
class FolderLock {
public:
    explicit FolderLock(const std::string& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    /// Takes the folder for this process alone; false if others use it.
    bool take_alone();
    /// Waits for one that has the folder alone, and shares it.
    void share();

private:
    bool lock(int operation);

    int file_ = -1;
};

} // namespace degs::sim
