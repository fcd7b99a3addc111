// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy/hard_case_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "accuracy/data_path_renderer.hpp"
#include "accuracy/image_difference.hpp"
#include "accuracy/pixel_tolerance.hpp"
#include "accuracy/span_difference.hpp"
#include "base/ratio.hpp"
#include "degs/error.hpp"
#include "sim/accuracy/accuracy_numbers.hpp"
#include "sim/simulation/completed_run.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/words.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/view.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {
namespace {

std::vector<const HardCase*> chosen(const std::vector<std::string>& only) {
    std::vector<const HardCase*> cases;
    for (const HardCase& hard : hard_cases()) {
        if (only.empty() || std::find(only.begin(), only.end(), hard.id) != only.end()) {
            cases.push_back(&hard);
        }
    }
    for (const std::string& id : only) {
        const auto named = [&id](const HardCase* hard) { return hard->id == id; };
        if (std::none_of(cases.begin(), cases.end(), named)) {
            throw InputError("There is no hard case '" + id + "'; there are H1 to H" +
                             std::to_string(hard_cases().size()) + ".");
        }
    }
    return cases;
}

/// A scene's splats as a format projects them, and what they look like in double.
struct Projected {
    FrameWorkload workload;
    std::vector<Image> references;
};

/// A scene ready to be drawn.
struct Prepared {
    HardScene scene;
    std::vector<TileWindow> windows;
    Projected exact;                         ///< in double
    std::map<std::string, Projected> others; ///< by the name of the projection's format
};

void expect(std::vector<std::string>& problems, const char* what, std::uint64_t found,
            std::uint64_t wanted) {
    if (found != wanted) {
        problems.push_back(grouped(found) + " Gaussians are " + what + ", not " + grouped(wanted) +
                           ".");
    }
}

void check_counts(const SanitizeReport& found, const SanitizeReport& wanted,
                  std::vector<std::string>& problems) {
    expect(problems, "dropped as not finite", found.non_finite, wanted.non_finite);
    expect(problems, "dropped for their rotation", found.zero_rotation, wanted.zero_rotation);
    expect(problems, "dropped for their scale", found.bad_scale, wanted.bad_scale);
    expect(problems, "dropped for their opacity", found.bad_opacity, wanted.bad_opacity);
}

void check_counts(const CullCounts& found, const CullCounts& wanted,
                  std::vector<std::string>& problems) {
    expect(problems, "before the near plane", found.near, wanted.near);
    expect(problems, "transparent", found.transparent, wanted.transparent);
    expect(problems, "degenerate", found.degenerate, wanted.degenerate);
    expect(problems, "off the screen", found.off_screen, wanted.off_screen);
}

/// Near to far by the float of their depth; equal ones by index.
void check_order(const FrameWorkload& workload, std::vector<std::string>& problems) {
    const auto before = [](const ProjectedSplat& a, const ProjectedSplat& b) {
        const auto near = static_cast<float>(a.depth);
        const auto far = static_cast<float>(b.depth);
        return near < far || (near == far && a.id < b.id);
    };
    if (!std::is_sorted(workload.splats.begin(), workload.splats.end(), before)) {
        problems.emplace_back("The splats are not in the order of depth and index.");
    }
}

Projected project_in(const Prepared& prepared, const ProjectionOptions& options, int tile_size) {
    Projected out;
    out.workload = make_frame_workload(prepared.scene.cloud, prepared.scene.camera, tile_size,
                                       TileMode::Exact, options);
    for (const TileWindow& window : prepared.windows) {
        ReferenceCounts counts;
        out.references.push_back(render_reference(out.workload, counts, window));
    }
    return out;
}

/// The scene as the hardware of a set sees it.
const Projected& projected_for(const NumberSet& set, Prepared& prepared) {
    if (set.projection_numbers().is_reference()) {
        return prepared.exact;
    }
    const auto [at, added] = prepared.others.try_emplace(set.projection_numbers().name());
    if (added) {
        at->second = project_in(prepared, projected_in(set, prepared.scene.projection),
                                prepared.exact.workload.tile_size);
    }
    return at->second;
}

Prepared prepare(const HardCase& hard, HardScene scene, int tile_size,
                 std::vector<std::string>& problems) {
    Prepared out;
    check_counts(sanitize(scene.cloud), scene.dropped, problems);
    out.scene = std::move(scene);
    out.exact = project_in(out, out.scene.projection, tile_size);
    const FrameWorkload& workload = out.exact.workload;
    check_counts(workload.culled, out.scene.culled, problems);
    check_order(workload, problems);
    const std::string problem = hard.check ? hard.check(out.scene, workload) : "";
    if (!problem.empty()) {
        problems.push_back(problem);
    }
    for (const PixelBox& box : out.scene.windows) {
        ReferenceCounts counts;
        out.windows.push_back(tiles_around(workload, box));
        out.exact.references.push_back(render_reference(workload, counts, out.windows.back()));
    }
    return out;
}

/// Judges the windows of one set against its own splats, drawn in double. The bound is that of the
/// formats behind the projection.
class Judge {
public:
    Judge(const Prepared& prepared, const Projected& projected, const NumberSet& set)
        : prepared_(prepared), projected_(projected),
          bounded_(set.derivation == Derivation::Reference),
          tolerance_(tolerance_of(set, projected.workload)) {}

