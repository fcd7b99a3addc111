// SPDX-License-Identifier: Apache-2.0
#include "sim/view/reference.hpp"

#include "sim/process/stopwatch.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

Reference make_reference(const FrameWorkload& workload) {
    const Progress progress("reference image");
    const CpuStopwatch clock;
    Reference reference;
    reference.image = render_reference(workload, reference.counts);
    reference.render_s = clock.seconds();
    return reference;
}

Reference make_reference(const GaussianCloud& cloud, const FrameWorkload& frame, double& seconds) {
    if (frame.projection.numbers.is_reference()) {
        return make_reference(frame);
    }
    const Stopwatch clock;
    ProjectionOptions options = frame.projection;
    options.numbers = ProjectionNumbers();
    const FrameWorkload exact =
        make_frame_workload(cloud, frame.camera, frame.tile_size, frame.tile_mode, options);
    seconds += clock.seconds();
    return make_reference(exact);
}

} // namespace degs::sim
