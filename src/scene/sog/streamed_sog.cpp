// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/streamed_sog.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/visible_text.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/scene_folder.hpp"
#include "scene/sog/sog.hpp"
#include "scene/sog/sog_index.hpp"
#include "scene/sog/sog_levels.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxIndexBytes = 1 << 24;
constexpr std::size_t kMostNotes = 5; ///< about single files; a scene may have hundreds

/// A SOG scene that the index names.
struct SogPart {
    std::string name; ///< as the index writes it, for messages
    std::string file;
    std::vector<SogRun> runs; ///< by offset, none overlapping; of the environment none: all of it
    std::vector<SogRun> all;  ///< of every level, by offset
};

struct SogPlan {
    std::vector<SogPart> parts;
    std::vector<std::string> notes;
};

std::string quoted_name(const std::string& name) {
    return "'" + visible(name.substr(0, 100)) + "'";
}

std::string file_of_part(const std::string& index, const std::string& name, const char* what) {
    return file_in_scene_folder(index, name, std::string(what) + " lies in " + quoted_name(name));
}

void sort_by_offset(std::vector<SogRun>& runs) {
    std::sort(runs.begin(), runs.end(),
              [](const SogRun& a, const SogRun& b) { return a.offset < b.offset; });
}

/// Else a small index could ask for one file a thousand times.
void refuse_shared_gaussians(const std::string& index, const SogPart& part) {
    for (std::size_t i = 1; i < part.runs.size(); ++i) {
        if (part.runs[i - 1].offset + part.runs[i - 1].count > part.runs[i].offset) {
            fail_file(index, "two leaves of its tree name Gaussian " +
                                 std::to_string(part.runs[i].offset) + " of " +
                                 quoted_name(part.name) +
                                 "; each may belong to one leaf at one level only.");
        }
    }
}

void refuse_shared_files(const std::string& index, const std::vector<SogPart>& parts) {
    std::set<std::string> seen;
    for (const SogPart& part : parts) {
        if (!seen.insert(part.file).second) {
            fail_file(index, "its lod-meta.json names the file of " + quoted_name(part.name) +
                                 " more than once; each may be named once only.");
        }
    }
}

SogPlan plan_of(const std::string& path, const SceneDetail& detail) {
    const SogIndex index = parse_sog_index(path, read_text(path, kMaxIndexBytes));
    SogPart environment;
    std::uint64_t beside = 0;
    if (!index.environment.empty()) {
        environment.name = index.environment;
        environment.file = file_of_part(path, index.environment, "its environment");
        constexpr std::uint64_t kMost = 0xFFFFFFFF; // reading refuses it; sums stay far from 2^64
        beside = std::min(sog_count(environment.file), kMost);
    }
    SogChoice choice = choose_sog_levels(path, index, detail, beside);
    std::map<std::size_t, std::vector<SogRun>> chosen, all;
    for (const SogRun& run : choice.runs) {
        chosen[run.file].push_back(run);
    }
    for (const SogLeaf& leaf : index.leaves) {
        for (const auto& [level, run] : leaf) {
            all[run.file].push_back(run);
        }
    }
    SogPlan plan;
    plan.notes = std::move(choice.notes);
    for (auto& [file, runs] : chosen) {
        const std::string& name = index.files[file];
        sort_by_offset(runs);
        sort_by_offset(all[file]);
        plan.parts.push_back({name, file_of_part(path, name, "one of its files"), std::move(runs),
                              std::move(all[file])});
        refuse_shared_gaussians(path, plan.parts.back());
    }
    if (!environment.file.empty()) {
        plan.parts.push_back(std::move(environment));
    }
    refuse_shared_files(path, plan.parts);
    return plan;
}

/// Gives every Gaussian harmonics of `degree`, of which those beyond its own are 0.
void raise_degree(GaussianCloud& cloud, int degree) {
    const auto old_pitch = static_cast<std::size_t>(cloud.sh_coefficients()) * 3;
    cloud.sh_degree = degree;
    const auto pitch = static_cast<std::size_t>(cloud.sh_coefficients()) * 3;
    std::vector<float> sh(cloud.size() * pitch, 0);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        std::copy_n(cloud.sh.begin() + static_cast<std::ptrdiff_t>(i * old_pitch), old_pitch,
                    sh.begin() + static_cast<std::ptrdiff_t>(i * pitch));
    }
    cloud.sh = std::move(sh);
}

