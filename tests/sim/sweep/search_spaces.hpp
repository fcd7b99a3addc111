// SPDX-License-Identifier: Apache-2.0
// Studies that tests of searches share.
#pragma once

#include <string>
#include <vector>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {

/// Half of the designs of two_view_space().
inline const std::vector<std::string> kHalf{"--budget", "12"};

/// 24 designs on two views.
inline std::string two_view_space(const Folder& folder) {
    const std::string file = folder / "space.yaml";
    std::ofstream(file) << "study: space\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: [2, 4, 8, 16]\n"
                           "  array.pes_per_bank: [4, 8, 16]\n  packing.bytes: [x1, x2]\n"
                           "scenes: synthetic:object,gaussians=300\ncameras: [0, 2]\n"
                           "width: 128\nreference: false\n";
    return file;
}

/// Six designs, of which simulations of three fail, because their list entries cannot hold an index
/// of so many visible splats. Their estimates do not look at that.
inline std::string failing_space(const Folder& folder) {
    const std::string file = folder / "failing.yaml";
    std::ofstream(file) << "study: failing\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\n"
                           "    pipeline: { numbers: \"paper:depth_key=ue4m12b3\" }\n"
                           "    traffic: { list_entry_bytes: 6 }\n"
                           "axes:\n  traffic.list_entry_bytes: [4, 6]\n"
                           "  span.count: [4, 8, 16]\n"
                           "scenes: synthetic:object,gaussians=80000\nwidth: 32\n"
                           "reference: false\n";
    return file;
}

} // namespace degs::sim_test
