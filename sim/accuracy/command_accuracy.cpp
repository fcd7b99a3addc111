// SPDX-License-Identifier: Apache-2.0
// degs accuracy: number sets against double precision.
#include <memory>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "scene/scene_spec.hpp"
#include "sim/accuracy/accuracy.hpp"
#include "sim/accuracy/accuracy_numbers.hpp"
#include "sim/accuracy/hard_case_run.hpp"
#include "sim/accuracy/speed/speed.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/rule_options.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/standard_output.hpp"
#include "splat/pixels/quantized_gemm.hpp"

namespace degs::sim {
namespace {

struct AccuracyOptions {
    std::vector<std::string> numbers{"fp16", "paper", "tuned"};
    std::vector<std::string> scenes; ///< as written
    ViewRequest view;                ///< of each scene
    GroupRequest group;
    std::vector<std::string> resolutions;
    std::string span_ends;
    int tile_size = 32;
    RenderingRules rules; ///< of the views
    std::string products;
    bool no_error_images = false;
    bool single_gaussian = false;
    bool hard_cases = false;
    std::vector<std::string> only;  ///< hard cases
    std::vector<std::string> speed; ///< configurations, as written
    std::vector<std::string> overrides;
    std::string memory; ///< of these configurations
    std::vector<std::string> fidelities{"strict", "exact", "within:1%", "analytic"};
    std::uint64_t seeds = 5;
    bool own_numbers = false; ///< --numbers was given
    std::uint64_t seed = 1;
    int splats = 2000;
    std::string out = "out";
};

/// One request per scene, without a resolution.
std::vector<ViewRequest> views_of(const AccuracyOptions& options) {
    std::vector<ViewRequest> views;
    for (const std::string& scene : split_scenes(options.scenes)) {
        views.push_back(options.view);
        views.back().scene = scene;
    }
    return views;
}

SingleGaussianRequest single_request(const AccuracyOptions& options) {
    SingleGaussianRequest request;
    for (const std::string& name : options.numbers) {
        request.sets.push_back(numbers_of(name, options.span_ends).set);
    }
    request.seed = options.seed;
    request.gaussians = options.splats;
    request.rules = options.rules;
    request.group = options.group;
    const std::vector<std::string> own{""}; // the view's size
    for (const ViewRequest& view : views_of(options)) {
        for (const std::string& resolution :
             options.resolutions.empty() ? own : options.resolutions) {
            request.views.push_back(view);
            request.views.back().resolution = resolution;
        }
    }
    return request;
}

/// Reports a scene that does not exist before the scenes in front of it have been measured.
void check_scene(const std::string& scene) {
    if (scene.empty()) {
        throw InputError("A scene has an empty name; a file or synthetic:NAME is needed.");
    }
    if (const SceneSpec spec = parse_scene_spec(scene); !spec.synthetic) {
        const InputFile exists(spec.path);
    }
}

SceneAccuracyRequest scene_request(const AccuracyOptions& options) {
    SceneAccuracyRequest request;
    for (const std::string& name : options.numbers) {
        numbers_of(name, options.span_ends); // reports a mistake before a scene loads
    }
    for (const std::string& size : options.resolutions) {
        image_size(size);
    }
    request.sets = options.numbers;
    request.scenes = views_of(options);
    request.group = options.group;
    for (const ViewRequest& view : request.scenes) {
        check_scene(view.scene);
    }
    request.resolutions = options.resolutions;
    request.span_ends = options.span_ends;
    request.tile_size = options.tile_size;
    request.rules = options.rules;
    if (!options.products.empty()) {
        request.gemm =
            half_precision_gemm(options.products == "tile" ? GemmOrigin::Tile : GemmOrigin::Image);
    }
    request.error_images = !options.no_error_images;
    return request;
}

/// What the folder receives; in both cases the results of the other are replaced.
const std::vector<std::string> kAccuracyFiles{"accuracy.json", "accuracy.svg"};

/// Writes what `measure` returns, together with the files that it writes.
template <class Measure>
void write_accuracy(const OutputFolder& out, const Measure& measure) {
    std::string words;
    out.replace(
        [&] {
            const std::vector<AccuracyRow> rows = measure();
            const std::string plot = accuracy_svg(rows);
            out.write_json("accuracy.json", accuracy_json(rows));
            words =
                accuracy_table(rows) + "all numbers: " + visible(out.path("accuracy.json")) + "\n";
            if (!plot.empty()) {
                out.write_text("accuracy.svg", plot);
                words += "plot: " + visible(out.path("accuracy.svg")) + "\n";
            }
        },
        old_error_images(out));
    print(words);
}

void run_hard(const AccuracyOptions& options) {
    HardCaseRequest request;
    request.only = options.only;
    request.sets = options.numbers;
    request.resolutions = options.resolutions;
    if (request.resolutions.empty()) {
        request.resolutions = {"720p"};
    }
    for (const std::string& name : request.sets) {
        numbers_of(name, options.span_ends);
    }
    for (const std::string& name : request.resolutions) {
        resolution_height(name);
    }
    request.span_ends = options.span_ends;
    request.tile_size = options.tile_size;
    const OutputFolder out(options.out, {"hard_cases.json", "hard_cases.md"});
    const std::vector<HardResult> results = run_hard_cases(request, out.path(""));
    out.replace([&] {
        out.write_json("hard_cases.json", hard_case_json(results));
        out.write_text("hard_cases.md", hard_case_markdown(results));
    });
    print(hard_case_table(results) + "all numbers: " + visible(out.path("hard_cases.json")) + "\n");
}

SpeedRequest speed_request(const AccuracyOptions& options) {
    SpeedRequest request;
    request.designs = speed_designs(
        options.speed, options.overrides,
        options.own_numbers ? options.numbers : std::vector<std::string>(), options.memory);
    for (const std::string& name : options.fidelities) {
        speed_fidelity(name); // reports a mistake before anything runs
    }
    request.fidelities = options.fidelities;
    request.seeds = options.seeds;
    const std::vector<ViewRequest> views = views_of(options);
    if (views.size() != 1 || options.resolutions.size() > 1) {
        throw InputError("--speed measures one view: one --scene and at most one --resolution.");
    }
    check_scene(views.front().scene);
    request.view = views.front();
    request.view.resolution = options.resolutions.empty() ? "" : options.resolutions.front();
    return request;
}

void run_speed(const AccuracyOptions& options) {
    const SpeedRequest request = speed_request(options);
    const OutputFolder out(options.out, {"speed.json", "speed.svg"});
    const SpeedResult result = measure_speed(request);
    out.replace([&] {
        out.write_json("speed.json", speed_json(result));
        out.write_text("speed.svg", speed_svg(result));
    });
    print(speed_table(result) + "all numbers: " + visible(out.path("speed.json")) +
          "\nplot: " + visible(out.path("speed.svg")) + "\n");
}

void run(const AccuracyOptions& options) {
    if (!options.speed.empty()) {
        run_speed(options);
        return;
    }
    if (options.hard_cases) {
        run_hard(options);
        return;
    }
    if (options.single_gaussian) {
        const SingleGaussianRequest request = single_request(options);
        const OutputFolder out(options.out, kAccuracyFiles);
        write_accuracy(out, [&] { return measure_single_gaussians(request); });
        return;
    }
    const SceneAccuracyRequest request = scene_request(options);
    const OutputFolder out(options.out, kAccuracyFiles);
    write_accuracy(out, [&] { return measure_scenes(request, out); });
}

std::string set_words() {
    std::string words;
    for (const std::string& name : number_set_names()) {
        words += (words.empty() ? "" : "; ") + name + ": " + number_set(name).meaning;
    }
    return words +
           "; or number files; several separated by commas; tuned:projection=fp64:alpha=uq1.15 "
           "changes parts, which degs config --keys numbers lists";
}

void add_scene_options(CLI::App& command, AccuracyOptions& options) {
    command
        .add_option("--scene", options.scenes,
                    "scenes: files or synthetic:NAME[,...]; several separated by commas, or "
                    "repeated; with --single-gaussian, their projected Gaussians are measured")
        ->type_name("SCENE")
        ->take_all()
        ->expected(1);
    add_camera_options(command, options.view);
    add_size_options(command, options.view);
    command
        .add_option("--resolution", options.resolutions,
                    "720p, 1080p, 2k, 4k or 8k: images 720, 1080, 1440, 2160 or 4320 pixels high; "
                    "or WIDTHxHEIGHT, but for hard cases; several separated by commas")
        ->type_name("SIZES")
        ->delimiter(',')
        ->take_all();
    add_crop_option(command, options.view.crop);
    add_group_options(command, options.group);
    command
        .add_option("--span-ends", options.span_ends,
                    "span ends of all number sets; without it each has its own")
        ->check(CLI::IsMember(span_end_names()));
    command
        .add_option("--tile-size", options.tile_size,
                    "px; outward span ends and the places where q_n starts depend on it")
        ->check(CLI::Range(1, 128))
        ->capture_default_str();
    add_rule_options(command, options.rules);
    command
        .add_option(
            "--products", options.products,
            "exponents as products of matrices, as a systolic array forms them, from the middle of "
            "each tile or from the corner of the image; number sets multiply FP16 and add FP32")
        ->check(CLI::IsMember({"tile", "image"}));
    command.add_flag("--no-error-images", options.no_error_images,
                     "write no EXR of the differences, which take up to 20 B per pixel each");
}

} // namespace

void add_accuracy_command(CLI::App& program) {
    auto options = std::make_shared<AccuracyOptions>();
    CLI::App* command = program.add_subcommand(
        "accuracy", "measure the error of number formats against double precision");
    command->add_flag("--single-gaussian", options->single_gaussian,
                      "the paper's test: alpha of single Gaussians in a window of 32 x 32 pixels");
    command->add_flag(
        "--hard-cases", options->hard_cases,
        "generated scenes that break renderers, in images of 16:9 (docs/numerical-stability.md)");
    command->add_option("--only", options->only, "hard cases, e.g. H7,H19; all without it")
        ->type_name("NAMES")
        ->delimiter(',')
        ->take_all();
    command
        ->add_option("--speed", options->speed,
                     "speed of runs of these configurations against their error: every fidelity "
                     "in `ideal`, `fp32` and the numbers of the configuration, or in those of "
                     "--numbers; as FILE or NAME=FILE, several separated by spaces")
        ->type_name("FILES");
    command
        ->add_option("--fidelities", options->fidelities,
                     "strict, exact, sampled:10%, within:1%, analytic; several separated by commas")
        ->type_name("NAMES")
        ->delimiter(',')
        ->take_all()
        ->capture_default_str();
    command->add_option("--seeds", options->seeds, "samples of each kind: seeds 1 to this number")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    add_addressed_overrides_option(*command, options->overrides);
    add_memory_option(*command, options->memory);
    CLI::Option* numbers = command->add_option("--numbers", options->numbers, set_words())
                               ->type_name("NAMES")
                               ->delimiter(',')
                               ->take_all()
                               ->capture_default_str();
    add_scene_options(*command, *options);
    command->add_option("--seed", options->seed, "seed of the random numbers of single Gaussians")
        ->capture_default_str();
    command->add_option("--splats", options->splats, "number of single Gaussians of each kind")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    add_out_option(*command, options->out, "folder for accuracy.json, the plot and the images");
    command->callback([options, numbers] {
        options->own_numbers = numbers->count() > 0;
        run(*options);
    });
}

} // namespace degs::sim
