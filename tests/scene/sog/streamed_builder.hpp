// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tests/scene/sog/sog_builder.hpp"

namespace degs::test {

/// A streamed scene of two leaves and two levels: Gaussians 0 to 11 and 12 to 18 of `fine`, 0 to 2
/// and 3 to 7 of `coarse`. What differs from that is written to `index` before write().
struct StreamedBuilder {
    SogBuilder fine, coarse, environment;
    nlohmann::json index;

    StreamedBuilder() {
        coarse.count = 8;
        coarse.set_degree(1);
        coarse.low = fine.high;
        environment.count = 17;
        environment.set_degree(3);
        environment.scales = fine.low;
        const auto leaf = [](int fine_at, int fine_count, int coarse_at, int coarse_count) {
            return nlohmann::json{
                {"bound", {{"min", {0, 0, 0}}, {"max", {1, 1, 1}}}},
                {"lods",
                 {{"0", run(0, fine_at, fine_count)}, {"1", run(1, coarse_at, coarse_count)}}}};
        };
        index = {{"version", 1},   {"asset", {{"generator", "a test"}}},
                 {"count", 27},    {"counts", {19, 8}},
                 {"lodLevels", 2}, {"filenames", {"0_0/meta.json", "1_0/meta.json"}}};
        index["tree"]["children"] = {leaf(0, 12, 0, 3), leaf(12, 7, 3, 5)};
    }

    static nlohmann::json run(int file, int offset, int count) {
        return {{"file", file}, {"offset", offset}, {"count", count}};
    }
    nlohmann::json& leaf(int child) {
        return index["tree"]["children"][static_cast<std::size_t>(child)]["lods"];
    }

    /// The scene in `folder`/town; returns the name of its index.
    std::string write(const Folder& folder) const {
        unbundle(fine, folder, "town/0_0/");
        unbundle(coarse, folder, "town/1_0/");
        unbundle(environment, folder, "town/env/");
        return folder.write("town/lod-meta.json", index.dump());
    }

    static void unbundle(const SogBuilder& made, const Folder& folder, const std::string& at) {
        for (const auto& [name, content] : made.archive().files) {
            folder.write(at + name, content);
        }
    }
};

} // namespace degs::test
