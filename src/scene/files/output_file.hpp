// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace degs {

/// InputError if the name of the file, without its folder, is longer than file systems allow.
void require_name_fits(const std::string& path);

/// Calls `write` with the name of a temporary file in the folder of `path`, then renames that
/// file to `path`: readers see the old file or the whole new one, also if the run is killed. If
/// `write` throws, the temporary file is removed. While a FileSet of the same thread lives, the set
/// renames it. InputError if the folder is missing, cannot be written, `path` is a folder, or this
/// command reads the file.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

/// As write_atomically(), and `write` puts the bytes of the file into a stream. InputError with the
/// reason if not all of them arrive.
void write_whole(const std::string& path, const std::function<void(std::ostream&)>& write);
/// As with a stream, for bytes that are there already.
void write_whole(const std::string& path, const std::string& bytes);

/// Why a file of write_atomically() has failed, by what the system said last: the end of a
/// sentence.
std::string why_unwritten();

/// Removes files of an earlier run, those that are there; folders stay. InputError, before any is
/// removed, if this command reads one of them, and if one cannot be removed.
void remove_results(const std::vector<std::string>& paths);

class PartialFile;

/// Files that tell of the same thing, so that they appear together or not at all.
class FileSet {
public:
    FileSet();
    /// Removes what has not been published.
    ~FileSet();
    FileSet(const FileSet&) = delete;
    FileSet& operator=(const FileSet&) = delete;

    /// Removes the files `old`, in this order, and puts those in place that write_atomically() has
    /// written since the set began. The first of `old` is put in place last, so that a folder in
    /// which it is there holds the whole set, even if the program is killed in between. Does
    /// nothing if nothing has been written. InputError if a file cannot be removed or put in place.
    void publish(const std::vector<std::string>& old);

private:
    friend void write_atomically(const std::string& path,
                                 const std::function<void(const std::string& temporary)>& write);
    struct Finished {
        std::unique_ptr<PartialFile> file;
        std::string path;
    };
    std::vector<Finished> files_;
    FileSet* before_; ///< the set that this one hides while it lives
};

/// Whether a file can be made in the folder and takes a byte.
bool takes_files(const std::string& folder);

/// Removes the temporary files that processes left in a folder when they were killed; those of
/// processes that still run stay.
void remove_partial_files(const std::string& folder);

/// Removes the temporary files of this process. May be called in a handler of signals.
void drop_partial_files();

} // namespace degs
