// SPDX-License-Identifier: Apache-2.0
#include "sim/runs/run_progress.hpp"

#include "base/ratio.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

void RunProgress::ended(const std::string& name, double seconds, bool good) {
    ++ended_;
    line_.note(words() + " done · " + name + (good ? " · " : " failed · ") + three_digits(seconds) +
               " s");
}

void RunProgress::show(const std::vector<std::string>& running) {
    const std::size_t more = running.size() - 1;
    line_.show(words() + " done · " + std::to_string(static_cast<long>(clock_.seconds())) + " s" +
               left() + " · running " + running.front() +
               (more == 0 ? "" : " and " + std::to_string(more) + " more"));
}

std::string RunProgress::words() const {
    return std::to_string(ended_) + (unknown_scenes_ == 0 ? " of " : " of at least ") +
           std::to_string(planned_) + " " + what_ + (planned_ == 1 ? "" : "s");
}

/// ", about 17 s to go" if what has ended says how long the rest will take.
std::string RunProgress::left() const {
    const std::size_t done = ended_ - before_;
    if (done == 0 || unknown_scenes_ != 0 || ended_ >= planned_) {
        return "";
    }
    return ", about " + time_words(clock_.seconds() * ratio_of(planned_ - ended_, done)) + " to go";
}

} // namespace degs::sim
