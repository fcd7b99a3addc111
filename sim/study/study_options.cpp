// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study_options.hpp"

#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/compare_request.hpp"

namespace degs::sim {

void add_study_options(CLI::App& command, StudyOptions& options) {
    command.add_option("study", options.file, "study (YAML): designs, axes and views")
        ->type_name("FILE")
        ->required();
    add_addressed_overrides_option(command, options.overrides);
    add_memory_option(command, options.memory);
    add_study_view_options(command, options);
}

void add_study_view_options(CLI::App& command, ViewOptions& options) {
    command
        .add_option("--scene", options.scenes,
                    "scenes, in place of those of a study: a file, or "
                    "synthetic:NAME[,gaussians=N][,seed=N]; may be repeated")
        ->type_name("SCENE")
        ->take_all()
        ->expected(1);
    command
        .add_option(
            "--camera,--cameras", options.cameras,
            "positions in the scene's list of cameras, from 0: 0,2 or all; in place of those "
            "of a study")
        ->type_name("LIST");
    add_camera_file_option(command, options.camera_file);
    command
        .add_option("--resolution", options.resolutions,
                    "720p, 1080p, 2k, 4k, 8k or WIDTHxHEIGHT, or several separated by commas; in "
                    "place of those of a study")
        ->type_name("SIZES");
    command.add_option("--width", options.width, "image width in pixels; the views are scaled");
    add_crop_option(command, options.crop);
    add_path_options(command, options.path);
    add_group_options(command, options.path.group);
    command.add_flag("--quick", options.quick,
                     "the few views that the section 'quick' of the study names");
    command.add_flag("--array-only", options.array_only,
                     "the rasterisation arrays alone: sorted lists are there at once, and memory "
                     "is unlimited");
    command.add_flag("--no-reference", options.no_reference,
                     "do not render the double-precision images to compare with");
    command
        .add_option(
            "--fidelity", options.fidelity,
            "exact, or analytic: estimates in milliseconds, without simulations and images; "
            "in place of that of a study")
        ->type_name("TEXT:{exact,analytic}"); // what can be completed
    add_sampling_options(command, options.within, options.seed);
    // What a flag of CLI11 cannot say: whether an option with a default was given.
    command.get_option("--frames")->each([&options](const std::string&) {
        options.has_frames = true;
    });
    command.get_option("--path-step")->each([&options](const std::string&) {
        options.has_step = true;
    });
    command.get_option("--units-per-metre")->each([&options](const std::string&) {
        options.has_units = true;
    });
}

namespace {

void replace_group(const ViewOptions& options, GroupRequest& group) {
    const GroupRequest& given = options.path.group;
    if (!options.cameras.empty() || given.eyes_m) {
        group.cameras.clear();
    }
    if (given.eyes_m) {
        group.eyes_m = given.eyes_m;
        group.units_per_metre = options.has_units ? given.units_per_metre : group.units_per_metre;
    }
    if (!given.cameras.empty()) {
        group = given;
    }
}

} // namespace

void replace_views(const ViewOptions& options, StudyViews& views) {
    if (!options.scenes.empty()) {
        views.scenes = options.scenes;
    }
    if (!options.cameras.empty()) {
        views.cameras = options.cameras;
    }
    if (!options.camera_file.empty()) {
        views.camera_file = options.camera_file;
    }
    if (!options.resolutions.empty() || options.width) {
        views.resolutions = options.resolutions;
        views.width = options.width;
        views.crop.clear(); // it is of images in the other size
    }
    if (!options.crop.empty()) {
        views.crop = options.crop;
    }
    replace_group(options, views.path.group);
    if (options.has_frames) {
        views.path.frames = options.path.frames;
    }
    if (options.has_step) {
        views.path.step_degrees = options.path.step_degrees;
    }
    views.analytic = options.fidelity.empty() ? views.analytic : is_analytic(options.fidelity);
    views.array_only = views.array_only || options.array_only;
    views.reference = views.reference && !options.no_reference;
}

Study study_of(const StudyOptions& options) {
    Study study = read_study(options.file, options.quick);
    study.overrides = options.overrides;
    for (StudyDesign& design : study.designs) {
        put_memory(design.tree, options.memory);
    }
    study.memory = options.memory;
    replace_views(options, study);
    study.sampling = sampling_for_runs(options.within, options.seed);
    return study;
}

} // namespace degs::sim
