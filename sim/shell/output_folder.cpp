// SPDX-License-Identifier: Apache-2.0
#include "sim/shell/output_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/input_files.hpp"
#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_folder(const std::string& folder, const std::string& reason) {
    throw InputError("The output folder '" + folder + "' cannot be used: " + reason + ".");
}

/// The files of the folders that live; a file may be in it twice.
std::vector<std::string>& claimed_outputs() {
    static std::vector<std::string> paths;
    return paths;
}

/// Whether both names stand for one file, or will when it is written.
bool same_output(const std::string& a, const std::string& b) {
    const auto identity = identity_of_file(a);
    if (identity && identity == identity_of_file(b)) {
        return true;
    }
    std::error_code error;
    return fs::weakly_canonical(absolute_path(a), error) ==
           fs::weakly_canonical(absolute_path(b), error);
}

} // namespace

std::string parent_folder(const std::string& file) {
    const std::string folder = fs::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
}

void refuse_output_in_use(const std::string& path) {
    const auto refuse = [&path](const std::string& other, const char* why) {
        throw InputError("The output file '" + path + "' would replace '" + other + "', which " +
                         why);
    };
    if (const std::optional<std::string> input = input_at(path)) {
        refuse(*input, "this command reads; choose another name.");
    }
    for (const std::string& claimed : claimed_outputs()) {
        if (same_output(path, claimed)) {
            refuse(claimed, "this command writes as well; choose another name.");
        }
    }
}

OutputFolder::OutputFolder(std::string folder, const std::vector<std::string>& files)
    : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error || !fs::is_directory(folder_, error)) {
        fail_folder(folder_, error ? error.message() : "it is a file");
    }
    for (const std::string& file : files) {
        const std::string name = path(file);
        require_name_fits(name);
        // Asked once: another part of a search may take the file away between two questions.
        const fs::file_status status = fs::status(name, error);
        if (fs::exists(status) && !fs::is_regular_file(status)) {
            fail_folder(folder_, "'" + file + "' in it is not a file");
        }
        refuse_output_in_use(name);
        paths_.push_back(name);
    }
    remove_partial_files(folder_);
    if (!takes_files(folder_)) {
        fail_folder(folder_, "nothing can be written there");
    }
    claimed_outputs().insert(claimed_outputs().end(), paths_.begin(), paths_.end());
}

OutputFolder::~OutputFolder() {
    std::vector<std::string>& claimed = claimed_outputs();
    for (const std::string& path : paths_) {
        const auto mine = std::find(claimed.begin(), claimed.end(), path);
        if (mine != claimed.end()) {
            claimed.erase(mine);
        }
    }
}

std::string OutputFolder::path(const std::string& file) const {
    return (fs::path(folder_) / file).string();
}

void OutputFolder::write_text(const std::string& file, const std::string& text) const {
    write_whole(path(file), text);
}

void OutputFolder::write_json(const std::string& file, const nlohmann::ordered_json& value) const {
    write_text(file, json_text(value));
}

void OutputFolder::remove(const std::vector<std::string>& files) const {
    std::vector<std::string> paths;
    paths.reserve(files.size());
    for (const std::string& file : files) {
        paths.push_back(path(file));
    }
    remove_results(paths);
}

void OutputFolder::replace(const std::function<void()>& write,
                           const std::vector<std::string>& others) const {
    FileSet files;
    write();
    std::vector<std::string> old = paths_;
    old.insert(old.end(), others.begin(), others.end());
    files.publish(old);
}

std::vector<std::string> image_result_files(const std::string& document) {
    std::vector<std::string> files{document};
    for (const char* const other : {"report.json", "render.json", "analytic.json"}) {
        if (document != other) {
            files.emplace_back(other);
        }
    }
    files.insert(files.end(), {"image.exr", "image.png"});
    return files;
}

std::string view_file(const std::string& name, std::size_t view, const std::string& ending) {
    return name + (view == 0 ? "" : "-" + std::to_string(view)) + ending;
}

std::string json_text(const nlohmann::ordered_json& value) {
    return dump_json(value, 2) + "\n";
}

} // namespace degs::sim
