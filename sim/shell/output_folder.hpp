// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace degs::sim {

/// The folder that receives results. It is created, and writing to it is tried, before anything
/// long starts.
class OutputFolder {
public:
    /// Creates the folder and removes what killed processes have left half written there; throws
    /// InputError if that fails, if nothing can be written there, or if one of `files` is there and
    /// not a file, is an input of this process, or belongs to another folder that lives. The first
    /// of `files` is the document of the results: without it, the folder holds none.
    OutputFolder(std::string folder, const std::vector<std::string>& files);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    std::string path(const std::string& file) const;
    /// Writes the file whole or not at all.
    void write_text(const std::string& file, const std::string& text) const;
    /// Writes the value as json_text() shows it, whole or not at all.
    void write_json(const std::string& file, const nlohmann::ordered_json& value) const;
    /// Removes files of an earlier run, those that are there. Throws InputError, before any is
    /// removed, if one of them is an input of this process.
    void remove(const std::vector<std::string>& files) const;
    /// Calls `write`, then puts the files that it has written in the place of all `files` and of
    /// `others` (paths): the folder holds the results before or after, or no document. Does nothing
    /// else if `write` throws or writes nothing.
    void replace(const std::function<void()>& write,
                 const std::vector<std::string>& others = {}) const;
    /// The paths of the files.
    const std::vector<std::string>& paths() const { return paths_; }

private:
    std::string folder_;
    std::vector<std::string> paths_;
};

/// The folder of a file; "." if its path has none.
std::string parent_folder(const std::string& file);

/// Throws InputError if `path`, which is going to be written, is an input of this process or a file
/// of an OutputFolder that lives; also under another spelling of its path, or through a link.
void refuse_output_in_use(const std::string& path);

/// The files of a command that draws an image and writes `document`. The document of another such
/// command is among them: it does not tell of the new image.
std::vector<std::string> image_result_files(const std::string& document);

/// The file of a view of a frame: NAME and its ending, with the number of the view in between but
/// for the first one: image.exr, image-1.exr.
std::string view_file(const std::string& name, std::size_t view, const std::string& ending);

/// A document as it is written to a file; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& value);

} // namespace degs::sim
