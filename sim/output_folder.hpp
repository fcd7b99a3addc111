// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace degs::sim {

/// The folder that receives results. It is created, and writing to it is tried, before anything long starts.
class OutputFolder {
public:
    /// Creates the folder; throws InputError if that fails, if nothing can be written there, or if
    /// one of `files` is there and not a file.
    OutputFolder(std::string folder, const std::vector<std::string>& files);

    std::string path(const std::string& file) const;
    /// Writes the file whole or not at all.
    void write_text(const std::string& file, const std::string& text) const;
    /// Likewise, as json_text().
    void write_json(const std::string& file, const nlohmann::ordered_json& value) const;

private:
    std::string folder_;
};

/// A document as it is written to a file; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& value);

} // namespace degs::sim
