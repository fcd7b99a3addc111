// SPDX-License-Identifier: Apache-2.0
#include "scene/output_file.hpp"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <random>

#include "scene/input_file.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

/// Unique among the threads of this process and, by its random part, among processes.
std::string temporary_name(const std::string& path) {
    static const unsigned process = std::random_device{}();
    static std::atomic<unsigned> next{0};
    return path + ".partial-" + std::to_string(process) + "-" + std::to_string(next++);
}

/// Removes the file unless it has been renamed away.
class Temporary {
public:
    explicit Temporary(std::string name) : name_(std::move(name)) {}
    ~Temporary() {
        std::error_code ignored;
        fs::remove(name_, ignored);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const std::string& name() const { return name_; }

private:
    std::string name_;
};

void check_target(const std::string& path) {
    std::error_code error;
    if (path.empty()) {
        fail_file("''", "an output file needs a name.");
    }
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) { // never rename over a device
        fail_file(path, "this is a folder or device, and the name of a file to write is needed.");
    }
    const fs::path parent = fs::path(path).parent_path();
    if (!parent.empty() && !fs::is_directory(parent, error)) {
        fail_file(path, "the folder '" + parent.string() + "' does not exist; create it first.");
    }
}

} // namespace

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
    check_target(path);
    const Temporary temporary(temporary_name(path));
    if (!std::ofstream(temporary.name(), std::ios::binary)) {
        fail_file(path, "the file cannot be written; check the permissions of its folder.");
    }
    write(temporary.name());
    std::error_code error;
    fs::rename(temporary.name(), path, error);
    if (error) {
        fail_file(path, "the finished file cannot be put in its place (" + error.message() + ").");
    }
}

} // namespace degs
