// SPDX-License-Identifier: Apache-2.0
#include "sim/output_folder.hpp"

#include <filesystem>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "config/error.hpp"
#include "scene/output_file.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_folder(const std::string& folder, const std::string& reason) {
    throw InputError("The output folder '" + folder + "' cannot be used: " + reason + ".");
}

} // namespace

OutputFolder::OutputFolder(std::string folder, const std::vector<std::string>& files)
    : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error || !fs::is_directory(folder_, error)) {
        fail_folder(folder_, error ? error.message() : "it is a file");
    }
    for (const std::string& file : files) {
        if (fs::exists(path(file), error) && !fs::is_regular_file(path(file), error)) {
            fail_folder(folder_, "'" + file + "' in it is not a file");
        }
    }
    const std::string probe = path(".degs-probe");
    const bool writable = std::ofstream(probe).put('\n').flush().good();
    fs::remove(probe, error);
    if (!writable) {
        fail_folder(folder_, "nothing can be written there");
    }
}

std::string OutputFolder::path(const std::string& file) const {
    return (fs::path(folder_) / file).string();
}

void OutputFolder::write_text(const std::string& file, const std::string& text) const {
    write_atomically(path(file), [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        out.close();
        if (!out) {
            fail_folder(folder_, "writing '" + file + "' failed, the disk may be full");
        }
    });
}

void OutputFolder::write_json(const std::string& file, const nlohmann::ordered_json& value) const {
    write_text(file, json_text(value));
}

std::string json_text(const nlohmann::ordered_json& value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace degs::sim
