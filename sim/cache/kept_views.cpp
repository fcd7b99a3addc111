// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/kept_views.hpp"

#include <algorithm>
#include <utility>

#include "config/input_files.hpp"
#include "sim/cache/digest.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

/// Everything that the frame of a view depends on, but for the accelerator. Two names of a file are
/// two views.
std::string key_of(const ViewRequest& request) {
    check_view(request);
    Digest digest(Digest::Files::Stamps);
    digest.add_scene(request.scene);
    digest.add_cameras(request.camera_file);
    for (const std::string& text :
         {request.camera_file, request.resolution, request.crop, std::to_string(request.camera),
          std::to_string(request.width.value_or(0)), std::to_string(request.height.value_or(0))}) {
        digest.add(text);
    }
    return digest.text();
}

} // namespace

KeptViews& KeptViews::of_process() {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 30U;
    static KeptViews views(kMost);
    return views;
}

bool KeptViews::keeps(const ViewRequest& request, const PathRequest& path) {
    return request.workload.empty() && path.frames == 1 && path.group.images() == 1 &&
           !path.group.foveation;
}

std::shared_ptr<CachedView> KeptViews::find(const ViewRequest& request, const PathRequest& path) {
    if (views_.empty() || !keeps(request, path)) {
        return nullptr;
    }
    const InputWatch watch; // until the view watches its files itself
    const auto found = find(key_of(request));
    if (found == views_.end()) {
        return nullptr;
    }
    found->view->go_on();
    return found->view;
}

std::vector<KeptViews::Entry>::iterator KeptViews::find(const std::string& key) {
    return std::find_if(views_.begin(), views_.end(),
                        [&key](const Entry& entry) { return entry.key == key; });
}

void KeptViews::keep(const ViewRequest& request, const PathRequest& path,
                     const AcceleratorConfig& config) {
    if (!keeps(request, path)) {
        return;
    }
    const InputWatch watch; // files do not change between the key and the frame
    const std::string key = key_of(request);
    std::shared_ptr<CachedView> view;
    if (const auto found = find(key); found != views_.end()) {
        view = found->view;
        view->go_on();
        views_.erase(found);
    } else {
        view = std::make_shared<CachedView>(request, path, FrameCache::of_user());
    }
    view->hold_first_frame(config);
    view->pause();
    views_.push_back({key, view});
    while (views_.size() > 1 && bytes() > most_bytes_) {
        views_.erase(views_.begin());
    }
}

std::uint64_t KeptViews::bytes() const {
    std::uint64_t bytes = 0;
    for (const Entry& entry : views_) {
        bytes += entry.view->held_bytes();
    }
    return bytes;
}

} // namespace degs::sim
