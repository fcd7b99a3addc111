// SPDX-License-Identifier: Apache-2.0
#include "tests/random/verdict.hpp"

#include <cstdint>
#include <map>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "scene/cameras/camera_path.hpp"
#include "scene/cameras/eyes.hpp"
#include "sim/design/run_config.hpp"
#include "sim/report/report.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"
#include "sim/view/workloads.hpp"
#include "splat/foveation/foveation.hpp"
#include "tests/random/promises.hpp"

namespace degs::trials {
namespace {

using nlohmann::ordered_json;

void limit_this_process(const Limits& limits) {
    const auto seconds = static_cast<rlim_t>(limits.seconds);
    const rlimit time{seconds, seconds + 1};
    ::setrlimit(RLIMIT_CPU, &time);
    if (limits.megabytes != 0) {
        const auto bytes = static_cast<rlim_t>(limits.megabytes << 20U);
        const rlimit space{bytes, bytes};
        ::setrlimit(RLIMIT_AS, &space);
    }
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
}

/// FNV-1a over the bytes of an array.
template <class Value>
void add_to(std::uint64_t& hash, const std::vector<Value>& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(Value); ++i) {
        hash = (hash ^ bytes[i]) * 0x100000001b3U;
    }
}

std::uint64_t hash_of(const std::vector<Image>& images) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const Image& image : images) {
        add_to(hash, image.rgb);
        add_to(hash, image.transmittance);
        add_to(hash, image.fragments);
    }
    return hash;
}

/// The cameras of all frames, one for each eye.
std::vector<Camera> eyes_on_path(const Trial& trial, const sim::View& view) {
    std::vector<Camera> heads =
        camera_path(view.scene.cloud, view.camera, trial.frames, trial.step_degrees);
    if (!trial.eyes) {
        return heads;
    }
    std::vector<Camera> eyes;
    for (const Camera& head : heads) {
        const std::vector<Camera> both = eyes_of(head, *trial.eyes);
        eyes.insert(eyes.end(), both.begin(), both.end());
    }
    return eyes;
}

/// The cameras of all views: those eyes, or the levels that each of them has.
std::vector<Camera> cameras_of(const Trial& trial, const sim::View& view) {
    const std::vector<Camera> eyes = eyes_on_path(trial, view);
    if (trial.foveation.empty()) {
        return eyes;
    }
    std::vector<Camera> levels;
    for (const Camera& eye : eyes) {
        for (FoveatedLevel& level : levels_of(eye, sim::foveation_of(trial.foveation))) {
            levels.push_back(std::move(level.camera));
        }
    }
    return levels;
}

/// In the child: runs the trial and says everything about it but what the machine took.
std::string run_one(const Trial& trial, const std::string& configs, const std::string& cameras,
                    const Limits& limits, Fidelity fidelity) {
    limit_this_process(limits);
    sim::RunRequest request;
    request.config = sim::load_run_config(configs + "/" + trial.config, trial.overrides());
    request.fidelity = fidelity;
    request.recording.images = true;
    request.build.array_only = trial.array_only;
    const sim::View view =
        sim::load_view({trial.scene, cameras, trial.camera, trial.width, trial.height, "", "", ""});
    double seconds = 0;
    const std::vector<Camera> views = cameras_of(trial, view);
    const std::vector<FrameWorkload> workloads = sim::make_workloads(
        view.scene.cloud, view.scene.traits, views, request.config.accelerator(), seconds);
    request.views = static_cast<int>(views.size()) / trial.frames;
    std::vector<const FrameWorkload*> frames;
    for (const FrameWorkload& workload : workloads) {
        frames.push_back(&workload);
    }
    sim::RunResult result = sim::run_frames(request, source_of(frames));
    result.scene = sim::facts_of(view.scene);
    ordered_json report = sim::report(result);
    report.erase("host");
    ordered_json said{{"report", std::move(report)},
                      {"images", hash_of(result.accelerator.images)}};
    if (fidelity == Fidelity::Exact) {
        const Finished run{request.config.accelerator(), frames, result.accelerator};
        said["bounds"] = broken_bounds(run);
        said["wrong"] = wrong_images(run);
    }
    return said.dump();
}

