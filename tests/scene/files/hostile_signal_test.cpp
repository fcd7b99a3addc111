// SPDX-License-Identifier: Apache-2.0
// Signals that end a program while it makes files.
#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

#include "scene/files/output_file.hpp"
#include "scene/files/partial_file.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

void end_on(int signal) {
    drop_partial_files();
    std::raise(signal);
}

/// A process that makes one partial file after the other until SIGTERM ends it.
[[noreturn]] void make_files(const std::string& path) {
    struct sigaction action {};
    action.sa_handler = end_on;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(SIGTERM, &action, nullptr);
    for (;;) {
        const PartialFile file(path);
    }
}

// Most of the loop is between the call that makes a file and the next line of the program, so that
// a name that enters the list of the handler after its file is there leaves a file within few
// signals.
TEST(HostileSignal, LeavesNoPartialFileWhereverItComes) {
    const test::Folder folder;
    const std::string path = folder.path("result.txt");
    for (int i = 0; i < 200; ++i) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            make_files(path);
        }
        while (folder.entries() == 0) {
        }
        ::usleep(static_cast<useconds_t>(37 * (i % 29)));
        ::kill(child, SIGTERM);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
        ASSERT_EQ(folder.entries(), 0U) << "after " << i << " signals";
    }
}

} // namespace
} // namespace degs
