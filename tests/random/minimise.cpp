// SPDX-License-Identifier: Apache-2.0
#include "tests/random/minimise.hpp"

#include <algorithm>
#include <utility>

namespace degs::trials {
namespace {

class Minimiser {
public:
    Minimiser(Trial trial, const std::function<bool(const Trial&)>& fails, int most)
        : trial_(std::move(trial)), fails_(fails), left_(most) {}

    /// Halves of the changes first, then quarters, …, single ones.
    void drop_changes() {
        for (std::size_t part = trial_.changes.size(); part > 0; part /= 2) {
            for (std::size_t begin = 0; begin < trial_.changes.size();) {
                Trial smaller = trial_;
                const auto first = smaller.changes.begin() + static_cast<std::ptrdiff_t>(begin);
                const std::size_t count = std::min(part, smaller.changes.size() - begin);
                smaller.changes.erase(first, first + static_cast<std::ptrdiff_t>(count));
                begin += accept(smaller) ? 0 : part;
            }
        }
    }
    void plain_run() {
        try_with([](Trial& trial) { trial.array_only = false; });
        try_with([](Trial& trial) { trial.eyes = {}; });
        try_with([](Trial& trial) { trial.foveation.clear(); });
        try_with([](Trial& trial) { trial.frames = 1; });
        if (trial_.frames > 2) {
            try_with([](Trial& trial) { trial.frames = 2; });
        }
        try_with([](Trial& trial) { trial.camera = 0; });
    }
    void shrink_scene() {
        const std::string key = "gaussians=";
        for (bool smaller = true; smaller;) {
            smaller = try_with([&key](Trial& trial) {
                const std::size_t begin = trial.scene.find(key) + key.size();
                const std::size_t end = trial.scene.find(',', begin);
                const int count = std::stoi(trial.scene.substr(begin, end - begin));
                trial.scene.replace(begin, end - begin, std::to_string(std::max(1, count / 2)));
            });
        }
    }
    void shrink(int Trial::*size) {
        while (trial_.*size > 1 && try_with([size](Trial& trial) { trial.*size /= 2; })) {
        }
    }
    const Trial& trial() const { return trial_; }

private:
    template <class Edit>
    bool try_with(const Edit& edit) {
        Trial changed = trial_;
        edit(changed);
        return changed.arguments() != trial_.arguments() && accept(changed);
    }
    bool accept(const Trial& trial) {
        if (left_ == 0 || !fails_(trial)) {
            return false;
        }
        --left_;
        trial_ = trial;
        return true;
    }

    Trial trial_;
    const std::function<bool(const Trial&)>& fails_;
    int left_;
};

} // namespace

Trial minimised(Trial trial, const std::function<bool(const Trial&)>& fails, int most) {
    Minimiser minimiser(std::move(trial), fails, most);
    minimiser.drop_changes();
    minimiser.plain_run();
    minimiser.shrink_scene();
    minimiser.shrink(&Trial::width);
    minimiser.shrink(&Trial::height);
    minimiser.drop_changes();
    return minimiser.trial();
}

} // namespace degs::trials