/// The kind of failure that a sentence of a child is about.
std::string kind_of(const std::string& sentence) {
    const auto says = [&](const char* words) { return sentence.find(words) != std::string::npos; };
    return says("deadlocked")            ? "deadlock"
           : says("CPU time limit")      ? "hang"
           : says("the model is broken") ? "law"
           : says("not enough memory")   ? "memory"
           : says("signal")              ? "crash"
                                         : "error";
}

std::string first_difference(const ordered_json& a, const ordered_json& b) {
    const ordered_json patch = ordered_json::diff(a, b);
    if (patch.empty()) {
        return "nothing but its bytes";
    }
    const std::string path = patch.front().at("path");
    const nlohmann::ordered_json::json_pointer at(path);
    const auto text = [&](const ordered_json& of) {
        return of.contains(at) ? of.at(at).dump() : std::string("nothing");
    };
    return path + " is " + text(a) + " in exact, " + text(b) + " in strict, " +
           std::to_string(patch.size()) + " values differ";
}

/// The sentence up to its numbers, to tell one cause from another.
std::string without_digits(const std::string& sentence) {
    std::string text;
    for (const char c : sentence.substr(0, sentence.find(':'))) {
        if (c < '0' || c > '9') {
            text += c;
        }
    }
    return text;
}

/// What two finished runs of a trial say together.
Verdict compared(const std::string& exact, const std::string& strict) {
    ordered_json a = ordered_json::parse(exact);
    const ordered_json b = ordered_json::parse(strict);
    Verdict verdict;
    verdict.cycles = a["report"]["timing"]["cycles"];
    const auto found = [&](const char* kind, const char* key) {
        if (verdict.kind.empty() && !a[key].empty()) {
            const std::string first = a[key].front();
            verdict.kind = std::string(kind) + ", " + without_digits(first);
            for (const auto& sentence : a[key]) {
                verdict.sentence +=
                    (verdict.sentence.empty() ? "" : "; ") + sentence.get<std::string>();
            }
        }
    };
    found("image", "wrong");
    found("bound", "bounds");
    a.erase("bounds");
    a.erase("wrong");
    if (verdict.kind.empty() && a.dump() != b.dump()) {
        verdict.kind = "fidelity";
        verdict.sentence = first_difference(a, b);
    }
    return verdict;
}

Verdict verdict_of(const sim::ChildOutcome& exact, const sim::ChildOutcome& strict) {
    for (const sim::ChildOutcome* outcome : {&exact, &strict}) {
        if (outcome->failure) {
            const std::string& sentence = outcome->failure->sentence;
            return {kind_of(sentence), sentence};
        }
    }
    return compared(exact.output, strict.output);
}

} // namespace

bool run_trials(const std::vector<Trial>& trials, const std::string& configs,
                const std::string& cameras, const Limits& limits, int jobs,
                const std::function<void(std::size_t, const Verdict&)>& ended) {
    std::vector<sim::ChildJob> list;
    for (const Trial& trial : trials) {
        for (const Fidelity fidelity : {Fidelity::Exact, Fidelity::Strict}) {
            list.push_back({fidelity == Fidelity::Exact ? "exact" : "strict", [&, fidelity] {
                                return run_one(trial, configs, cameras, limits, fidelity);
                            }});
        }
    }
    std::map<std::size_t, sim::ChildOutcome> waiting; // for the other run of their trial
    sim::ChildWatcher watcher;
    watcher.ended = [&](std::size_t job, sim::ChildOutcome&& outcome) {
        const std::size_t partner = job ^ 1U;
        const auto other = waiting.find(partner);
        if (other == waiting.end()) {
            waiting.emplace(job, std::move(outcome));
            return;
        }
        const Verdict verdict =
            job % 2 == 1 ? verdict_of(other->second, outcome) : verdict_of(outcome, other->second);
        waiting.erase(other);
        ended(job / 2, verdict);
    };
    return run_children(list, jobs, watcher);
}

} // namespace degs::trials
