// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/shared_bytes.hpp"
#include "sim/design/run_config.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_kind.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/workloads.hpp"

namespace degs::sim {

/// One view while it is compared: what its runs have in common, made once.
struct SharedView {
    int camera = 0;
    SceneFacts scene;
    const GaussianCloud* cloud = nullptr;
    std::unique_ptr<DynamicScene> dynamic; ///< if the scene changes and several frames are wanted
    std::vector<Camera> cameras;           ///< of the path, see cameras_of_frames()
    int views = 1;                         ///< of a frame
    int frames_of_path() const { return static_cast<int>(cameras.size()) / views; }
    double load_s = 0, workload_s = 0;
    std::vector<FrameWorkload> frames; ///< of the present group
    std::unique_ptr<SharedBytes> kept; ///< what its simulations keep for each other, if several
    References references;             ///< of the first frame, of `reference_kind`
    /// What the image depends on beside the view: side and mode of tiles, and the rules.
    std::pair<std::pair<int, TileMode>, RuleKind> reference_kind;

    void render_references();

    /// Gives the views of each frame the colours that they share.
    void share_colours();

    /// In the child: the summary, as a message, of a run of the whole path, or of its first frame
    /// alone, which is compared with the reference.
    std::string run(const RunRequest& request, bool path) const;
    /// In the child: the summary, as a message, of an estimate of the first frame.
    std::string estimate(const RunConfig& config) const;

private:
    ImageError error_of(std::size_t view, const Image& reference, const Image& image) const;
};

} // namespace degs::sim
