// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/cached_view.hpp"

#include <exception>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

#include "degs/error.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/text/progress.hpp"
#include "sim/view/foveated_view.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"
#include "sim/view/workloads.hpp"

namespace degs::sim {
namespace {

constexpr double kWorthKeeping = 0.005; // s

/// Runs `work` on a thread of its own, because the process of a simulation has a small stack.
void on_own_thread(const std::function<void()>& work) {
    std::exception_ptr failure;
    const auto caught = [&] {
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
    };
    std::optional<std::thread> thread;
    try {
        thread.emplace(caught);
    } catch (const std::system_error&) {
        caught(); // the system gives none
    }
    if (thread) {
        thread->join();
    }
    if (failure != nullptr) {
        std::rethrow_exception(failure);
    }
}

std::vector<FramePointer> pointers_to(std::vector<FrameWorkload> frames) {
    std::vector<FramePointer> pointers;
    pointers.reserve(frames.size());
    for (FrameWorkload& frame : frames) {
        pointers.push_back(std::make_shared<FrameWorkload>(std::move(frame)));
    }
    return pointers;
}

template <class Value>
std::uint64_t bytes_of(const std::vector<Value>& values) {
    return std::uint64_t{values.size()} * sizeof(Value);
}

/// Options of the projection that the reference of a frame is drawn from.
ProjectionOptions reference_options(const FrameWorkload& frame) {
    ProjectionOptions options = frame.projection;
    options.numbers = ProjectionNumbers();
    return options;
}

} // namespace

CachedView::CachedView(const ViewRequest& request, const PathRequest& path, FrameCache cache)
    : request_(request), cache_(std::move(cache)) {
    if (!request_.workload.empty()) {
        open_workload(path);
        return;
    }
    check_view(request_);
    const Stopwatch clock;
    if (std::unique_ptr<DynamicScene> dynamic = open_dynamic_scene(request_.scene)) {
        dynamic_ = path.frames > 1 ? std::move(dynamic) : nullptr;
    }
    key_ = cache_.scene_key(request_.scene, request_.camera_file);
    watch_->require_unchanged();
    if (std::optional<SceneCard> card = cache_.scene(key_)) {
        facts_ = card->facts;
        facts_.name = scene_name(request_.scene);
        facts_.source = request_.scene;
        scene_.name = facts_.name;
        scene_.source = facts_.source;
        scene_.cameras = std::move(card->cameras);
    } else {
        cloud();
    }
    views_ = path.group.images();
    PathSource source;
    source.camera = request_.camera;
    source.camera_at = [this](int position) {
        ViewRequest view = request_;
        view.camera = position;
        return camera_of(view, scene_);
    };
    source.stands_still = dynamic_ != nullptr;
    source.cloud = [this]() -> const GaussianCloud& { return cloud(); };
    cameras_ = cameras_of_frames(path, source);
    if (path.group.foveation) {
        foveate(*path.group.foveation);
    }
    load_s_ += load_s_ > 0 ? 0 : clock.seconds();
}

void CachedView::foveate(const Foveation& foveation) {
    const auto images = static_cast<std::size_t>(views_);
    foveated_ = FoveatedViews{foveation, {}};
    std::vector<Camera> all;
    std::size_t count = 0;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
        FoveatedView view{cameras_[k], levels_of(cameras_[k], foveation)};
        count = k == 0 ? view.levels.size() : count;
        if (view.levels.size() != count) {
            throw InputError("--foveation gives the first camera " + std::to_string(count) +
                             " levels and camera " + std::to_string(k) + " of the run " +
                             std::to_string(view.levels.size()) +
                             ", but all must have as many; cameras of one size and focal length "
                             "are needed, or other angles.");
        }
        for (const FoveatedLevel& level : view.levels) {
            all.push_back(level.camera);
        }
        if (k < images) {
            foveated_->images.push_back(std::move(view));
        }
    }
    views_ *= static_cast<int>(count);
    cameras_ = std::move(all);
}

void CachedView::open_workload(const PathRequest& path) {
    if (path.frames > 1) {
        throw InputError("--frames is " + std::to_string(path.frames) +
                         ", but a workload holds one view; only 1 frame is allowed beside "
                         "--workload.");
    }
    const Progress progress("loading " + request_.workload);
    const Stopwatch clock;
    workload_.emplace(request_.workload);
    facts_ = workload_->facts();
    cameras_ = {workload_->camera()};
    load_s_ = clock.seconds();
}

