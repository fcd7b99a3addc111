// SPDX-License-Identifier: Apache-2.0
// The options that all commands with a scene share. Not in view.hpp, because CLI11 costs seconds in
// every source that sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/App.hpp>

#include "sim/view/view.hpp"

namespace degs::sim {

/// Adds --scene, --camera-file, --camera and the options for the image size and a part of it.
void add_view_options(CLI::App& command, ViewRequest& request);

/// Adds --camera-file and --camera.
void add_camera_options(CLI::App& command, ViewRequest& request);

/// Adds --width and --height.
void add_size_options(CLI::App& command, ViewRequest& request);

/// Adds all options of a view and --workload, a file that takes the place of all of them.
void add_view_or_workload_options(CLI::App& command, ViewRequest& request);

/// Adds --resolution.
void add_resolution_option(CLI::App& command, std::string& resolution);

/// Adds the configuration file, an argument.
CLI::Option* add_config_option(CLI::App& command, std::string& config);

/// Adds the scene, an argument.
void add_scene_argument(CLI::App& command, std::string& scene);

/// Adds --camera-file.
CLI::Option* add_camera_file_option(CLI::App& command, std::string& file);

/// Adds --memory, the file of an LPDDR5 memory, see put_memory().
void add_memory_option(CLI::App& command, std::string& file);

/// Adds --crop, a part of the images.
CLI::Option* add_crop_option(CLI::App& command, std::string& crop);

/// Adds --out, the folder for results.
CLI::Option* add_out_option(CLI::App& command, std::string& folder, const char* meaning);

/// Adds --jobs, of commands that run several simulations.
void add_jobs_option(CLI::App& command, int& jobs);

/// Adds --frames and --path-step.
void add_path_options(CLI::App& command, PathRequest& request);

/// Adds --eyes, the distance of the two views of each frame.
void add_eyes_option(CLI::App& command, GroupRequest& request);

/// Adds --eyes, --units-per-metre and --views, the views of each frame.
void add_group_options(CLI::App& command, GroupRequest& request);

/// Adds --foveation, the levels of each image.
void add_foveation_option(CLI::App& command, GroupRequest& request);

/// Adds --within and --seed, for commands that may simulate a sample of the tiles.
void add_sampling_options(CLI::App& command, std::optional<std::string>& within,
                          std::uint64_t& seed);

} // namespace degs::sim
