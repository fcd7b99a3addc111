// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

/// What an Issue Bank skips of the work for ended pixels (paper, Sec. IV-B). `Segment`: all
/// segments of a region, row x stride, whose pixels have all ended; the array reports whole
/// regions. The others need reports of single pixels. `Task`: each segment whose own pixels have
/// all ended; any other one is issued whole. `Pixel`: every ended pixel.
enum class TerminationGrain { Segment, Task, Pixel };

} // namespace degs