FrameWorkload CachedView::packed_frame(const std::string& wanted_by,
                                       const ProjectionOptions& options, int tile_size,
                                       TileMode mode) {
    const Stopwatch clock;
    FrameWorkload frame = workload_->frame(wanted_by, options, tile_size, mode);
    workload_s_ += clock.seconds();
    return frame;
}

std::string CachedView::frame_key(std::size_t k) const {
    return dynamic_ && !key_.empty() ? key_ + ", frame " + std::to_string(k / views_) : key_;
}

const GaussianCloud& CachedView::cloud() {
    if (scene_.cloud.empty()) {
        const Progress progress("loading " + request_.scene);
        const Stopwatch clock;
        scene_ = load_scene(request_.scene, request_.camera_file);
        facts_ = facts_of(scene_);
        load_s_ += clock.seconds();
        if (load_s_ > kWorthKeeping) {
            cache_.keep(key_, SceneCard{facts_, scene_.cameras});
        }
    }
    return scene_.cloud;
}

std::vector<FramePointer> CachedView::kept_frame(const AcceleratorConfig& config,
                                                 std::size_t frame) {
    std::vector<FrameWorkload> views;
    const ProjectionOptions options = projection_of(config.data_path(), facts_.traits.antialiased);
    for (std::size_t k = frame * views_; k < (frame + 1) * views_; ++k) {
        const Stopwatch clock;
        std::optional<FrameWorkload> kept = cache_.frame(
            frame_key(k), cameras_[k], config.tile_size_px(), config.tile_mode(), options);
        if (!kept) {
            return {};
        }
        views.push_back(std::move(*kept));
        workload_s_ += clock.seconds();
    }
    return pointers_to(std::move(views));
}

std::vector<FramePointer> CachedView::made_frame(const AcceleratorConfig& config,
                                                 std::size_t frame) {
    const auto first = cameras_.begin() + static_cast<std::ptrdiff_t>(frame) * views_;
    const std::vector<Camera> cameras(first, first + views_);
    double seconds = 0;
    std::vector<FramePointer> views =
        pointers_to(dynamic_ ? make_workloads(dynamic_->frame(static_cast<int>(frame)),
                                              facts_.traits, cameras, config, seconds)
                             : make_workloads(cloud(), facts_.traits, cameras, config, seconds));
    made_s_ += seconds;
    workload_s_ += seconds;
    return views;
}

std::vector<FramePointer> CachedView::first_frame(const AcceleratorConfig& config) {
    first_made_ = false;
    if (const auto held = held_.find(frame_kind(config, facts_.traits)); held != held_.end()) {
        return held->second;
    }
    if (workload_) {
        return {std::make_shared<FrameWorkload>(
            packed_frame(config.name, projection_of(config.data_path(), facts_.traits.antialiased),
                         config.tile_size_px(), config.tile_mode()))};
    }
    if (dynamic_) {
        require_frames(*dynamic_, static_cast<int>(cameras_.size()) / views_);
    }
    made_s_ = 0;
    std::vector<FramePointer> views = kept_frame(config, 0);
    first_made_ = views.empty();
    return first_made_ ? made_frame(config, 0) : views;
}

std::vector<FramePointer> CachedView::later_frame(const AcceleratorConfig& config,
                                                  std::size_t frame) {
    std::vector<FramePointer> views = kept_frame(config, frame);
    if (views.empty()) {
        views = made_frame(config, frame);
        for (std::size_t v = 0; v < views.size(); ++v) {
            unkept_.emplace_back(frame * views_ + v, views[v]);
        }
    }
    if (made_s_ > kWorthKeeping) {
        for (const auto& [k, view] : std::exchange(unkept_, {})) {
            cache_.keep(frame_key(k), *view);
        }
    }
    return views;
}

void CachedView::hold_first_frame(const AcceleratorConfig& config) {
    held_[frame_kind(config, facts_.traits)] = first_frame(config);
    forget_cloud();
}

bool CachedView::holds_first_frame(const AcceleratorConfig& config) const {
    return held_.count(frame_kind(config, facts_.traits)) != 0;
}

std::uint64_t CachedView::held_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [kind, views] : held_) {
        for (const FramePointer& frame : views) {
            bytes += bytes_of(frame->splats) + bytes_of(frame->tile_begin) +
                     bytes_of(frame->tile_splats) + bytes_of(frame->tiles_touched) +
                     bytes_of(frame->visible_of) + bytes_of(frame->visible_means);
        }
    }
    return bytes;
}

