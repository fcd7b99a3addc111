// SPDX-License-Identifier: Apache-2.0
#include "config/nearby_file.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "config/config_words.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNames = 10000; ///< of a folder that are looked at

/// In the order of their names, so that the answer does not depend on the file system.
std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator() && names.size() < kMostNames;
         entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

std::string nearby_file(const std::string& path) {
    const fs::path wanted(path);
    const fs::path folder = wanted.parent_path();
    const std::vector<std::string> names = names_in(folder.empty() ? fs::path(".") : folder);
    const auto extended = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return fs::path(name).stem() == wanted.filename();
    });
    const std::string name = extended != names.end()
                                 ? *extended
                                 : config_words::nearest(wanted.filename().string(), names);
    return name.empty() ? "" : " (did you mean '" + (folder / name).string() + "'?)";
}

} // namespace degs
