// SPDX-License-Identifier: Apache-2.0
// Whole images of number sets against the double-precision reference.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <regex.h>

#include "accuracy/data_path_renderer.hpp"
#include "accuracy/flip/flip.hpp"
#include "accuracy/image_difference.hpp"
#include "accuracy/pixel_replay.hpp"
#include "scene/files/image_io.hpp"
#include "sim/accuracy/accuracy.hpp"
#include "sim/accuracy/accuracy_numbers.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"

namespace degs::sim {
namespace {

/// One image of the reference, and what all rows about it share.
struct Frame {
    AccuracyRow row; ///< scene, camera, resolution
    const GaussianCloud* cloud = nullptr;
    FrameWorkload workload; ///< in double
    Image reference;
    FrameWorkload projected; ///< in the formats of the last set that has its own

    /// The frame as the hardware of a set sees it.
    const FrameWorkload& in(const NumberSet& set) {
        if (set.projection_numbers().is_reference()) {
            return workload;
        }
        if (projected.projection.numbers != set.projection_numbers()) {
            projected =
                make_frame_workload(*cloud, workload.camera, workload.tile_size, TileMode::Exact,
                                    projected_in(set, workload.projection));
        }
        return projected;
    }
};

/// Letters, digits and '-' of a name, for files.
std::string file_word(std::string name) {
    constexpr std::size_t kLongest = 100; // the number in front tells rows apart
    name.resize(std::min(name.size(), kLongest));
    for (char& c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        c = letter || (c >= '0' && c <= '9') ? c : '-';
    }
    return name;
}

/// Whether measure_frame() may have written a file of that name: error-2-SCENE-640x480-SET.exr. The
/// expression is one of POSIX, because those of C++ are templates that take seconds to compile.
bool is_error_image(const std::string& name) {
    regex_t form;
    if (::regcomp(&form, "^error-[0-9]+-.*-[0-9]+x[0-9]+-.*\\.exr$", REG_EXTENDED | REG_NOSUB) !=
        0) {
        return false;
    }
    const bool matches = ::regexec(&form, name.c_str(), 0, nullptr, 0) == 0;
    ::regfree(&form);
    return matches;
}

WorstPixel explain(Frame& frame, const ImageDifference& difference, const NumberSet& set,
                   bool replayed) {
    WorstPixel worst;
    worst.x = difference.worst_x();
    worst.y = difference.worst_y();
    if (!replayed) {
        worst.error = difference.max_abs_error();
        return worst;
    }
    const FrameWorkload& own = frame.in(set);
    const glm::ivec2 pixel = own.camera.origin + glm::ivec2(worst.x, worst.y);
    const PixelBlame blame =
        &own == &frame.workload
            ? blame_pixel(own, pixel.x, pixel.y, set, StopRule::Refuse)
            : blame_pixel(frame.workload, own, pixel.x, pixel.y, set, StopRule::Refuse);
    worst.error = blame.error;
    worst.gaussian = blame.id;
    worst.operation = blame.operation;
    worst.explained = blame.explained;
    worst.flip = blame.flip;
    return worst;
}

AccuracyRow compare(Frame& frame, const Image& image, const NumberSet& set, bool replayed) {
    ImageDifference difference;
    difference.add(frame.reference, image);
    AccuracyRow row = frame.row;
    row.numbers = set.name;
    row.span_ends = words_of(set.ends);
    row.alpha_error_mean = difference.alpha_error_mean();
    row.alpha_error_max = difference.alpha_error_max();
    row.max_abs_error = difference.max_abs_error();
    row.nonfinite = difference.nonfinite();
    row.recounted = difference.recounted();
    row.identical = difference.identical();
    row.ssim = compare_images(frame.reference, image).ssim;
    row.flip = flip_difference(frame.reference, image);
    if (!row.identical && !std::isnan(difference.psnr_db())) {
        row.psnr_db = difference.psnr_db();
    }
    if (!row.identical) {
        row.worst = explain(frame, difference, set, replayed);
    }
    return row;
}

Image render(Frame& frame, const AccuracyNumbers& numbers, const std::string& name) {
    const FrameWorkload& own = frame.in(numbers.set);
    print_warnings(saturation_warnings(numbers.path, own));
    Progress progress(name + " at " + frame.row.resolution + " in " + numbers.set.name);
    DataPathRender options;
    options.numbers = numbers.path;
    options.progress = [&progress](double share) { progress.done(share); };
    return DataPathRenderer(own, options).render(all_tiles(own));
}

void measure_frame(const SceneAccuracyRequest& request, Frame& frame, const OutputFolder& out,
                   std::vector<AccuracyRow>& rows) {
    for (const std::string& name : request.sets) {
        AccuracyNumbers numbers = numbers_of(name, request.span_ends);
        numbers.path.gemm = request.gemm;
        Image image = render(frame, numbers, frame.row.scene);
        AccuracyRow row = compare(frame, image, numbers.set, !request.gemm);
        if (request.error_images) {
            row.error_image = "error-" + std::to_string(rows.size()) + "-" + file_word(row.scene) +
                              "-" + row.resolution + "-" + file_word(row.numbers) + ".exr";
            subtract(frame.reference, image);
            write_exr(image, out.path(row.error_image));
        }
        rows.push_back(std::move(row));
    }
}

/// The scene of a view, whose cameras get their sizes later.
Scene loaded_scene(const ViewRequest& view) {
    check_view(view);
    const Progress progress("loading " + view.scene);
    return load_scene(view.scene, view.camera_file);
}

std::vector<ViewRequest> in_all_sizes(const ViewRequest& view,
                                      const std::vector<std::string>& resolutions) {
    std::vector<ViewRequest> views(std::max<std::size_t>(resolutions.size(), 1), view);
    for (std::size_t i = 0; i < resolutions.size(); ++i) {
        views[i].resolution = resolutions[i];
    }
    return views;
}

Frame frame_of(const SceneAccuracyRequest& request, const Scene& scene, const Camera& camera) {
    Frame frame;
    frame.row.resolution = std::to_string(camera.width) + "x" + std::to_string(camera.height);
    frame.cloud = &scene.cloud;
    frame.workload = make_frame_workload(scene.cloud, camera, request.tile_size, TileMode::Exact,
                                         request.rules.options(scene.traits.antialiased));
    print_warnings(near_plane_warnings(frame.workload));
    frame.reference = make_reference(frame.workload).image;
    return frame;
}

} // namespace

std::vector<AccuracyRow> measure_scenes(const SceneAccuracyRequest& request,
                                        const OutputFolder& out) {
    std::vector<AccuracyRow> rows;
    const std::vector<std::string> labels = scene_labels(request.scenes);
    for (std::size_t s = 0; s < labels.size(); ++s) {
        const Scene scene = loaded_scene(request.scenes[s]);
        print_warnings(scene.notes);
        for (const ViewRequest& view : in_all_sizes(request.scenes[s], request.resolutions)) {
            const std::vector<Camera> cameras = cameras_of_frame(view, request.group, scene);
            for (std::size_t number = 0; number < cameras.size(); ++number) {
                Frame frame = frame_of(request, scene, cameras[number]);
                frame.row.scene = labels[s];
                name_view(view, request.group, number, frame.row);
                measure_frame(request, frame, out, rows);
            }
        }
    }
    return rows;
}

std::vector<std::string> old_error_images(const OutputFolder& out) {
    std::vector<std::string> paths;
    std::error_code error;
    if (!std::filesystem::exists(out.path("accuracy.json"), error)) {
        return paths;
    }
    for (std::filesystem::directory_iterator at(out.path(""), error), end; !error && at != end;
         at.increment(error)) {
        if (is_error_image(at->path().filename().string())) {
            paths.push_back(at->path().string());
        }
    }
    return paths;
}

} // namespace degs::sim
