// SPDX-License-Identifier: Apache-2.0
// The built program as a child process, and the numbers that it reports. SystemC elaborates once
// per process, so every simulation is a run of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace degs::bench {

/// A folder of its own, gone afterwards.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// A scene, one of its cameras, and the size of the image.
struct View {
    std::string scene;
    int camera = 2;
    std::vector<std::string> size; ///< options, e.g. --width 320; empty: that of the camera
};

/// Runs the program and returns the JSON file that it has written. `cache`: the folder where it
/// keeps views; empty: nowhere. Throws std::runtime_error with what the program said if it fails.
nlohmann::json run_program(const std::vector<std::string>& arguments, const std::string& file,
                           const std::filesystem::path& cache = {});

/// report.json of `degs run` of a shipped design.
nlohmann::json run_design(const std::string& design, const View& view,
                          const std::vector<std::string>& more,
                          const std::filesystem::path& cache = {});

/// Where the trained scenes are; empty if they are not there.
std::filesystem::path trained_scenes();

} // namespace degs::bench