    void add(std::size_t window, const Image& image);
    double alpha_bound() const { return tolerance_.alpha; }
    std::uint64_t beyond() const { return beyond_; }
    bool drained() const { return drained_; }

private:
    static double error_of(const Image& reference, const Image& image, std::size_t pixel) {
        double error = 0;
        for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
            error = std::max(error, std::abs(double{reference.rgb[c]} - image.rgb[c]));
        }
        return error;
    }

    const Prepared& prepared_;
    const Projected& projected_;
    bool bounded_;
    NumberTolerance tolerance_;
    std::uint64_t beyond_ = 0;
    bool drained_ = false; ///< a transmittance has left 10^-4 .. 1
};

void Judge::add(std::size_t window, const Image& image) {
    const Image& reference = projected_.references[window];
    const PixelBox box = pixels_of(projected_.workload, prepared_.windows[window]);
    // No splat can be blamed for errors up to this one: images hold floats, and faint errors need
    // no closer look.
    const double harmless = std::min(tolerance_.alpha, 1.0 / 255);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const double left = image.transmittance[i];
        drained_ = drained_ || !(left >= 0.9999e-4 && left <= 1);
        const double error = error_of(reference, image, i);
        if (!bounded_ || error <= harmless) {
            continue;
        }
        const int x = box.x0 + static_cast<int>(i) % image.width;
        const int y = box.y0 + static_cast<int>(i) / image.width;
        const double level = std::abs(double{reference.rgb[3 * i]}) + 1;
        if (!(error <= pixel_tolerance(projected_.workload, x, y, tolerance_) + 1e-6 * level)) {
            ++beyond_;
        }
    }
}

void find_problems(const HardScene& scene, const NumberSet& set, const Judge& judge,
                   HardMeasure& measure) {
    std::vector<std::string>& problems = measure.problems;
    if (measure.nonfinite > 0) {
        problems.push_back(grouped(measure.nonfinite) + " values are no finite number.");
    }
    if (judge.drained()) {
        problems.emplace_back("A transmittance leaves 10^-4 to 1.");
    }
    if (judge.beyond() > 0) {
        problems.push_back(grouped(judge.beyond()) +
                           " pixels are further from the reference than the formats explain.");
    }
    const bool exact = set.name == "ideal" || set.name == "fp64" || set.name == "fp32";
    if (scene.same_counts && exact && set.ends == SpanEnds::Exact && measure.recounted > 0) {
        problems.push_back(grouped(measure.recounted) +
                           " pixels have another number of updates than in the reference.");
    }
}

