// SPDX-License-Identifier: Apache-2.0
// degs serve: requests and answers as lines of JSON, and what ends early.
#include <algorithm>
#include <csignal>
#include <map>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// A server whose requests the test writes and whose answers it reads.
class ServerChild {
public:
    explicit ServerChild(const std::vector<std::string>& options = {}) {
        std::array<int, 2> in{}, out{};
        if (::pipe(in.data()) != 0 || ::pipe(out.data()) != 0) {
            throw std::runtime_error("no pipe");
        }
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(in[0], STDIN_FILENO);
            ::dup2(out[1], STDOUT_FILENO);
            for (const int file : {in[0], in[1], out[0], out[1]}) {
                ::close(file);
            }
            std::vector<std::string> words{DEGS_PROGRAM, "serve"};
            words.insert(words.end(), options.begin(), options.end());
            std::vector<char*> argv;
            for (std::string& word : words) {
                argv.push_back(word.data());
            }
            argv.push_back(nullptr);
            ::execv(DEGS_PROGRAM, argv.data());
            ::_exit(127);
        }
        ::close(in[0]);
        ::close(out[1]);
        in_ = in[1];
        out_ = out[0];
    }
    ~ServerChild() {
        end_input();
        end_output();
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    ServerChild(const ServerChild&) = delete;
    ServerChild& operator=(const ServerChild&) = delete;

    pid_t pid() const { return pid_; }
    void write(const std::string& text) const {
        ASSERT_EQ(::write(in_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    void ask(const nlohmann::json& id, const std::vector<std::string>& arguments) const {
        write(nlohmann::json{{"id", id}, {"arguments", arguments}}.dump() + "\n");
    }
    /// The next answer; null when there is none.
    nlohmann::json next() {
        std::size_t end = 0;
        while ((end = text_.find('\n')) == std::string::npos) {
            std::array<char, 4096> part{};
            const ssize_t count = ::read(out_, part.data(), part.size());
            if (count <= 0) {
                return nullptr;
            }
            text_.append(part.data(), count);
        }
        const nlohmann::json answer = nlohmann::json::parse(text_.substr(0, end));
        text_.erase(0, end + 1);
        return answer;
    }
    /// Answers up to the next end of a request, which is the last of them.
    std::vector<nlohmann::json> until_end() {
        std::vector<nlohmann::json> answers;
        do {
            answers.push_back(next());
        } while (!answers.back().is_null() && !answers.back().contains("code"));
        return answers;
    }
    void end_input() { close(in_); }
    void end_output() { close(out_); }
    /// The exit code, or 128 and the number of a signal.
    int code() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }

private:
    static void close(int& file) {
        if (file >= 0) {
            ::close(file);
        }
        file = -1;
    }

    pid_t pid_ = -1;
    int in_ = -1, out_ = -1;
    std::string text_;
};

std::vector<pid_t> forks_of(pid_t pid) {
    const std::string process = std::to_string(pid);
    std::ifstream file("/proc/" + process + "/task/" + process + "/children");
    std::vector<pid_t> forks;
    for (pid_t fork = 0; file >> fork;) {
        forks.push_back(fork);
    }
    return forks;
}

/// Waits until the server has a fork, and returns it.
pid_t fork_of(const ServerChild& server) {
    std::vector<pid_t> forks;
    while ((forks = forks_of(server.pid())).empty()) {
        ::usleep(1000);
    }
    return forks.front();
}

const std::vector<std::string> kLongRun{
    "run", config("degs-64"), "--scene", "synthetic:object,gaussians=200000", "--resolution", "8k"};

nlohmann::json last_of(const std::vector<nlohmann::json>& answers) {
    return answers.back();
}

TEST(ServerRequests, AreAnsweredUntilTheInputEnds) {
    ServerChild server;
    server.ask(1, {"--version"});
    server.ask("b", {"config", config("degs-64"), "--format", "yaml"});
    server.end_input();
    std::map<nlohmann::json, nlohmann::json> ends;
    for (nlohmann::json answer = server.next(); !answer.is_null(); answer = server.next()) {
        ends[answer["id"]] = answer;
    }
    ASSERT_EQ(ends.size(), 2U);
    EXPECT_EQ(ends[1]["code"], 0);
    EXPECT_EQ(ends[1]["printed"], degs({"--version"}).out);
    EXPECT_EQ(ends["b"]["printed"], degs({"config", config("degs-64"), "--format", "yaml"}).out);
    EXPECT_EQ(server.code(), 0);
}

TEST(ServerRequests, FailWithTheSentenceOfTheCommand) {
    ServerChild server;
    const std::vector<std::string> command{"config", "nothing.yaml"};
    server.ask(1, command);
    const std::vector<nlohmann::json> answers = server.until_end();
    ASSERT_EQ(answers.size(), 2U);
    EXPECT_EQ(answers[0]["said"].get<std::string>() + "\n", degs(command).err);
    EXPECT_EQ(answers[1], (nlohmann::json{{"id", 1}, {"code", 2}, {"printed", ""}}));
}

TEST(ServerRequests, RunInTheirFolder) {
    const Folder folder;
    ServerChild server;
    const auto ask = [&server](const std::string& in) {
        server.write(
            nlohmann::json{{"id", 1},
                           {"folder", in},
                           {"arguments", {"scene", "generate", "single", "--out", "s.ply"}}}
                .dump() +
            "\n");
        return server.until_end();
    };
    EXPECT_EQ(last_of(ask(folder / ""))["code"], 0);
    EXPECT_TRUE(fs::exists(folder / "s.ply"));
    const std::vector<nlohmann::json> refused = ask(folder / "none");
    EXPECT_NE(refused[0]["said"].get<std::string>().find("cannot be entered"), std::string::npos);
    EXPECT_EQ(last_of(refused)["code"], 2);
}

TEST(ServerRequests, ThatAreKilledOrCrashEndAlone) {
    for (const int signal : {SIGKILL, SIGSEGV}) {
        ServerChild server;
        server.ask(1, kLongRun);
        ::kill(fork_of(server), signal);
        const std::vector<nlohmann::json> answers = server.until_end();
        ASSERT_GE(answers.size(), 2U);
        const std::string said = answers[answers.size() - 2]["said"];
        EXPECT_EQ(said.rfind("degs: The process was ended by signal " + std::to_string(signal), 0),
                  0U)
            << said;
        EXPECT_EQ(last_of(answers)["code"], 128 + signal);
        server.ask(2, {"--version"});
        EXPECT_EQ(last_of(server.until_end())["code"], 0);
    }
}

TEST(ServerRequests, AreStopped) {
    ServerChild server({"--jobs", "1"});
    server.ask("runs", kLongRun);
    server.ask("waits", {"--version"});
    fork_of(server);
    for (const std::string id : {"waits", "runs"}) {
        server.write(nlohmann::json{{"id", id}, {"stop", true}}.dump() + "\n");
        const std::vector<nlohmann::json> answers = server.until_end();
        ASSERT_EQ(answers.size(), 2U);
        EXPECT_EQ(answers[0], (nlohmann::json{{"id", id}, {"said", "degs: Interrupted."}}));
        EXPECT_EQ(answers[1]["code"], 128 + SIGINT);
    }
    server.write("{\"id\": \"gone\", \"stop\": true}\n"); // it has crossed its end
    server.ask(3, {"--version"});
    EXPECT_EQ(last_of(server.until_end())["id"], 3);
}

TEST(ServerRequests, ShareTheProcessorsAsJobsSays) {
    ServerChild server({"--jobs", "2"});
    for (int id = 0; id < 3; ++id) {
        server.ask(id, kLongRun);
    }
    while (forks_of(server.pid()).size() < 2) {
        ::usleep(1000);
    }
    EXPECT_EQ(forks_of(server.pid()).size(), 2U);
}

TEST(HostileRequests, AreRefusedWithASentence) {
    const std::pair<std::string, std::string> lines[] = {
        {"nonsense", "one line"},
        {"[1]", "one line"},
        {"{\"arguments\": []}", "needs an 'id'"},
        {"{\"id\": 1.5, \"arguments\": []}", "needs an 'id'"},
        {"{\"id\": null, \"arguments\": []}", "needs an 'id'"},
        {"{\"id\": 1}", "needs 'arguments'"},
        {"{\"id\": 1, \"arguments\": \"run\"}", "needs 'arguments'"},
        {"{\"id\": 1, \"arguments\": [1]}", "An argument of the request must be a text"},
        {"{\"id\": 1, \"arguments\": [\"a\\u0000b\"]}", "holds a zero"},
        {"{\"id\": 1, \"arguments\": [], \"folder\": 3}", "The folder of the request must be"},
        {"{\"id\": 1, \"argumnets\": []}", "did you mean 'arguments'?"},
        {"{\"id\": 1, \"stop\": false}", "ends the request with this id"},
        {"{\"id\": 1, \"stop\": true, \"folder\": \"a\"}", "ends the request with this id"},
        {"{\"id\": 1, \"arguments\": [\"\xff\"]}", "one line"},
        {std::string(100000, '['), "one line"},
        {std::string(3000000, 'a'), "which are the most that are allowed"},
    };
    ServerChild server;
    for (const auto& [line, words] : lines) {
        server.write(line + "\n");
        const std::vector<nlohmann::json> answers = server.until_end();
        ASSERT_EQ(answers.size(), 2U) << line.substr(0, 80);
        const std::string said = answers[0]["said"];
        EXPECT_EQ(said.rfind("degs: ", 0), 0U);
        EXPECT_NE(said.find(words), std::string::npos) << said;
        EXPECT_EQ(answers[1]["code"], 2);
    }
    server.write("\n \n");
    server.ask(1, kLongRun);
    server.ask(1, {"--version"});
    const std::vector<nlohmann::json> twice = server.until_end();
    EXPECT_EQ(twice.back()["id"], nullptr);
    EXPECT_NE(twice[0]["said"].get<std::string>().find("belongs to a request"), std::string::npos);
    server.write("{\"id\": 1, \"stop\": true}"); // without its end, which the input has
    server.end_input();
    EXPECT_EQ(last_of(server.until_end())["code"], 128 + SIGINT);
    EXPECT_EQ(server.code(), 0);
}

TEST(ServerEnds, WhenNobodyReadsItsAnswers) {
    ServerChild server;
    server.ask(1, kLongRun);
    const pid_t fork = fork_of(server);
    server.end_input();
    server.end_output();
    EXPECT_EQ(server.code(), 0);
    EXPECT_NE(::kill(fork, 0), 0);
}

TEST(ServerEnds, OnASignal) {
    ServerChild server;
    server.ask(1, kLongRun);
    const pid_t fork = fork_of(server);
    ::kill(server.pid(), SIGTERM);
    EXPECT_EQ(server.code(), 128 + SIGTERM);
    while (::kill(fork, 0) == 0) {
        ::usleep(1000);
    }
}

TEST(ServerViews, AreThoseOfSingleRuns) {
    const Folder folder;
    ServerChild server;
    const std::vector<std::string> design{
        "run", config("degs-16"), "--scene", "synthetic:object,gaussians=300", "--width", "64"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = design;
        words.insert(words.end(), more.begin(), more.end());
        words.insert(words.end(), {"--out", folder / "out"});
        return words;
    };
    const auto document = [&folder](const std::string& name) {
        nlohmann::json values = nlohmann::json::parse(read_file(folder / "out/" + name));
        values.erase("host");
        return values;
    };
    const std::vector<std::vector<std::string>> requests{
        {"--fidelity", "analytic"},
        {},
        {"--fidelity", "analytic", "--set", "tile_size=16", "--what-if", "tile_size=8"},
        {"--crop", "8,8,32x16", "--no-cache"},
        {"--frames", "3"},
        {"--fidelity", "analytic", "--camera", "1"}};
    for (const std::vector<std::string>& request : requests) {
        const std::string name = std::count(request.begin(), request.end(), "analytic") > 0
                                     ? "analytic.json"
                                     : "report.json";
        expect_success(degs(with(request)));
        const nlohmann::json alone = document(name);
        for (int turn = 0; turn < 3; ++turn) {
            server.ask(turn, with(request));
            ASSERT_EQ(last_of(server.until_end())["code"], 0);
            EXPECT_EQ(document(name), alone);
        }
    }
}

} // namespace
} // namespace degs::sim_test
