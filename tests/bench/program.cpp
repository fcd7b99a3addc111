// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/program.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace degs::bench {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// Becomes the program; everything that it prints goes to `said`.
[[noreturn]] void become_program(const std::vector<std::string>& arguments, const fs::path& said,
                                 const fs::path& cache) {
    const int file = ::open(said.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::setenv("DEGS_CACHE", cache.c_str(), 1);
    std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    ::execv(DEGS_PROGRAM, argv.data());
    ::_exit(127);
}

} // namespace

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "degs-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw std::runtime_error("No temporary folder could be made in " +
                                 fs::temp_directory_path().string() + ".");
    }
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

nlohmann::json run_program(const std::vector<std::string>& arguments, const std::string& file,
                           const fs::path& cache) {
    const Folder folder;
    const fs::path said = folder.path() / "said";
    const fs::path out = folder.path() / "out";
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--out", out.string()});
    const pid_t child = ::fork();
    if (child == 0) {
        become_program(all, said, cache);
    }
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child || status != 0) {
        throw std::runtime_error(std::string(DEGS_PROGRAM) + " failed: " + content_of(said));
    }
    return nlohmann::json::parse(content_of(out / file));
}

nlohmann::json run_design(const std::string& design, const View& view,
                          const std::vector<std::string>& more, const fs::path& cache) {
    std::vector<std::string> arguments{
        "run",      std::string(DEGS_CONFIGS) + "/" + design + ".yaml",
        "--scene",  view.scene,
        "--camera", std::to_string(view.camera)};
    arguments.insert(arguments.end(), view.size.begin(), view.size.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, "report.json", cache);
}

fs::path trained_scenes() {
    const char* const variable = std::getenv("DEGS_SCENES");
    const fs::path folder = variable != nullptr ? variable : DEGS_SCENES_DEFAULT;
    return fs::exists(folder / "flowers/scene.ply") ? folder : fs::path();
}

} // namespace degs::bench