HardMeasure measure(std::vector<Prepared>& scenes, const AccuracyNumbers& numbers,
                    const std::string& resolution) {
    const NumberSet& set = numbers.set;
    HardMeasure out;
    out.set = set.name;
    out.resolution = resolution;
    out.bounded = set.derivation == Derivation::Reference;
    ImageDifference difference;
    for (Prepared& prepared : scenes) {
        const Projected& projected = projected_for(set, prepared);
        DataPathRender options;
        options.numbers = numbers.path;
        DataPathRenderer renderer(projected.workload, options);
        Judge judge(prepared, projected, set);
        check_order(projected.workload, out.problems);
        for (std::size_t w = 0; w < prepared.windows.size(); ++w) {
            const Image image = renderer.render(prepared.windows[w]);
            judge.add(w, image);
            difference.add(prepared.exact.references[w], image);
        }
        out.nonfinite = difference.nonfinite();
        out.recounted = difference.recounted();
        out.beyond += judge.beyond();
        out.alpha_bound = std::max(out.alpha_bound, judge.alpha_bound());
        find_problems(prepared.scene, set, judge, out);
    }
    out.pixels = difference.pixels();
    out.psnr_db = difference.psnr_db();
    out.alpha_error_max = difference.alpha_error_max();
    out.max_abs_error = difference.max_abs_error();
    return out;
}

// A float knows the centre of a row to 2^-24 of its distance, and each end moves by that.
void compare_spans(const std::vector<Prepared>& scenes, const std::string& resolution,
                   HardResult& result) {
    constexpr double kMostOff = 0.05; // of alpha, at the threshold
    for (const Prepared& prepared : scenes) {
        const SpanDifference spans = degs::compare_spans(
            prepared.exact.workload, named_numbers("fp32"), named_numbers("ideal"));
        result.notes.push_back(resolution + ": " + grouped(spans.flips) + " of " +
                               grouped(spans.pixels) + " pixels in " + grouped(spans.spans) +
                               " spans flip in fp32, alpha within " + percent(spans.farthest, 2) +
                               " % of 1/255");
        if (!spans.inside) {
            result.problems.push_back("A span leaves the image at " + resolution + ".");
        }
        if (spans.farthest > kMostOff) {
            result.problems.push_back("A span of fp32 at " + resolution +
                                      " ends where alpha is not 1/255.");
        }
    }
}

void run_case(const HardCaseRequest& request, const std::string& resolution, HardResult& result) {
    const HardCase& hard = *result.hard;
    const ImageSize size = image_size(resolution);
    const int width = size.width.value_or((*size.height * 16 + 8) / 9);
    std::vector<Prepared> scenes;
    std::vector<std::string> problems;
    for (HardScene& scene : hard.make(width, *size.height)) {
        scenes.push_back(prepare(hard, std::move(scene), request.tile_size, problems));
    }
    for (const std::string& problem : problems) {
        std::string sentence = "At ";
        sentence.append(resolution).append(": ").append(problem);
        result.problems.push_back(std::move(sentence));
    }
    if (hard.spans) {
        compare_spans(scenes, resolution, result);
    }
    for (const std::string& name : request.sets) {
        result.measures.push_back(measure(scenes, numbers_of(name, request.span_ends), resolution));
    }
}

} // namespace

std::vector<std::string> HardResult::failures() const {
    std::vector<std::string> sentences;
    for (const std::string& problem : problems) {
        sentences.push_back(hard->id + ": " + problem);
    }
    for (const HardMeasure& each : measures) {
        for (const std::string& problem : each.problems) {
            sentences.push_back(hard->id + ", " + each.set + " at " + each.resolution + ": " +
                                problem);
        }
    }
    return sentences;
}

std::vector<HardResult> run_hard_cases(const HardCaseRequest& request, const std::string& folder) {
    const std::vector<const HardCase*> cases = chosen(request.only);
    Progress progress("hard cases");
    std::vector<HardResult> results;
    for (const HardCase* hard : cases) {
        HardResult result;
        result.hard = hard;
        if (hard->refuse != nullptr) {
            const std::string problem = hard->refuse(folder);
            if (!problem.empty()) {
                result.problems.push_back(problem);
            }
        }
        for (const std::string& resolution : request.resolutions) {
            if (hard->make != nullptr) {
                run_case(request, resolution, result);
            }
        }
        results.push_back(std::move(result));
        progress.done(ratio_of(results.size(), cases.size()));
    }
    return results;
}

} // namespace degs::sim
