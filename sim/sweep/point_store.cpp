// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/point_store.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/cache/digest.hpp"
#include "sim/report/report.hpp"
#include "sim/results/message_fields.hpp"
#include "sim/sweep/sweep_results.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;
using config_words::quote;
using nlohmann::ordered_json;

constexpr const char* kState = "study.json";
constexpr const char* kStudySchema = "degs-study";
constexpr int kPointVersion = 2;
constexpr const char* kPointFile = ".point";
constexpr const char* kFailedFile = ".failed";
constexpr const char* kReportFile = ".json";
constexpr const char* kReportOfPath = "-path.json";
constexpr const char* kChecksumWord = "checksum ";

/// Empty if there is no such file. InputError for what may block or never end.
std::optional<std::string> read_whole(const std::string& path) {
    std::error_code none;
    const fs::file_status status = fs::status(path, none);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw InputError(path + ": this is not a regular file, as those in the folder of a study "
                                "are; remove it, or choose another folder with --out.");
    }
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return file ? std::optional(text.str()) : std::nullopt;
}

ordered_json state_of(const StudyPlan& plan) {
    return {{"schema", {{"name", kStudySchema}, {"version", kPointVersion}}},
            {"tool", tool_json()},
            {"study", plan.name},
            {"points", plan.points.size()},
            {"digest", plan.digest}};
}

[[noreturn]] void refuse(const std::string& folder, const std::string& reason) {
    throw InputError("The output folder " + quote(folder) + " " + reason +
                     "; choose another folder with --out, or remove this one.");
}

/// Before anything is written to it.
std::string checked(const std::string& folder) {
    const fs::path path(folder);
    const std::optional<std::string> state = read_whole((path / kState).string());
    if (state) {
        const ordered_json json = parse_ordered_json(*state);
        const bool ours = json.is_object() && json.contains("schema") &&
                          json["schema"].is_object() && json["schema"].contains("name") &&
                          json["schema"]["name"] == kStudySchema;
        if (!ours) {
            refuse(folder, "holds a " + quote(kState) + " that is not a study's");
        }
    }
    std::error_code none;
    std::vector<std::string> results = sweep_files();
    results.insert(results.end(), {"points", "reports", "compare.json"});
    for (const std::string& file : results) {
        if (!state && fs::exists(path / file, none)) {
            refuse(folder, "holds " + quote(file) + ", but no " + quote(kState) +
                               " that says which study it is of");
        }
    }
    return folder;
}

/// Whether a file has the name of a report.
bool is_report(const std::string& file) {
    const std::size_t digits = std::min(file.find_first_not_of("0123456789"), file.size());
    const std::string ending = file.substr(digits);
    return digits >= 6 && (ending == kReportFile || ending == kReportOfPath);
}

/// Before the folder says that it is of another study.
void remove_results(const OutputFolder& folder) {
    std::error_code none;
    std::vector<std::string> old = sweep_files();
    const std::vector<std::string> of_search = search_files();
    if (fs::exists(folder.path(of_search.front()), none)) { // else they are the user's
        old.insert(old.end(), of_search.begin(), of_search.end());
    }
    for (const auto& file : fs::directory_iterator(folder.path("reports"), none)) {
        const std::string name = file.path().filename().string();
        if (is_report(name)) {
            old.push_back("reports/" + name);
        }
    }
    folder.remove(old);
}

/// Makes the folder one of this study, and returns what it says then. Of a killed sweep, processes
/// may be left for a moment.
std::string begun(const OutputFolder& folder, const StudyPlan& plan, FolderLock& lock,
                  Steps steps) {
    constexpr int kMostTries = 20;
    constexpr std::chrono::milliseconds kPause(50);
    const std::string name = folder.path(kState);
    std::string state = json_text(state_of(plan));
    if (steps == Steps::Several) {
        lock.share();
        if (read_whole(name) != state) {
            folder.write_text(kState, state);
        }
        return state;
    }
    for (int k = 0; k < kMostTries && read_whole(name) != state; ++k) {
        if (lock.take_alone()) {
            if (read_whole(name) != state) {
                remove_results(folder);
                folder.write_text(kState, state);
            }
            break;
        }
        std::this_thread::sleep_for(kPause);
    }
    lock.share();
    if (read_whole(name) != state) {
        refuse(folder.path(""), "is in use for another study");
    }
    return state;
}

/// The line that ends a file of the store.
std::string checksum_line(const std::string& text) {
    Digest digest;
    digest.add(text);
    return kChecksumWord + digest.text() + "\n";
}

std::string sealed(const std::string& text) {
    return text + checksum_line(text);
}

