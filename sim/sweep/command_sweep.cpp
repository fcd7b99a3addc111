// SPDX-License-Identifier: Apache-2.0
// degs sweep: every point of a study.
#include <filesystem>
#include <memory>

#include "base/visible_text.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "scene/cameras/orbit_camera.hpp"
#include "scene/scene_cameras.hpp"
#include "sim/command_line/stated_command.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/scene_words.hpp"
#include "sim/runs/view_runs.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/study_options.hpp"
#include "sim/sweep/array_task.hpp"
#include "sim/sweep/ranking.hpp"
#include "sim/sweep/slurm.hpp"
#include "sim/sweep/sweep_results.hpp"
#include "sim/sweep/sweep_session.hpp"
#include "sim/text/shell_word.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

constexpr double kSecondsBetweenResults = 10; ///< so that writing them takes no time worth naming

constexpr int kSlurmTasks = 64; ///< most tasks of an array, unless others are asked for

struct SweepOptions {
    StudyOptions study;
    int jobs = 1;
    std::optional<std::string> shard;
    bool collect = false, list = false;
    bool slurm = false;
    int tasks = kSlurmTasks;
    std::vector<std::string> sbatch;
    std::string out = "out";
    std::string sort; ///< goals; empty: no table
    std::size_t top = 10;
    std::string stated; ///< "sweep study.yaml ...", see stated_command()
};

/// The table that was asked for.
std::string ranking_of(const SweepOptions& options, const StudyPlan& plan,
                       const SweepResults& results) {
    return options.sort.empty()
               ? ""
               : ranking_text(plan, results, parse_goals(options.sort, "--sort"), options.top);
}

/// The part that --shard names; all points if nothing is given.
std::vector<std::size_t> own_points(const std::optional<std::string>& given, std::size_t points) {
    const ArrayTask task = given ? parse_shard(*given) : ArrayTask();
    return points_of(shard_of(points, task.k, task.n));
}

/// This program with the same study and the same place for results.
std::string command_of(const SweepOptions& options) {
    std::error_code none;
    const std::string program = std::filesystem::read_symlink("/proc/self/exe", none).string();
    return shell_word(none ? "degs" : program) + " " + options.stated + " " +
           shell_word("--out=" + options.out) + " --jobs " + std::to_string(options.jobs);
}

/// Writes the script of an array over the parts that have points to run, and submits it.
void submit(const SweepOptions& options, const StudyPlan& plan) {
    SlurmArray array;
    array.name = file_name("degs-" + plan.name);
    array.command = command_of(options);
    array.options = options.sbatch;
    array.processors = options.jobs;
    array.parts = std::min<std::size_t>(options.tasks, plan.points.size());
    array.logs = (std::filesystem::path(options.out) / "slurm").string();
    slurm_script(array); // a mistake in the options is found before anything is written
    const PointStore store(options.out, plan);
    for (std::size_t k = 1; k <= array.parts; ++k) {
        const PointRange range = shard_of(plan.points.size(), k, array.parts);
        std::size_t p = range.begin;
        while (p < range.end && store.read(p)) {
            ++p;
        }
        if (p < range.end) {
            array.tasks.push_back(k);
        }
    }
    const std::string out = visible(store.folder().path(""));
    if (array.tasks.empty()) {
        print("All points are finished; --collect makes the results in " + out + "\n");
        return;
    }
    const OutputFolder logs(store.folder().path("slurm"), {});
    store.folder().write_text("slurm.sh", slurm_script(array));
    const std::string job = submit_script(store.folder().path("slurm.sh"));
    print("job " + visible(job) + ": " + grouped(array.tasks.size()) + " tasks for " +
          grouped(plan.points.size()) + " points; when they have ended, --collect makes the " +
          "results in " + out + "\n");
}

/// "96×54": the size of the images on a point's view; `cameras` are those of its scene.
std::string size_of(const StudyPlan& plan, const StudyPoint& point,
                    const std::vector<Camera>& cameras) {
    Camera camera;
    if (cameras.empty()) { // the view that is generated
        camera.width = OrbitOptions().width;
        camera.height = OrbitOptions().height;
    } else {
        camera = cameras.at(point.camera);
    }
    const ImageSize& size = plan.request.sizes[point.size];
    const int views = plan.request.path.group.images();
    return (views > 1 ? std::to_string(views) + " × " : "") +
           size_words(resize_and_crop(camera, size.width, size.height, plan.request.crop));
}

std::string plan_text(const StudyPlan& plan) {
    std::vector<std::vector<Camera>> cameras;
    for (const std::string& scene : plan.request.scenes) {
        cameras.push_back(cameras_of_scene(scene, plan.request.camera_file));
    }
    std::string text;
    for (std::size_t p = 0; p < plan.points.size(); ++p) {
        const StudyPoint& point = plan.points[p];
        text += std::to_string(p + 1) + "  " + visible(plan.variants[point.variant].name) + ", " +
                visible(plan.request.scenes[point.scene]) + ", camera " +
                std::to_string(point.camera) + ", " + size_of(plan, point, cameras[point.scene]) +
                "\n";
    }
    for (const SkippedVariant& skipped : plan.skipped) {
        text += "cannot be built: " + visible(skipped.variant.name) + ": " + visible(skipped.why) +
                "\n";
    }
    return text;
}