template <class Value>
void append_range(std::vector<Value>& to, const std::vector<Value>& from, std::size_t begin,
                  std::size_t count) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(begin);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
}

/// Both clouds have one degree.
void append(GaussianCloud& to, const GaussianCloud& from, std::size_t begin, std::size_t count) {
    const auto pitch = static_cast<std::size_t>(from.sh_coefficients()) * 3;
    append_range(to.means, from.means, begin, count);
    append_range(to.scales, from.scales, begin, count);
    append_range(to.rotations, from.rotations, begin, count);
    append_range(to.opacities, from.opacities, begin, count);
    append_range(to.sh, from.sh, begin * pitch, count * pitch);
}

class StreamedReader {
public:
    explicit StreamedReader(const std::string& path) : path_(path) {}

    SceneContent read(const SceneDetail& detail) {
        SogPlan plan = plan_of(path_, detail);
        content_.notes = std::move(plan.notes);
        for (const SogPart& part : plan.parts) {
            add(part, read_sog(part.file));
        }
        if (unsaid_ > 0) {
            content_.notes.push_back("There are " + std::to_string(unsaid_) +
                                     " more warnings of files of this scene.");
        }
        if (mixed_) {
            content_.notes.emplace_back("Some files of the scene say that they were trained with "
                                        "antialiasing and others do not; all are drawn like the "
                                        "first.");
        }
        return std::move(content_);
    }

private:
    void add(const SogPart& part, SceneContent read) {
        for (const std::string& note : read.notes) {
            say(part, note);
        }
        mixed_ = mixed_ || (!first_ && read.traits.antialiased != content_.traits.antialiased);
        content_.traits = first_ ? read.traits : content_.traits;
        GaussianCloud& cloud = content_.cloud;
        if (first_ || read.cloud.sh_degree > cloud.sh_degree) {
            raise_degree(cloud, read.cloud.sh_degree);
        } else if (read.cloud.sh_degree < cloud.sh_degree) {
            raise_degree(read.cloud, cloud.sh_degree);
        }
        first_ = false;
        if (part.runs.empty()) {
            append(cloud, read.cloud, 0, read.cloud.size());
            return;
        }
        check_all(part, read.cloud.size());
        for (const SogRun& run : part.runs) {
            append(cloud, read.cloud, run.offset, run.count);
        }
    }

    void say(const SogPart& part, const std::string& note) {
        if (said_++ < kMostNotes) {
            content_.notes.push_back("In " + quoted_name(part.name) + ": " + note);
        } else {
            ++unsaid_;
        }
    }

    /// The runs of all levels must lie inside the file. A note says how many Gaussians no run
    /// names.
    void check_all(const SogPart& part, std::uint64_t gaussians) {
        std::uint64_t end = 0, named = 0;
        for (const SogRun& run : part.all) {
            if (run.offset + run.count > gaussians) {
                fail_file(path_, "a leaf of its tree names Gaussians " +
                                     std::to_string(run.offset) + " to " +
                                     std::to_string(run.offset + run.count - 1) + " of " +
                                     quoted_name(part.name) + ", which has " +
                                     std::to_string(gaussians) + ".");
            }
            const std::uint64_t begin = std::max(end, run.offset);
            end = std::max(end, run.offset + run.count);
            named += end - begin;
        }
        if (named < gaussians) {
            say(part, std::to_string(gaussians - named) +
                          " Gaussians belong to no leaf of the tree and are left out.");
        }
    }

    const std::string& path_;
    SceneContent content_;
    bool first_ = true;
    bool mixed_ = false; ///< files disagree about antialiasing
    std::size_t said_ = 0, unsaid_ = 0;
};

} // namespace

SceneContent read_streamed_sog(const std::string& path, const SceneDetail& detail) {
    return StreamedReader(path).read(detail);
}

std::vector<std::string> streamed_sog_files(const std::string& path, const SceneDetail& detail) {
    std::vector<std::string> files;
    for (const SogPart& part : plan_of(path, detail).parts) {
        files.push_back(part.file);
        for (std::string& image : sog_external_files(part.file)) {
            files.push_back(std::move(image));
        }
    }
    return files;
}

} // namespace degs
