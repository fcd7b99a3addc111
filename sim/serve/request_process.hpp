// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "sim/serve/request.hpp"

namespace degs::sim {

class StoppingSignals;

/// What the fork of a request knows in the end.
struct WorkEnd {
    int code = 0;      ///< of the program
    bool made = false; ///< something that its parent could keep for other forks
};

/// A request in a fork of this process, whose standard streams come back through pipes. It is
/// killed when this object or this process goes. The caller has no other thread, since a fork
/// copies only its own.
class RequestProcess {
public:
    /// `work` is called in the fork, which uses so many threads of the host. If the system gives no
    /// process, that is the end of the request.
    RequestProcess(Request request, int threads, const std::function<WorkEnd()>& work,
                   const StoppingSignals& signals);
    ~RequestProcess();
    RequestProcess(const RequestProcess&) = delete;
    RequestProcess& operator=(const RequestProcess&) = delete;

    const Request& request() const { return request_; }
    /// Readable when there is something to read(): stdout and stderr; -1: closed.
    static constexpr std::size_t kStreams = 2;
    std::array<int, kStreams> files() const { return {out_.file, err_.file}; }
    void read(std::size_t stream);
    /// Takes the lines of stderr that have come; the last one without its end when all have.
    std::vector<std::string> take_lines();
    /// What has been written to stdout.
    const std::string& printed() const { return out_.text; }
    /// Both streams are closed.
    bool over() const { return out_.file < 0 && err_.file < 0; }
    /// Waits for the process, which is over; the exit code as shells have it. May add a line to
    /// those of stderr.
    WorkEnd end();
    /// As Ctrl-C does.
    void interrupt() const;

private:
    struct Stream {
        int file = -1;
        std::string text;
        bool read(); ///< false: closed
    };
    void start(int threads, const std::function<WorkEnd()>& work, const StoppingSignals& signals);

    Request request_;
    pid_t pid_ = -1; ///< -1: there is none
    Stream out_, err_;
    int made_ = -1; ///< holds a byte in the end if something was made
};

} // namespace degs::sim