/// Which points are missing and why, as far as the folder tells.
std::string missing_words(const SweepResults& results, const OutputFolder& folder) {
    namespace fs = std::filesystem;
    std::string text = grouped(results.missing) + " points are missing";
    if (results.damaged != 0) {
        text += ", " + grouped(results.damaged) + " of them because their files are damaged";
    }
    std::error_code none;
    if (fs::exists(folder.path("slurm.sh"), none)) {
        const bool logs =
            fs::directory_iterator(folder.path("slurm"), none) != fs::directory_iterator();
        text +=
            logs
                ? "; the tasks of the job array have failed or not ended yet, and 'slurm/K.log' in "
                  "the folder has what they printed"
                : "; no task of the job array has written a 'slurm/K.log', so none has started, "
                  "and "
                  "'squeue' or 'sacct' says why";
    }
    return text + "; 'degs sweep' without --collect runs them.";
}

void publish(const StudyPlan& plan, const SweepResults& results, const PointStore& store) {
    store.require_own();
    write_results(plan, results, store.folder());
}

/// Results of all points, whoever ran them. Throws FailureError if some are missing or failed.
void collect(const SweepOptions& options, const StudyPlan& plan, const PointStore& store) {
    const SweepResults results = read_results(plan, store);
    publish(plan, results, store);
    if (results.missing == 0) {
        store.sweep_up();
    }
    print(results_text(plan, results) + ranking_of(options, plan, results) +
          "all numbers and plots: " + visible(store.folder().path("")) + "\n");
    print_warnings(results.warnings);
    if (results.missing != 0) {
        throw FailureError({kUserError, missing_words(results, store.folder())});
    }
    if (!results.failed.empty()) {
        throw FailureError(results.failed.front().failure);
    }
}

void run(const SweepOptions& options) {
    if (!options.sort.empty()) {
        parse_goals(options.sort, "--sort"); // a mistake is found before anything runs
    }
    StudyPlan plan = plan_study(study_of(options.study));
    plan.request.jobs = options.jobs;
    if (options.list) {
        print(plan_text(plan));
        return;
    }
    if (options.slurm) {
        submit(options, plan);
        return;
    }
    const std::vector<std::size_t> points = own_points(options.shard, plan.points.size());
    const PointStore store(options.out, plan);
    if (options.collect) {
        collect(options, plan, store);
        return;
    }
    const bool whole = !options.shard;
    Stopwatch since_results;
    const auto write = [&] {
        if (whole && since_results.seconds() > kSecondsBetweenResults) {
            publish(plan, read_results(plan, store), store);
            since_results = Stopwatch();
        }
    };
    SweepSession session(plan, store, points, write);
    const bool complete = session.run();
    if (whole) {
        const SweepResults results = read_results(plan, store);
        publish(plan, results, store);
        if (complete) {
            store.sweep_up();
            print(results_text(plan, results) + ranking_of(options, plan, results) +
                  "all numbers and plots: " + visible(store.folder().path("")) + "\n");
            print_warnings(results.warnings);
        }
    }
    if (const std::optional<Failure> failure = session.failure()) {
        throw FailureError(*failure);
    }
}

} // namespace

void add_sweep_command(CLI::App& program) {
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command =
        program.add_subcommand("sweep", "run every point of a study, or go on with it");
    add_study_options(*command, options->study);
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for points, results and reports");
    command
        ->add_option("--shard", options->shard,
                     "run the K-th of N parts of the points only, or with auto the part of this "
                     "task of a job array; --collect makes the results")
        ->type_name("K/N");
    command->add_flag("--collect", options->collect,
                      "run nothing; make the results of the points in the folder");
    command->add_flag("--list", options->list, "run nothing; list the points");
    command
        ->add_option("--sort", options->sort,
                     "print the best designs by these goals, in this order of importance")
        ->type_name("A,B,...");
    command->add_option("--top", options->top, "designs to print with --sort")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_flag(
        "--slurm", options->slurm,
        "run nothing here; submit the points as a job array of Slurm, then use --collect");
    command->add_option("--tasks", options->tasks, "most tasks of the job array")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command
        ->add_option("--sbatch", options->sbatch,
                     "options of sbatch for the script, such as '--partition=short --time=60'; may "
                     "be repeated")
        ->type_name("TEXT")
        ->take_all()
        ->expected(1);
    command->callback([options, command] {
        options->stated = stated_command(*command);
        run(*options);
    });
}

} // namespace degs::sim
