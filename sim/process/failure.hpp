// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace degs::sim {

constexpr int kSuccess = 0;
constexpr int kInternalError = 1; ///< the model or the machine failed
constexpr int kUserError = 2;     ///< command line, configuration, scene or output folder
constexpr int kOfSignals = 128;   ///< plus the number of the signal that ended the program

/// Why something was not done.
struct Failure {
    int code = kInternalError; ///< one of the above
    std::string sentence;
};

/// A failure as an exception, for results that another process could not deliver.
class FailureError : public std::exception {
public:
    explicit FailureError(Failure failure) : failure_(std::move(failure)) {}
    const Failure& failure() const { return failure_; }
    const char* what() const noexcept override { return failure_.sentence.c_str(); }

private:
    Failure failure_;
};

/// Turns an exception into a sentence for the user and an exit code. Throws only for lack of
/// memory.
Failure failure_of(const std::exception_ptr& error);

/// How a process ended that this signal ended.
std::string ending_sentence(int signal);

/// One of several failures, which says how many of `what` ("points") failed: the first of the model
/// or the machine, if there is one. None if there are none.
std::optional<Failure> worst_of(const std::vector<Failure>& failures, const std::string& what);

} // namespace degs::sim