/// What was sealed; empty if a byte of it has changed.
std::optional<std::string> unsealed(const std::string& file) {
    const std::size_t bytes = checksum_line("").size();
    if (file.size() < bytes) {
        return {};
    }
    std::string text = file.substr(0, file.size() - bytes);
    return file.compare(text.size(), bytes, checksum_line(text)) == 0
               ? std::optional(std::move(text))
               : std::nullopt;
}

std::string file_of(std::size_t point, const char* ending) {
    char name[64];
    std::snprintf(name, sizeof name, "%06zu%s", point + 1, ending);
    return name;
}

void remove_partial(const fs::path& folder) {
    std::error_code none;
    for (const fs::directory_entry& file : fs::directory_iterator(folder, none)) {
        if (file.path().filename().string().find(".partial-") != std::string::npos) {
            fs::remove(file.path(), none);
        }
    }
}

/// The fields of a point's file.
template <class Fields, class Text>
void each_part(Fields& fields, Text& frame, Text& path) {
    fields("frame", frame);
    fields("path", path);
}

} // namespace

PointStore::PointStore(const std::string& folder, const StudyPlan& plan, Steps steps)
    : folder_(checked(folder), sweep_files()), lock_(folder),
      state_(begun(folder_, plan, lock_, steps)), points_(folder_.path("points"), {}),
      reports_(folder_.path("reports"), {}) {
    for (const StudyPoint& point : plan.points) {
        keys_.push_back(point.key);
    }
}

void PointStore::require_own() const {
    if (read_whole(folder_.path(kState)) != state_) {
        refuse(folder_.path(""), "is of another study by now");
    }
}

std::string PointStore::heading(std::size_t point) const {
    return "degs-point " + std::to_string(kPointVersion) + " " + keys_[point];
}

std::string PointStore::report_of(std::size_t point) {
    return "reports/" + file_of(point, kReportFile);
}

std::optional<StoredPoint> PointStore::read(std::size_t point) const {
    const std::optional<std::string> file = read_whole(points_.path(keys_[point] + kPointFile));
    const std::optional<std::string> text = file ? unsealed(*file) : std::nullopt;
    if (!text) {
        return {};
    }
    try {
        MessageReader reader(heading(point), *text);
        std::string frame;
        std::string path;
        each_part(reader, frame, path);
        reader.expect_nothing_left();
        StoredPoint found{summary_from(frame), {}};
        if (!path.empty()) {
            found.path = summary_from(path);
        }
        return found;
    } catch (const std::runtime_error&) { // of another version
        return {};
    }
}

bool PointStore::is_damaged(std::size_t point) const {
    std::error_code none;
    return fs::exists(points_.path(keys_[point] + kPointFile), none) && !read(point);
}

std::optional<Failure> PointStore::failure(std::size_t point) const {
    const std::optional<std::string> file = read_whole(points_.path(keys_[point] + kFailedFile));
    const std::optional<std::string> text = file ? unsealed(*file) : std::nullopt;
    if (!text || text->size() < 2) {
        return {};
    }
    return Failure{text->front() == '2' ? kUserError : kInternalError, text->substr(2)};
}

void PointStore::keep(std::size_t point, const StoredPoint& found) const {
    const std::string frame = message_of(found.frame);
    const std::string path = found.path ? message_of(*found.path) : "";
    MessageWriter writer(heading(point));
    each_part(writer, frame, path);
    points_.write_text(keys_[point] + kPointFile, sealed(writer.message));
    points_.remove({keys_[point] + kFailedFile});
}

void PointStore::keep_failure(std::size_t point, const Failure& failure) const {
    points_.write_text(keys_[point] + kFailedFile,
                       sealed(std::to_string(failure.code) + " " + failure.sentence));
}

void PointStore::put_reports(std::size_t point, const std::optional<StoredPoint>& found) const {
    const auto put = [this](const std::string& file, const std::string* report) {
        if (report == nullptr) {
            reports_.remove({file});
        } else if (read_whole(reports_.path(file)) != *report) {
            reports_.write_text(file, *report);
        }
    };
    put(file_of(point, kReportFile), found ? &found->frame.report : nullptr);
    put(file_of(point, kReportOfPath), found && found->path ? &found->path->report : nullptr);
}

void PointStore::sweep_up() const {
    for (const OutputFolder* folder : {&folder_, &points_, &reports_}) {
        remove_partial(folder->path(""));
    }
    drop_other_reports();
}

void PointStore::drop_other_reports() const {
    std::error_code none;
    for (std::size_t point = keys_.size();
         fs::exists(reports_.path(file_of(point, kReportFile)), none); ++point) {
        reports_.remove({file_of(point, kReportFile), file_of(point, kReportOfPath)});
    }
}

} // namespace degs::sim
