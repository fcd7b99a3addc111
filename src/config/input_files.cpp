// SPDX-License-Identifier: Apache-2.0
#include "config/input_files.hpp"

#include <map>
#include <mutex>

#include <sys/stat.h>

namespace degs {
namespace {

struct Inputs {
    std::mutex mutex;
    std::map<FileIdentity, std::string> names;
};

Inputs& inputs() {
    static Inputs known;
    return known;
}

} // namespace

std::optional<FileIdentity> identity_of_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return {};
    }
    return FileIdentity{status.st_dev, status.st_ino};
}

void remember_input(const std::string& path) {
    if (const std::optional<FileIdentity> identity = identity_of_file(path)) {
        Inputs& known = inputs();
        const std::lock_guard<std::mutex> lock(known.mutex);
        known.names.insert_or_assign(*identity, path);
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
