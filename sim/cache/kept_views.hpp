// SPDX-License-Identifier: Apache-2.0
// Views with their projected frames in the memory of a server, whose forks find them there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/cache/cached_view.hpp"

namespace degs::sim {

/// The views that this process keeps, up to so many bytes of frames, of which the first go when
/// there are more. A program that is no server keeps none.
class KeptViews {
public:
    /// What this process, and therefore its forks, have.
    static KeptViews& of_process();

    explicit KeptViews(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

    /// Whether a view is ever kept: one camera of a scene, in one frame.
    static bool keeps(const ViewRequest& request, const PathRequest& path);
    /// The view, if it is kept and its files are what they were; else null. Throws InputError for
    /// mistakes in the request.
    std::shared_ptr<CachedView> find(const ViewRequest& request, const PathRequest& path);
    /// Keeps the view with its frame for the accelerator, found or made.
    void keep(const ViewRequest& request, const PathRequest& path, const AcceleratorConfig& config);
    std::uint64_t bytes() const;
    std::size_t size() const { return views_.size(); }

private:
    struct Entry {
        std::string key;
        std::shared_ptr<CachedView> view;
    };
    std::vector<Entry>::iterator find(const std::string& key);

    std::uint64_t most_bytes_;
    std::vector<Entry> views_; ///< the one that was kept last is the last
};

} // namespace degs::sim
