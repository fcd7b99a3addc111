// SPDX-License-Identifier: Apache-2.0
// Built programs as child processes, and folders and scenes for them.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace degs::sim_test {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Where the trained scenes are.
inline fs::path trained_scenes() {
    const char* variable = std::getenv("DEGS_SCENES");
    return variable != nullptr ? fs::path(variable) : fs::path(DEGS_SCENES_DEFAULT);
}

/// A folder of its own for one test, gone afterwards.
class Folder {
public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "degs-sim-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string operator/(const std::string& file) const { return (path_ / file).string(); }

private:
    fs::path path_;
};

struct Outcome {
    int code = -1; ///< exit code, or -1 if a signal ended the program
    std::string out, err;
};

/// Runs a program and waits for it; `prepare` is called in the child before the program starts.
inline Outcome outcome_of(const char* program, const std::vector<std::string>& arguments,
                          const std::function<void()>& prepare = {}) {
    const Folder folder;
    const std::string out = folder / "out";
    const std::string err = folder / "err";
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        if (prepare) {
            prepare();
        }
        std::vector<char*> argv{const_cast<char*>(program)};
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        ::execv(program, argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

/// Runs the program `degs`.
inline Outcome degs(const std::vector<std::string>& arguments,
                    const std::function<void()>& prepare = {}) {
    return outcome_of(DEGS_PROGRAM, arguments, prepare);
}

/// What every mistake of a user looks like: exit code 2 and one sentence on stderr, which contains
/// `words`; nothing else anywhere.
inline void expect_mistake(const Outcome& outcome, const std::string& words) {
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("degs: ", 0), 0U) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_EQ(outcome.err[outcome.err.size() - 2], '.') << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
}

/// What `degs compare` printed on stderr without the lines of finished runs.
inline std::string without_progress(const std::string& text) {
    std::string rest;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        rest += line.find(" done · ") == std::string::npos ? line + "\n" : "";
    }
    return rest;
}

/// Nothing on stderr but, for scenes without cameras, where the generated view is, and a line with
/// the words of `warning` if there are any.
inline void expect_success(const Outcome& outcome, const std::string& warning = "") {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) {
        const bool warned = !warning.empty() && line.find(warning) != std::string::npos;
        EXPECT_TRUE(warned || line.find("the generated view is at") != std::string::npos) << line;
    }
}

/// A Gaussian as PLY stores it: logit of the opacity, logarithm of the scale.
struct Splat {
    std::array<float, 3> mean{0, 0, 0};
    std::array<float, 3> colour{1, 1, 1};
    float opacity = 3;
    std::array<float, 3> scale{-3, -3, -3};
    std::array<float, 4> rotation{1, 0, 0, 0};
};

inline void write_ply(const std::string& path, const std::vector<Splat>& splats) {
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << splats.size() << "\n";
    for (const char* name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0",
                             "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"}) {
        file << "property float " << name << "\n";
    }
    file << "end_header\n";
    static_assert(sizeof(Splat) == 14 * sizeof(float), "written as it lies in memory");
    file.write(reinterpret_cast<const char*>(splats.data()),
               static_cast<std::streamsize>(splats.size() * sizeof(Splat)));
}

/// A camera at `position` that looks along z, 64 x 48.
inline void write_camera(const std::string& path, const std::array<double, 3>& position) {
    const nlohmann::json camera = {{"id", 0},
                                   {"width", 64},
                                   {"height", 48},
                                   {"position", position},
                                   {"rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                   {"fx", 60},
                                   {"fy", 60}};
    std::ofstream(path) << nlohmann::json::array({camera});
}

inline std::string config(const std::string& name) {
    return std::string(DEGS_CONFIGS) + "/" + name + ".yaml";
}

inline nlohmann::json report_in(const std::string& folder) {
    return nlohmann::json::parse(read_file(fs::path(folder) / "report.json"));
}

} // namespace degs::sim_test
