// SPDX-License-Identifier: Apache-2.0
// degs motion: latencies of accelerators along a path of the head.
#include <algorithm>
#include <memory>
#include <numeric>

#include "base/visible_text.hpp"
#include "config/input_files.hpp"
#include "degs/error.hpp"
#include "sim/motion/motion_path.hpp"
#include "sim/motion/motion_session.hpp"
#include "sim/report/terminal.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/compare_request.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

struct MotionOptions {
    std::vector<std::string> configs, overrides;
    MotionRequest motion;
    std::vector<double> rates{90, 72, 120};
    std::string memory, fidelity = "exact";
    bool array_only = false;
    int jobs = 1;
    std::string out = "out";
};

void check_rates(const std::vector<double>& rates) {
    for (const double hz : rates) {
        if (std::count(rates.begin(), rates.end(), hz) > 1) {
            throw InputError("--rates has " + decimal_text(hz) + " Hz twice.");
        }
    }
}

/// The designs; one that keeps lists begins a frame when the one before is in memory, as a head
/// waits for a display.
std::vector<NamedConfig> loaded_designs(const MotionOptions& options) {
    std::vector<NamedConfig> designs =
        load_configs(options.configs, options.overrides, options.memory);
    std::vector<std::string> overrides = options.overrides;
    for (const NamedConfig& design : designs) {
        if (design.config.accelerator().keeps_lists()) {
            overrides.push_back(design.name + ":frames_in_flight=1");
        }
    }
    return overrides.size() == options.overrides.size()
               ? designs
               : load_configs(options.configs, overrides, options.memory);
}

void run(const MotionOptions& options) {
    Motion motion;
    check_rates(options.rates);
    motion.rates_hz = options.rates;
    check_view(options.motion.view);
    CompareRequest request;
    request.configs = loaded_designs(options);
    request.consecutive = true;
    request.scenes = {options.motion.view.scene};
    request.camera_file = options.motion.view.camera_file;
    request.analytic = is_analytic(options.fidelity);
    request.array_only = options.array_only;
    request.reference = false;
    request.jobs = options.jobs;
    request.path.group = options.motion.eyes;
    check_estimates(request);
    if (!options.motion.poses.empty()) {
        remember_input(options.motion.poses); // the folder refuses to replace it
    }
    const OutputFolder out(options.out, motion_files());
    MotionWords words;
    {
        const View view = load_view(options.motion.view);
        const MotionPath path = motion_path(options.motion, view.scene, motion.rates_hz.front());
        motion.times_s = path.times_s;
        request.views = path.cameras;
        words = {view.scene.name, size_words(view.camera), request.analytic,
                 options.motion.eyes.eyes_m};
    }
    request.cameras.emplace(request.views.size());
    std::iota(request.cameras->begin(), request.cameras->end(), 0);
    MotionSession session(request, out, words, std::move(motion));
    const Motion& found = session.run();
    print(motion_text(words, found) + "all numbers and pictures: " + visible(out.path("")) + "\n");
    print_warnings(session.warnings());
    if (const std::optional<Failure> failure = session.failure()) {
        throw FailureError(*failure);
    }
}

void add_path_of_motion_options(CLI::App& command, MotionRequest& motion) {
    command
        .add_option("--poses", motion.poses,
                    "CSV file of recorded poses: time_s, x, y, z, qw, qx, qy, qz; default: the "
                    "path goes through the scene's cameras, from --camera on")
        ->type_name("FILE");
    command
        .add_option("--units-per-metre", motion.eyes.units_per_metre,
                    "scene units for a metre of the recorded poses and of --eyes")
        ->check(CLI::Range(kLeastUnitsPerMetre, kMostUnitsPerMetre))
        ->capture_default_str();
    add_eyes_option(command, motion.eyes);
    command.add_flag("--in-scene", motion.in_scene,
                     "the poses are those of the camera in the scene; else the head starts at "
                     "--camera");
    command.add_option("--between", motion.between, "frames between two cameras")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command.add_option("--frames", motion.frames, "frames at most, the first ones of the path")
        ->check(CLI::Range(1, 10000));
}

} // namespace

void add_motion_command(CLI::App& program) {
    auto options = std::make_shared<MotionOptions>();
    CLI::App* command = program.add_subcommand(
        "motion", "latencies along a path of the head, and what displays show of it");
    command
        ->add_option("config", options->configs,
                     "configuration files (YAML), each as FILE or NAME=FILE")
        ->type_name("FILE")
        ->required();
    add_view_options(*command, options->motion.view);
    add_path_of_motion_options(*command, options->motion);
    command
        ->add_option("--rates", options->rates,
                     "refresh rates of displays, Hz, separated by commas; frames are rendered at "
                     "the first")
        ->type_name("HZ")
        ->delimiter(',')
        ->check(CLI::Range(1.0, 1000.0))
        ->capture_default_str();
    command
        ->add_option("--fidelity", options->fidelity,
                     "exact, or analytic for estimates without simulation")
        ->capture_default_str();
    command->add_flag("--array-only", options->array_only,
                      "the rasterisation arrays alone: sorted lists are there at once, and memory "
                      "is unlimited");
    add_addressed_overrides_option(*command, options->overrides);
    add_memory_option(*command, options->memory);
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for tables and pictures");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
