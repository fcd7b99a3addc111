// SPDX-License-Identifier: Apache-2.0
#include "sim/process/failure.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>

#include <systemc>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

constexpr const char* kNoMemory = "There is not enough memory for a scene or an image of this "
                                  "size; 'ulimit -v' shows whether there is a limit.";

} // namespace

Failure failure_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const FailureError& failed) {
        return failed.failure();
    } catch (const InputError& mistake) {
        return {kUserError, mistake.what()};
    } catch (const std::bad_alloc&) {
        return {kInternalError, kNoMemory};
    } catch (const sc_core::sc_report& report) {
        if (std::string(report.get_msg()).find("stack memory") != std::string::npos) {
            return {kInternalError, kNoMemory};
        }
        return {kInternalError, std::string("The simulation kernel failed: ") +
                                    report.get_msg_type() + ": " + report.get_msg() + "."};
    } catch (const std::system_error& lack) {
        const bool limit = lack.code() == std::errc::resource_unavailable_try_again ||
                           lack.code() == std::errc::not_enough_memory; // for a thread
        return {kInternalError,
                limit
                    ? std::string("The system has no memory or no thread left for this program (") +
                          lack.what() + "); 'ulimit -v' and 'ulimit -u' show the limits."
                    : std::string("Internal error: ") + lack.what() + "."};
    } catch (const std::length_error&) {
        return {kInternalError, kNoMemory};
    } catch (const std::exception& broken) {
        return {kInternalError, std::string("Internal error: ") + broken.what() + "."};
    } catch (...) {
        return {kInternalError, "Internal error of unknown kind."};
    }
}

std::string ending_sentence(int signal) {
    return "The process was ended by signal " + std::to_string(signal) + " (" +
           ::strsignal(signal) + ")" +
           (signal == SIGKILL ? "; the machine may have run out of memory." : ".");
}

std::optional<Failure> worst_of(const std::vector<Failure>& failures, const std::string& what) {
    if (failures.empty()) {
        return {};
    }
    const auto internal = std::find_if(failures.begin(), failures.end(), [](const Failure& each) {
        return each.code == kInternalError;
    });
    Failure worst = internal == failures.end() ? failures.front() : *internal;
    if (failures.size() > 1) {
        worst.sentence = std::to_string(failures.size()) + " " + what +
                         " failed, one of them with: " + worst.sentence;
    }
    return worst;
}

} // namespace degs::sim
