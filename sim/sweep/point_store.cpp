// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/point_store.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/config_words.hpp"
#include "config/error.hpp"
#include "sim/compare/message_fields.hpp"
#include "sim/report.hpp"
#include "sim/sweep/sweep_results.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;
using config_words::quote;
using nlohmann::ordered_json;

constexpr const char* kState = "study.json";
constexpr int kPointVersion = 1;

/// Empty if there is no such file.
std::optional<std::string> read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return file ? std::optional(text.str()) : std::nullopt;
}

ordered_json state_of(const StudyPlan& plan) {
    return {{"schema", {{"name", "degs-study"}, {"version", kPointVersion}}},
            {"tool", tool_json()},
            {"study", plan.name},
            {"points", plan.points.size()},
            {"digest", plan.digest}};
}

[[noreturn]] void refuse(const std::string& folder, const std::string& reason) {
    throw InputError("The output folder " + quote(folder) + " " + reason +
                     "; choose another folder with --out, or remove this one.");
}

/// "the study 'buffers' of 36 points", as far as the file says.
std::string study_words(const std::string& state) {
    const ordered_json json = ordered_json::parse(state, nullptr, false);
    if (!json.is_object() || !json.contains("study") || !json.contains("points")) {
        return "a study that cannot be read";
    }
    const ordered_json& name = json["study"];
    return "the study " + quote(name.is_string() ? name.get<std::string>() : name.dump()) + " of " +
           json["points"].dump() + " points";
}

/// Before anything is written to it.
std::string checked(const std::string& folder, const StudyPlan& plan) {
    const fs::path path(folder);
    const std::optional<std::string> state = read_whole((path / kState).string());
    if (state && *state != json_text(state_of(plan))) {
        refuse(folder, "holds " + study_words(*state) +
                           ", which differs from this one in its points or in the program's "
                           "version");
    }
    std::error_code none;
    std::vector<std::string> ours = sweep_files();
    ours.insert(ours.end(), {"points", "reports", "compare.json"});
    for (const std::string& file : ours) {
        if (!state && fs::exists(path / file, none)) {
            refuse(folder, "holds " + quote(file) + ", but no " + quote(kState) +
                               " that says which study it is of");
        }
    }
    return folder;
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
template <class Fields>
void each_part(Fields& fields, std::string& frame, std::string& path) {
    fields("frame", frame);
    fields("path", path);
}

} // namespace

PointStore::PointStore(const std::string& folder, const StudyPlan& plan)
    : folder_(checked(folder, plan), sweep_files()), points_(folder_.path("points"), {}),
      reports_(folder_.path("reports"), {}), digest_(plan.digest) {
    if (!fs::exists(folder_.path(kState))) {
        folder_.write_json(kState, state_of(plan));
    }
}

std::string PointStore::heading() const {
    return "degs-point " + std::to_string(kPointVersion) + " " + digest_;
}

std::string PointStore::report_of(std::size_t point) {
    return "reports/" + file_of(point, ".json");
}

std::optional<StoredPoint> PointStore::read(std::size_t point) const {
    const std::optional<std::string> text = read_whole(points_.path(file_of(point, ".point")));
    if (!text) {
        return {};
    }
    try {
        MessageReader reader(heading(), *text);
        std::string frame;
        std::string path;
        each_part(reader, frame, path);
        reader.expect_nothing_left();
        StoredPoint found{summary_from(frame), {}};
        if (!path.empty()) {
            found.path = summary_from(path);
        }
        return found;
    } catch (const std::runtime_error&) { // cut off when the machine stopped
        return {};
    }
}

std::optional<Failure> PointStore::failure(std::size_t point) const {
    const std::optional<std::string> text = read_whole(points_.path(file_of(point, ".failed")));
    if (!text || text->size() < 2) {
        return {};
    }
    return Failure{text->front() == '2' ? kUserError : kInternalError, text->substr(2)};
}

void PointStore::keep(std::size_t point, const StoredPoint& found) const {
    StoredPoint kept = found;
    reports_.write_text(file_of(point, ".json"), found.frame.report);
    kept.frame.report.clear();
    std::string frame = message_of(kept.frame);
    std::string path;
    if (kept.path) {
        reports_.write_text(file_of(point, "-path.json"), kept.path->report);
        kept.path->report.clear();
        path = message_of(*kept.path);
    }
    MessageWriter writer(heading());
    each_part(writer, frame, path);
    points_.write_text(file_of(point, ".point"), writer.message);
    std::error_code none;
    fs::remove(points_.path(file_of(point, ".failed")), none);
}

void PointStore::keep_failure(std::size_t point, const Failure& failure) const {
    points_.write_text(file_of(point, ".failed"),
                       std::to_string(failure.code) + " " + failure.sentence);
}

void PointStore::sweep_up() const {
    for (const OutputFolder* folder : {&folder_, &points_, &reports_}) {
        remove_partial(folder->path(""));
    }
}

} // namespace degs::sim