void CachedView::go_on() {
    watch_.emplace();
    load_s_ = workload_s_ = 0;
}

void CachedView::share_colours(std::vector<FramePointer>& views, std::size_t frame) {
    std::vector<FrameWorkload> shared;
    shared.reserve(views.size());
    for (FramePointer& view : views) {
        shared.push_back(*view);
    }
    if (dynamic_) {
        sim::share_colours(dynamic_->frame(static_cast<int>(frame)), shared, 0, shared.size());
    } else {
        sim::share_colours(cloud(), shared, 0, shared.size());
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
        views[v] = std::make_shared<FrameWorkload>(std::move(shared[v]));
    }
}

FrameSource CachedView::frames(const AcceleratorConfig& config,
                               const std::vector<FramePointer>& first) {
    const auto take = [this, &config, &first](std::size_t frame) {
        std::vector<FramePointer> views = frame == 0 ? first : later_frame(config, frame);
        if (views_ > 1 && config.view_sharing() == ViewSharing::Colour) {
            share_colours(views, frame);
        }
        if ((frame + 1) * views_ == cameras_.size()) {
            forget_cloud();
        }
        return views;
    };
    const std::size_t per_frame = views_;
    return {cameras_.size(), [take, per_frame, number = std::size_t{0},
                              views = std::vector<FramePointer>()]() mutable {
                const std::size_t view = number % per_frame;
                if (view == 0) {
                    on_own_thread([&] { views = take(number / per_frame); });
                }
                ++number;
                return std::move(views[view]);
            }};
}

void CachedView::require_reference(const FrameWorkload& frame) const {
    if (workload_ &&
        !workload_->holds(reference_options(frame), frame.tile_size, frame.tile_mode)) {
        throw InputError(request_.workload +
                         ": the workload was packed with --no-reference, so that it has nothing "
                         "to draw a reference image from; --no-reference is needed here, too.");
    }
}

Reference CachedView::reference(const FrameWorkload& frame) {
    if (workload_) {
        return make_reference(packed_frame("the reference image", reference_options(frame),
                                           frame.tile_size, frame.tile_mode));
    }
    if (std::optional<Reference> kept = cache_.reference(frame_key(0), frame)) {
        return std::move(*kept);
    }
    Reference made = frame.projection.numbers.is_reference()
                         ? make_reference(frame)
                         : make_reference(cloud(), frame, workload_s_);
    reference_made_ = reference_made_ || made.render_s > kWorthKeeping;
    return made;
}

Reference CachedView::full_reference(const Camera& camera, const FrameWorkload& frame) {
    FrameWorkload full; // without splats, until it is sure that they are needed
    full.camera = camera;
    full.projection = reference_options(frame);
    full.tile_size = frame.tile_size;
    full.tile_mode = frame.tile_mode;
    if (std::optional<Reference> kept = cache_.reference(frame_key(0), full)) {
        return std::move(*kept);
    }
    const Stopwatch clock;
    full = make_frame_workload(cloud(), camera, full.tile_size, full.tile_mode, full.projection);
    workload_s_ += clock.seconds();
    Reference made = make_reference(full);
    if (made.render_s > kWorthKeeping) {
        cache_.keep(frame_key(0), full, made);
    }
    return made;
}

bool CachedView::references_need_cloud(const FrameWorkload& frame) const {
    return !scene_.cloud.empty() && (foveated_ || !frame.projection.numbers.is_reference());
}

References CachedView::references(const std::vector<FramePointer>& first) {
    References references;
    for (const FramePointer& view : first) {
        references.views.push_back(reference(*view));
    }
    if (foveated_) {
        for (const FoveatedView& image : foveated_->images) {
            references.full.push_back(full_reference(image.camera, *first.front()));
        }
    }
    return references;
}

void CachedView::forget_cloud() {
    scene_.cloud = GaussianCloud{};
}

void CachedView::keep(const std::vector<FramePointer>& first,
                      const std::vector<Reference>& references) {
    for (std::size_t k = 0; first_made_ && made_s_ > kWorthKeeping && k < first.size(); ++k) {
        cache_.keep(frame_key(k), *first[k]);
    }
    for (std::size_t k = 0; reference_made_ && k < references.size(); ++k) {
        cache_.keep(frame_key(k), *first[k], references[k]);
    }
}

} // namespace degs::sim
