// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/serve/request.hpp"
#include "sim/serve/request_process.hpp"

namespace degs::sim {

class StoppingSignals;

/// Reads requests from one file and writes their answers to another. Each request runs in a fork of
/// this process, several at a time.
class Server {
public:
    struct Work {
        /// Called in a fork.
        std::function<WorkEnd(const Request&)> run;
        /// Called in this process when a fork has made something and ended with the exit code 0.
        std::function<void(const Request&)> keep;
    };
    /// At most `jobs` requests run at a time.
    Server(int in, int out, std::size_t jobs, Work work);

    /// Returns when there are no more requests and all have been answered, or when nobody reads the
    /// answers; those that run are killed then. Throws FailureError after SIGINT and SIGTERM, and
    /// if answers cannot be written.
    void serve();

private:
    using Running = std::vector<std::unique_ptr<RequestProcess>>;

    void start_waiting(const StoppingSignals& signals);
    /// False if nobody reads the answers.
    bool wait(const StoppingSignals& signals);
    void read_requests();
    void take_line(const std::string& line);
    void stop(const std::string& id);
    bool is_known(const std::string& id) const;
    void answer(const std::string& id, int code, const std::vector<std::string>& said,
                const std::string& printed);
    void tell(RequestProcess& process);
    void end(Running::iterator process);
    bool has_answers() const { return written_ < answers_.size(); }
    void write_answers();
    /// Writes as many answers as the reader takes now.
    void flush();

    int in_, out_;
    std::size_t jobs_;
    Work work_;
    bool reading_ = true;
    bool too_long_ = false; ///< the line that comes
    std::string line_;      ///< what has come of it
    std::deque<Request> waiting_;
    Running running_;
    std::string answers_;     ///< to be written
    std::size_t written_ = 0; ///< bytes of them
};

} // namespace degs::sim
