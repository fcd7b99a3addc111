// SPDX-License-Identifier: Apache-2.0
// degs accuracy: number sets against double precision.
#include <iostream>
#include <memory>

#include "sim/accuracy.hpp"
#include "sim/commands.hpp"
#include "sim/output_folder.hpp"

namespace degs::sim {
namespace {

struct AccuracyOptions {
    std::vector<std::string> numbers{"fp16", "paper", "tuned"};
    std::vector<std::string> scenes;
    ViewRequest view; ///< of each scene
    bool single_gaussian = false;
    std::uint64_t seed = 1;
    int splats = 2000;
    std::string out = "out";
};

SingleGaussianRequest request_of(const AccuracyOptions& options) {
    SingleGaussianRequest request;
    for (const std::string& name : options.numbers) {
        request.sets.push_back(number_set(name));
    }
    request.seed = options.seed;
    request.gaussians = options.splats;
    for (const std::string& scene : options.scenes) {
        request.views.push_back(options.view);
        request.views.back().scene = scene;
    }
    return request;
}

void run(const AccuracyOptions& options) {
    const SingleGaussianRequest request = request_of(options);
    const OutputFolder out(options.out, {"accuracy.json"});
    const std::vector<AccuracyRow> rows = measure_single_gaussians(request);
    out.write_json("accuracy.json", accuracy_json(rows));
    std::cout << accuracy_table(rows) << "all numbers: " << out.path("accuracy.json") << std::endl;
}

std::string set_words() {
    std::string words;
    for (const std::string& name : number_set_names()) {
        words += (words.empty() ? "" : "; ") + name + ": " + number_set(name).meaning;
    }
    return words + "; several separated by commas";
}

} // namespace

void add_accuracy_command(CLI::App& program) {
    auto options = std::make_shared<AccuracyOptions>();
    CLI::App* command = program.add_subcommand(
        "accuracy", "measure the error of number formats against double precision");
    command
        ->add_flag("--single-gaussian", options->single_gaussian,
                   "the paper's test: alpha of single Gaussians in a window of 32 x 32 pixels")
        ->required();
    command->add_option("--numbers", options->numbers, set_words())
        ->delimiter(',')
        ->take_all()
        ->capture_default_str();
    command
        ->add_option("--scene", options->scenes,
                     "scenes whose projected Gaussians are measured, too: files or "
                     "synthetic:NAME[,...]; may be repeated")
        ->take_all()
        ->expected(1);
    command->add_option("--camera", options->view.camera,
                        "position in the list of cameras, from 0");
    add_resolution_option(*command, options->view.resolution);
    command->add_option("--seed", options->seed, "of the random numbers")->capture_default_str();
    command->add_option("--splats", options->splats, "Gaussians of each kind")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    command->add_option("--out", options->out, "folder for accuracy.json")->capture_default_str();
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
