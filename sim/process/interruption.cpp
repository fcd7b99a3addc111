// SPDX-License-Identifier: Apache-2.0
#include "sim/process/interruption.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

#include <unistd.h>

#include "base/visible_text.hpp"
#include "scene/files/output_file.hpp"

namespace degs::sim {
namespace {

struct Ending {
    int signal;
    bool spoken; ///< the other ones come when nobody reads any more, or ask for no answer
};
constexpr std::array<Ending, 6> kEndings{{{SIGINT, true},
                                          {SIGTERM, true},
                                          {SIGHUP, false},
                                          {SIGQUIT, false},
                                          {SIGPIPE, false},
                                          {SIGXCPU, true}}};
constexpr std::size_t kLongest = 512;

/// Two, so that a signal finds one whole while the other is written.
std::array<std::array<char, kLongest>, 2> spoken_texts{{{"degs: Interrupted.\n"}, {}}};
std::atomic<const char*> spoken_sentence{spoken_texts[0].data()};
const char* spoken_first = ""; ///< clears the line of a terminal that shows how far the program is

void write_text(const char* text) {
    const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
    (void)written; // no place is left to report a failure
}

/// Calls only what a signal handler may. SA_RESETHAND has put the default back, which acts when
/// this returns.
void end_on(int signal) {
    drop_partial_files();
    for (const Ending& ending : kEndings) {
        if (ending.signal == signal && ending.spoken) {
            write_text(spoken_first);
            write_text(spoken_sentence.load());
        }
    }
    std::raise(signal);
}

} // namespace

void announce_interruption() {
    spoken_first = ::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";
    for (const Ending& ending : kEndings) {
        struct sigaction action {};
        ::sigaction(ending.signal, nullptr, &action);
        if (action.sa_handler != SIG_IGN) {
            action.sa_handler = end_on;
            action.sa_flags = static_cast<int>(SA_RESETHAND);
            ::sigaction(ending.signal, &action, nullptr);
        }
    }
    // A file that reaches the limit of its size fails like one on a full disk, with a sentence.
    std::signal(SIGXFSZ, SIG_IGN);
}

void set_interruption_sentence(const std::string& text) {
    auto& next =
        spoken_sentence.load() == spoken_texts[0].data() ? spoken_texts[1] : spoken_texts[0];
    const std::string shown = "degs: " + visible(text);
    const std::size_t size = std::min(shown.size(), kLongest - 2);
    shown.copy(next.data(), size);
    next[size] = '\n';
    next[size + 1] = '\0';
    spoken_sentence = next.data();
}

void keep_interruption_quiet() {
    for (const Ending& ending : kEndings) {
        struct sigaction action {};
        ::sigaction(ending.signal, nullptr, &action);
        if (action.sa_handler == end_on) {
            std::signal(ending.signal, SIG_DFL);
        }
    }
}

} // namespace degs::sim
