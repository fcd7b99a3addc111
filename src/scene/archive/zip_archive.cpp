// SPDX-License-Identifier: Apache-2.0
#include "scene/archive/zip_archive.hpp"

#include <set>

#include <zip.h>

#include "base/visible_text.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::int64_t kMaxFiles = 10000;
constexpr std::uint64_t kMaxInflation = 1032; ///< deflate cannot do better

struct CloseZipFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

std::string words_of_error(int code) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    std::string words = zip_error_strerror(&error);
    zip_error_fini(&error);
    return words;
}

/// Whether a file in an archive of `bytes` can have the sizes that the directory claims for it.
bool is_possible(const zip_stat_t& facts, std::uint64_t bytes) {
    return (facts.valid & ZIP_STAT_SIZE) != 0 && (facts.valid & ZIP_STAT_COMP_SIZE) != 0 &&
           facts.comp_size <= bytes && facts.size / kMaxInflation <= facts.comp_size;
}

} // namespace

void ZipArchive::Close::operator()(zip* archive) const {
    zip_discard(archive);
}

ZipArchive::ZipArchive(const std::string& path) : path_(path), bytes_(InputFile(path).size()) {
    int code = 0;
    archive_.reset(zip_open(path.c_str(), ZIP_RDONLY, &code));
    if (!archive_) {
        fail_file(path, "its zip directory cannot be read (" + visible(words_of_error(code)) +
                            "); the file is truncated or damaged.");
    }
    const std::int64_t files = zip_get_num_entries(archive_.get(), 0);
    if (files > kMaxFiles) {
        fail_file(path, "the archive holds " + std::to_string(files) + " files; at most " +
                            std::to_string(kMaxFiles) + " are allowed.");
    }
    std::set<std::string> known;
    std::uint64_t plain = 0;
    for (std::int64_t i = 0; i < files; ++i) {
        zip_stat_t facts;
        zip_stat_init(&facts);
        if (zip_stat_index(archive_.get(), i, 0, &facts) == 0 && is_possible(facts, bytes_)) {
            plain += facts.size;
        }
    }
    require_sane_growth(path, "what it holds", bytes_, plain);
    for (const std::string& name : names()) {
        if (!known.insert(name).second) { // programs differ in which of them they read
            fail_file(path, "the archive holds '" + visible(name.substr(0, 100)) +
                                "' twice; every file needs a name of its own.");
        }
    }
}

std::vector<std::string> ZipArchive::names() const {
    std::vector<std::string> names;
    const std::int64_t files = zip_get_num_entries(archive_.get(), 0);
    for (std::int64_t i = 0; i < files; ++i) {
        const char* const name = zip_get_name(archive_.get(), i, ZIP_FL_ENC_RAW);
        names.emplace_back(name == nullptr ? "" : name);
    }
    return names;
}

bool ZipArchive::has(const std::string& name) const {
    return zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_ENC_RAW) >= 0;
}

std::string ZipArchive::read(const std::string& name, std::uint64_t limit_bytes) const {
    const std::string inside = "'" + visible(name.substr(0, 100)) + "' in the archive ";
    const std::int64_t index = zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_ENC_RAW);
    zip_stat_t facts;
    zip_stat_init(&facts);
    if (index < 0 || zip_stat_index(archive_.get(), index, 0, &facts) != 0) {
        fail_file(path_, "the archive holds no file '" + visible(name.substr(0, 100)) +
                             "', which the scene needs.");
    }
    if (!is_possible(facts, bytes_)) {
        fail_file(path_, inside + "claims a size that it cannot have; the file is damaged.");
    }
    if (facts.size > limit_bytes) {
        fail_file(path_, inside + "has " + std::to_string(facts.size) + " bytes; at most " +
                             std::to_string(limit_bytes) + " are allowed for it.");
    }
    if (facts.encryption_method != ZIP_EM_NONE ||
        (facts.comp_method != ZIP_CM_STORE && facts.comp_method != ZIP_CM_DEFLATE)) {
        fail_file(path_,
                  inside + "is encrypted or packed by a method other than store and deflate.");
    }
    const std::unique_ptr<zip_file_t, CloseZipFile> file(zip_fopen_index(archive_.get(), index, 0));
    std::string content(facts.size, '\0');
    std::uint64_t done = 0;
    while (file && done < content.size()) {
        const std::int64_t step =
            zip_fread(file.get(), content.data() + done, content.size() - done);
        if (step <= 0) {
            break;
        }
        done += step;
    }
    char more = 0; // the checksum is compared at the end
    if (!file || done < content.size() || zip_fread(file.get(), &more, 1) != 0) {
        fail_file(path_, inside + "cannot be unpacked; the file is truncated or damaged.");
    }
    return content;
}

} // namespace degs
