// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <limits>

#include "tests/bench/groups.hpp"
#include "tests/bench/limits.hpp"
#include "tests/bench/program.hpp"

namespace degs::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Runs of a design on a view. Other work on the machine only adds to a time, so the smallest one
/// counts.
struct Times {
    double sim_s = kNever, render_s = kNever;
    double all_s = kNever; ///< of the simulation and of the functional model's thread
    double fragments = 0;  ///< of the design
    double accesses = 0;   ///< of 64 B to the channels of an LPDDR5 memory

    void add(const nlohmann::json& report) {
        const nlohmann::json& host = report["host"];
        sim_s = std::min(sim_s, host["sim_s"].get<double>());
        all_s = std::min(all_s, host["sim_s"].get<double>() + host["functional_s"].get<double>());
        if (host["render_s"].is_number()) {
            render_s = std::min(render_s, host["render_s"].get<double>());
        }
        fragments = report["slots"]["useful"].get<double>();
        accesses = 0;
        for (const auto& count :
             report.value("/dram/channels/accesses"_json_pointer, nlohmann::json::object())) {
            accesses += count.get<double>();
        }
    }
    double ns_per_fragment() const { return 1e9 * sim_s / fragments; }
};

const std::vector<std::string> kFp32{"--set", "pipeline.numbers=fp32"};

std::vector<std::string> with(std::vector<std::string> options, const std::string& more) {
    options.push_back(more);
    return options;
}

/// host.sim_s of degs-64 over host.render_s of the same frame.
void over_reference(benchmark::State& state, const View& view, const std::string& numbers,
                    double limit) {
    Times times;
    for (auto iteration : state) {
        (void)iteration;
        times.add(run_design("degs-64", view, {"--set", "pipeline.numbers=" + numbers}));
        state.SetIterationTime(times.sim_s);
    }
    report_ratio(state, times.sim_s / times.render_s, limit);
    state.counters["both processors"] = times.all_s / times.render_s;
    state.counters["ns/fragment"] = times.ns_per_fragment();
}

/// Time per fragment in a large image over that in a small one.
void by_resolution(benchmark::State& state, const View& small, const View& large, double limit) {
    const Folder cache;
    Times of_small, of_large;
    for (auto iteration : state) {
        (void)iteration;
        of_small.add(run_design("degs-64", small, with(kFp32, "--no-reference"), cache.path()));
        of_large.add(run_design("degs-64", large, with(kFp32, "--no-reference"), cache.path()));
        state.SetIterationTime(of_small.sim_s + of_large.sim_s);
    }
    report_ratio(state, of_large.ns_per_fragment() / of_small.ns_per_fragment(), limit);
    state.counters["ns/fragment"] = of_large.ns_per_fragment();
}

/// Time of a frame on 1024 PEs over that on 64.
void by_size(benchmark::State& state, const View& view, double limit) {
    const Folder cache;
    Times of_small, of_large;
    for (auto iteration : state) {
        (void)iteration;
        of_small.add(run_design("degs-64", view, with(kFp32, "--no-reference"), cache.path()));
        of_large.add(run_design("degs-1024", view, with(kFp32, "--no-reference"), cache.path()));
        state.SetIterationTime(of_small.sim_s + of_large.sim_s);
    }
    report_ratio(state, of_large.sim_s / of_small.sim_s, limit);
    state.counters["ns/fragment"] = of_large.ns_per_fragment();
}

/// Time per fragment on a design over that on degs-64, both as their files say.
void by_design(benchmark::State& state, const std::string& design, const View& view, double limit) {
    const Folder cache;
    Times of_paper, of_other;
    for (auto iteration : state) {
        (void)iteration;
        of_paper.add(run_design("degs-64", view, {"--no-reference"}, cache.path()));
        of_other.add(run_design(design, view, {"--no-reference"}, cache.path()));
        state.SetIterationTime(of_paper.sim_s + of_other.sim_s);
    }
    report_ratio(state, of_other.ns_per_fragment() / of_paper.ns_per_fragment(), limit);
    state.counters["ns/fragment"] = of_other.ns_per_fragment();
}

/// Time per fragment on degs-64 with `more` over that without.
void by_option(benchmark::State& state, const std::vector<std::string>& more, const View& view,
               double limit) {
    const Folder cache, results;
    std::vector<std::string> changed = with(more, "--no-reference");
    if (more.front() == "--trace") {
        changed.insert(changed.begin() + 1, (results.path() / "trace.json").string());
    }
    Times of_plain, of_changed;
    for (auto iteration : state) {
        (void)iteration;
        of_plain.add(run_design("degs-64", view, {"--no-reference"}, cache.path()));
        of_changed.add(run_design("degs-64", view, changed, cache.path()));
        state.SetIterationTime(of_plain.sim_s + of_changed.sim_s);
    }
    report_ratio(state, of_changed.ns_per_fragment() / of_plain.ns_per_fragment(), limit);
    state.counters["ns/fragment"] = of_changed.ns_per_fragment();
}

