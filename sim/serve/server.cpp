// SPDX-License-Identifier: Apache-2.0
#include "sim/serve/server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <system_error>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "sim/process/failure.hpp"
#include "sim/process/stopping_signals.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kMostLine = std::size_t{1} << 20U; // bytes
/// A pipe that can be written to takes as much without blocking.
constexpr std::size_t kPart = 4096;

} // namespace

Server::Server(int in, int out, std::size_t jobs, Work work)
    : in_(in), out_(out), jobs_(jobs), work_(std::move(work)) {}

void Server::serve() {
    const StoppingSignals signals;
    while (reading_ || !waiting_.empty() || !running_.empty() || has_answers()) {
        start_waiting(signals);
        if (!wait(signals)) {
            return;
        }
    }
}

void Server::start_waiting(const StoppingSignals& signals) {
    while (!waiting_.empty() && running_.size() < jobs_) {
        const Request request = std::move(waiting_.front());
        waiting_.pop_front();
        // Requests that run beside each other share the processors.
        const int threads = host_threads() / static_cast<int>(running_.size() + 1);
        running_.push_back(std::make_unique<RequestProcess>(
            request, threads, [&] { return work_.run(request); }, signals));
        if (running_.back()->over()) {
            end(std::prev(running_.end()));
        }
    }
}

bool Server::wait(const StoppingSignals& signals) {
    constexpr std::size_t kOwn = 3; // files in front of those of the processes
    const short writing = has_answers() ? short{POLLOUT} : short{0};
    std::vector<pollfd> files{
        {reading_ ? in_ : -1, POLLIN, 0}, {out_, writing, 0}, {signals.file(), POLLIN, 0}};
    for (const auto& process : running_) {
        for (const int file : process->files()) {
            files.push_back({file, POLLIN, 0});
        }
    }
    if (::poll(files.data(), files.size(), -1) < 0) {
        return true; // a signal, which is looked at in the next turn
    }
    if (signals.take()) {
        throw FailureError({interruption_code(), "Interrupted."});
    }
    if ((files[1].revents & (POLLERR | POLLNVAL)) != 0) {
        return false;
    }
    for (std::size_t i = running_.size(); i-- > 0;) {
        RequestProcess& process = *running_[i];
        for (std::size_t stream = 0; stream < RequestProcess::kStreams; ++stream) {
            if (files[kOwn + i * RequestProcess::kStreams + stream].revents != 0) {
                process.read(stream);
            }
        }
        tell(process);
        if (process.over()) {
            end(running_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
    if (files[0].revents != 0) {
        read_requests();
    }
    flush();
    return true;
}

void Server::read_requests() {
    std::array<char, 65536> part;
    const ssize_t count = ::read(in_, part.data(), part.size());
    if (count < 0 && errno == EINTR) {
        return;
    }
    reading_ = count > 0;
    line_.append(part.data(), std::max<ssize_t>(count, 0));
    if (!reading_ && !line_.empty()) {
        line_ += '\n';
    }
    for (std::size_t end = 0; (end = line_.find('\n')) != std::string::npos;) {
        const std::string line = line_.substr(0, end);
        line_.erase(0, end + 1);
        if (!std::exchange(too_long_, false)) {
            take_line(line);
        }
    }
    if (line_.size() > kMostLine) {
        line_.clear();
        if (!std::exchange(too_long_, true)) {
            answer("null", kUserError,
                   {"degs: A request has more than " + std::to_string(kMostLine) +
                    " bytes, which are the most that are allowed."},
                   "");
        }
    }
}

void Server::take_line(const std::string& line) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
        return;
    }
    Request request = read_request(line);
    if (request.mistake.empty() && request.stop) {
        stop(request.id);
        return;
    }
    if (request.mistake.empty() && is_known(request.id)) {
        request.mistake = "The id " + request.id + " belongs to a request that has not ended.";
    }
    if (request.mistake.empty()) {
        waiting_.push_back(std::move(request));
    } else {
        const std::string id = is_known(request.id) ? "null" : request.id; // that one goes on
        answer(id, kUserError, {"degs: " + request.mistake}, "");
    }
}

bool Server::is_known(const std::string& id) const {
    const auto has_id = [&id](const Request& request) { return request.id == id; };
    return std::any_of(waiting_.begin(), waiting_.end(), has_id) ||
           std::any_of(running_.begin(), running_.end(),
                       [&](const auto& process) { return has_id(process->request()); });
}

// A request that has ended needs no stop: both may have crossed.
void Server::stop(const std::string& id) {
    const auto waits = std::find_if(waiting_.begin(), waiting_.end(),
                                    [&id](const Request& request) { return request.id == id; });
    if (waits != waiting_.end()) {
        waiting_.erase(waits);
        answer(id, kOfSignals + SIGINT, {"degs: Interrupted."}, "");
        return;
    }
    for (const auto& process : running_) {
        if (process->request().id == id) {
            process->interrupt();
        }
    }
}

void Server::answer(const std::string& id, int code, const std::vector<std::string>& said,
                    const std::string& printed) {
    for (const std::string& line : said) {
        answers_ += said_line(id, line);
    }
    answers_ += ended_line(id, code, printed);
}

void Server::tell(RequestProcess& process) {
    for (const std::string& line : process.take_lines()) {
        answers_ += said_line(process.request().id, line);
    }
}

void Server::end(Running::iterator process) {
    const std::unique_ptr<RequestProcess> ended = std::move(*process);
    running_.erase(process);
    const WorkEnd end = ended->end();
    const Request& request = ended->request();
    answer(request.id, end.code, ended->take_lines(), ended->printed());
    if (end.code == kSuccess && end.made) {
        flush(); // whoever waits for the answer does not wait for what follows
        work_.keep(request);
    }
}

void Server::write_answers() {
    const std::size_t bytes = std::min(answers_.size() - written_, kPart);
    const ssize_t written = ::write(out_, answers_.data() + written_, bytes);
    if (written < 0 && errno != EINTR) {
        throw FailureError({kUserError, "The standard output cannot be written: " +
                                            std::generic_category().message(errno) + "."});
    }
    written_ += std::max<ssize_t>(written, 0);
    if (!has_answers()) {
        answers_.clear();
        written_ = 0;
    }
}

void Server::flush() {
    pollfd file{out_, POLLOUT, 0};
    while (has_answers() && ::poll(&file, 1, 0) > 0 && (file.revents & POLLOUT) != 0) {
        write_answers();
    }
}

} // namespace degs::sim