/// Time of a frame with LPDDR5 over that with the bus, both of 204.8 GB/s.
void by_memory(benchmark::State& state, const View& view, double limit) {
    const Folder cache;
    Times of_bus, of_lpddr5;
    const std::vector<std::string> alone = with(kFp32, "--no-reference");
    std::vector<std::string> banks = with(alone, "--memory");
    banks.push_back(std::string(DEGS_CONFIGS) + "/memory/lpddr5-6400x256.yaml");
    for (auto iteration : state) {
        (void)iteration;
        of_bus.add(run_design("degs-64", view, alone, cache.path()));
        of_lpddr5.add(run_design("degs-64", view, banks, cache.path()));
        state.SetIterationTime(of_bus.sim_s + of_lpddr5.sim_s);
    }
    report_ratio(state, of_lpddr5.sim_s / of_bus.sim_s, limit);
    state.counters["of the bus s"] = of_bus.sim_s;
    state.counters["M accesses"] = 1e-6 * of_lpddr5.accesses;
}

void add_by_memory(const std::string& name, const View& view, double limit) {
    add_ratio("LPDDR5 over bus/" + name,
              [=](benchmark::State& state) { by_memory(state, view, limit); });
}

void add_over_reference(const std::string& name, const View& view) {
    // Single precision is the machine's own. In the formats of `paper` every operation is rounded
    // as well.
    const std::pair<const char*, double> numbers[] = {{"fp32", 2.0}, {"paper", 3.0}};
    for (const auto& [set, limit] : numbers) {
        add_ratio("exact over reference/" + name + "/" + set,
                  [view, set = std::string(set), limit = limit](benchmark::State& state) {
                      over_reference(state, view, set, limit);
                  });
    }
}

/// What takes packets apart, or follows them: the aim is 1.3.
void add_by_option(const View& view) {
    const std::pair<const char*, std::vector<std::string>> options[] = {
        {"packing.ports=2", {"--set", "packing.ports=2"}},
        {"pixel_buffer.ports=1", {"--set", "pixel_buffer.ports=1"}},
        {"scheduler.select_cycles=2", {"--set", "scheduler.select_cycles=2"}},
        {"packing.reorganisation=false", {"--set", "packing.reorganisation=false"}},
        {"--trace", {"--trace"}}};
    for (const auto& [name, more] : options) {
        add_ratio(
            "time per fragment, an option over none/" + std::string(name),
            [view, more = more](benchmark::State& state) { by_option(state, more, view, 1.6); });
    }
}

} // namespace

void register_frames() {
    const bool brief = options().shortened;
    const std::string object = "synthetic:object";
    const std::vector<std::string> close =
        brief ? std::vector<std::string>{"--width", "320"} : std::vector<std::string>{};
    add_over_reference(object, {object, 2, close});
    if (const auto scenes = trained_scenes(); scenes.empty()) {
        std::fputs(
            "The trained scenes are not there, so only synthetic ones are measured; the variable "
            "DEGS_SCENES names their folder.\n",
            stderr);
    } else if (!brief) {
        // Requests of deep queues, each answered when it comes: docs/performance.md says why these
        // views and those below are above 1.35. Their limits are a guard.
        const std::string flowers = (scenes / "flowers" / "scene.ply").string();
        for (const char* size : {"720p", "1080p", "2k", "4k"}) {
            add_by_memory(std::string("flowers, ") + size, {flowers, 1, {"--resolution", size}}, 3);
        }
        for (const char* scene : {"flowers", "guitar", "seal", "skull", "st-peter"}) {
            add_over_reference(scene, {(scenes / scene / "scene.ply").string(), 2, {}});
        }
    }
    const View small{object, 2, brief ? close : std::vector<std::string>{"--resolution", "1080p"}};
    const View large{object, 2,
                     brief ? std::vector<std::string>{"--width", "640"}
                           : std::vector<std::string>{"--resolution", "8k"}};
    add_ratio(brief ? "time per fragment, 640 over 320 px wide"
                    : "time per fragment, 8K over 1080p",
              [=](benchmark::State& state) { by_resolution(state, small, large, 1.2); });
    add_ratio("time of a frame, 1024 over 64 PEs",
              [=](benchmark::State& state) { by_size(state, small, 1.5); });
    // Most tiles of the first are empty, so that most requests are writes of background.
    const std::string one = "synthetic:single";
    add_by_memory(brief ? "mostly empty" : "mostly empty, 4K",
                  {one, 1, brief ? close : std::vector<std::string>{"--resolution", "4k"}}, 4);
    add_by_memory("close-up", small, 2.5);
    add_by_option(small);
    for (const std::string design : {"degs-x-64"}) {
        for (const int camera : {2, 1}) {
            const View view{object, camera, small.size};
            add_ratio("time per fragment, " + design + " over degs-64/camera " +
                          std::to_string(camera),
                      [=](benchmark::State& state) { by_design(state, design, view, 1.6); });
        }
    }
}

} // namespace degs::bench
