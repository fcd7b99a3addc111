// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/workload_head.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_checks.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"
#include "sim/workload_file/head_reader.hpp"
#include "sim/workload_file/list_block.hpp"
#include "sim/workload_file/splat_block.hpp"
#include "splat/frame/rendering_rules.hpp"
#include "splat/frame/tile_cover.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kMostCount = std::uint64_t{1} << 40; // as of a scene's file
constexpr std::uint64_t kMostGaussians = std::numeric_limits<std::uint32_t>::max();
constexpr int kMostTile = 1 << 16; // px, as of make_frame_workload()
constexpr double kMostValue = 1e300;

/// The formats of a projection with their names in the head.
template <class Numbers, class Pass>
void pass_formats(Numbers& numbers, Pass&& pass) {
    pass("format", numbers.format);
    pass("mean", numbers.mean);
    pass("scale", numbers.scale);
    pass("rotation", numbers.rotation);
    pass("opacity", numbers.opacity);
    pass("sh_dc", numbers.sh_dc);
    pass("sh_rest", numbers.sh_rest);
    pass("depth_key", numbers.depth_key);
}

template <class Counts, class Pass>
void pass_culled(Counts& culled, Pass&& pass) {
    pass("near", culled.near);
    pass("near_in_view", culled.near_in_view);
    pass("transparent", culled.transparent);
    pass("degenerate", culled.degenerate);
    pass("off_screen", culled.off_screen);
}

template <class Report, class Pass>
void pass_dropped(Report& dropped, Pass&& pass) {
    pass("non_finite", dropped.non_finite);
    pass("zero_rotation", dropped.zero_rotation);
    pass("bad_scale", dropped.bad_scale);
    pass("bad_opacity", dropped.bad_opacity);
}

template <class Options, class Pass>
void pass_rules(Options& options, Pass&& pass) {
    pass("near_plane", options.near_plane);
    pass("dilation", options.dilation);
    pass("jacobian_clamp", options.jacobian_clamp);
    pass("alpha_min", options.alpha_min);
    pass("cut", options.cut);
}

template <class Sigma, class Pass>
void pass_sigma(Sigma& sigma, Pass&& pass) {
    pass("alpha", sigma.alpha);
    pass("beta", sigma.beta);
    pass("kappa", sigma.kappa);
}

/// Names of the kinds of lenses in the head.
const std::vector<const char*>& lens_words() {
    static const std::vector<const char*> words{"pinhole", "opencv", "fisheye"};
    return words;
}

/// The coefficients of a lens with their names in the head.
template <class Coefficients, class Pass>
void pass_lens(Coefficients& lens, Pass&& pass) {
    const char* const radial[] = {"radial1", "radial2", "radial3", "radial4"};
    for (std::size_t i = 0; i < lens.radial.size(); ++i) {
        pass(radial[i], lens.radial[i]);
    }
    const char* const denominator[] = {"denominator1", "denominator2", "denominator3"};
    for (std::size_t i = 0; i < lens.denominator.size(); ++i) {
        pass(denominator[i], lens.denominator[i]);
    }
    pass("p1", lens.tangential[0]);
    pass("p2", lens.tangential[1]);
}

ordered_json json_of(const LensCoefficients& lens) {
    ordered_json json{{"kind", lens_words()[static_cast<std::size_t>(lens.kind)]}};
    pass_lens(lens, [&](const char* name, const double& value) { json[name] = value; });
    return json;
}

Lens lens_in(const HeadReader& in) {
    LensCoefficients lens;
    lens.kind = static_cast<LensCoefficients::Kind>(in.text("kind", lens_words()));
    pass_lens(lens, [&](const char* name, double& value) {
        value = in.real(name, -kMostValue, kMostValue);
    });
    return Lens(lens);
}

ordered_json json_of(const SceneFacts& scene) {
    ordered_json json{{"name", scene.name},
                      {"gaussians", scene.gaussians},
                      {"sh_degree", scene.sh_degree},
                      {"antialiased", scene.traits.antialiased}};
    pass_dropped(scene.dropped, [&](const char* name, const std::uint64_t& count) {
        json["dropped"][name] = count;
    });
    json["notes"] = scene.notes;
    return json;
}

ordered_json json_of(const Camera& camera) {
    const glm::dmat3& axes = camera.camera_to_world;
    ordered_json columns = ordered_json::array();
    for (int column = 0; column < 3; ++column) {
        columns.push_back({axes[column].x, axes[column].y, axes[column].z});
    }
    ordered_json json = {{"id", camera.id},
                         {"img_name", camera.name},
                         {"width", camera.width},
                         {"height", camera.height},
                         {"fx", camera.fx},
                         {"fy", camera.fy},
                         {"position", {camera.position.x, camera.position.y, camera.position.z}},
                         {"axes", columns}};
    if (!camera.is_centred()) {
        json["raster"] = {{"x", camera.origin.x},
                          {"y", camera.origin.y},
                          {"shift_x", camera.shift.x},
                          {"shift_y", camera.shift.y}};
    }
    if (!camera.lens.is_pinhole()) {
        json["lens"] = json_of(camera.lens.coefficients());
    }
    return json;
}

ordered_json json_of(const PackedProjection& projection) {
    ordered_json json;
    const ProjectionOptions& options = projection.options;
    pass_rules(options, [&](const char* name, const double& value) { json[name] = value; });
    json["order"] = name_of(options.order);
    json["compensated"] = options.compensated;
    if (options.rule != ProjectionRule::Linear || options.lens != LensRule::Camera) {
        json["rule"] = name_of(options.rule);
        json["lens"] = name_of(options.lens);
        pass_sigma(options.sigma,
                   [&](const char* name, const double& value) { json["sigma"][name] = value; });
    }
    pass_formats(options.numbers, [&](const char* name, const NumberFormat& format) {
        json["formats"][name] = format.name();
    });
    json["splats"] = projection.splats;
    json["blocks"] = projection.blocks;
    json["xxh128"] = projection.xxh128;
    return json;
}

ordered_json json_of(const PackedFrame& frame) {
    ordered_json json{{"projection", frame.projection},
                      {"tile_size", frame.tile_size},
                      {"tile_mode", tile_mode_names()[static_cast<std::size_t>(frame.tile_mode)]},
                      {"entries", frame.entries}};
    pass_culled(frame.culled, [&](const char* name, const std::uint64_t& count) {
        json["culled"][name] = count;
    });
    json["designs"] = frame.designs;
    json["blocks"] = frame.blocks;
    json["xxh128"] = frame.xxh128;
    return json;
}

SceneFacts scene_in(const HeadReader& in) {
    SceneFacts scene;
    scene.name = in.text("name");
    scene.gaussians = in.count("gaussians", 1, kMostGaussians);
    scene.sh_degree = in.number("sh_degree", 0, kMostShDegree);
    scene.traits.antialiased = in.flag("antialiased");
    const HeadReader dropped = in.part("dropped");
    pass_dropped(scene.dropped, [&](const char* name, std::uint64_t& count) {
        count = dropped.count(name, 0, kMostCount);
    });
    scene.notes = in.texts("notes");
    return scene;
}

Camera camera_in(const HeadReader& in) {
    Camera camera;
    camera.id = in.number("id", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
    camera.name = in.text("img_name");
    camera.width = in.number("width", 1, kMostCameraSide);
    camera.height = in.number("height", 1, kMostCameraSide);
    camera.fx = in.real("fx", 0, kMostValue);
    camera.fy = in.real("fy", 0, kMostValue);
    if (in.has("raster")) { // not of images that are their raster
        const HeadReader raster = in.part("raster");
        camera.origin = {raster.number("x", 0, kMostRasterSide),
                         raster.number("y", 0, kMostRasterSide)};
        camera.shift = {raster.real("shift_x", -kMostRasterSide, kMostRasterSide),
                        raster.real("shift_y", -kMostRasterSide, kMostRasterSide)};
    }
    if (in.has("lens")) { // not of pinholes
        camera.lens = lens_in(in.part("lens"));
    }
    camera.position = in.vector("position");
    const std::vector<HeadReader> axes = in.list("axes");
    in.check("axes", axes.size() == 3, "has " + std::to_string(axes.size()) + " of 3 axes");
    for (int column = 0; column < 3; ++column) {
        camera.camera_to_world[column] = axes[column].vector();
    }
    in.check("axes", is_sound(camera),
             "or a focal length or the raster is not that of a camera that projects");
    in.check("width", camera.pixels() <= std::uint64_t{kMostPixels},
             "and the height make more than " + grouped(kMostPixels) + " pixels");
    return camera;
}

/// Lengths of blocks, whose sum is within that of a file.
std::vector<std::uint64_t> blocks_in(const HeadReader& in) {
    constexpr std::uint64_t kMostBlock = std::uint64_t{1} << 36U;
    std::vector<std::uint64_t> blocks;
    for (const HeadReader& block : in.list("blocks")) {
        blocks.push_back(block.count(1, kMostBlock));
    }
    return blocks;
}

void check_inflation(const HeadReader& in, std::uint64_t plain, std::uint64_t packed) {
    in.check("blocks", plain / kMostInflation <= packed,
             "has blocks of " + grouped(packed) + " bytes for what has " + grouped(plain) +
                 " bytes, but a byte may become " + std::to_string(kMostInflation) + " at most");
}

PackedProjection projection_in(const HeadReader& in, const SceneFacts& scene) {
    PackedProjection projection;
    ProjectionOptions& options = projection.options;
    pass_rules(options,
               [&](const char* name, double& value) { value = in.real(name, 0, kMostValue); });
    options.order =
        in.text("order", splat_order_names()) == 0 ? SplatOrder::Depth : SplatOrder::Distance;
    options.compensated = in.flag("compensated");
    if (in.has("rule")) { // not of linear projections through the camera's lens
        options.rule = static_cast<ProjectionRule>(in.text("rule", projection_rule_names()));
        options.lens = static_cast<LensRule>(in.text("lens", lens_rule_names()));
        const HeadReader sigma = in.part("sigma");
        pass_sigma(options.sigma, [&](const char* name, double& value) {
            value = sigma.real(name, -kMostValue, kMostValue);
        });
    }
    const HeadReader formats = in.part("formats");
    pass_formats(options.numbers,
                 [&](const char* name, NumberFormat& format) { format = formats.format(name); });
    projection.splats = in.count("splats", 0, scene.gaussians);
    projection.blocks = blocks_in(in);
    const std::size_t blocks = 2 * blocks_of(projection.splats);
    in.check("blocks", projection.blocks.size() == blocks,
             "has " + std::to_string(projection.blocks.size()) + " of " + std::to_string(blocks) +
                 " blocks");
    // Checked before memory is asked for.
    check_inflation(in, projection.splats * (kBytesPerGaussian + kBytesPerSplat),
                    length_of(projection.blocks));
    projection.xxh128 = in.text("xxh128");
    return projection;
}

PackedFrame frame_in(const HeadReader& in, const WorkloadHead& head) {
    PackedFrame frame;
    in.check("projection", !head.projections.empty(), "is not there");
    frame.projection = in.count("projection", 0, head.projections.size() - 1);
    frame.tile_size = in.number("tile_size", 1, kMostTile);
    frame.tile_mode = static_cast<TileMode>(in.text("tile_mode", tile_mode_names()));
    const std::uint64_t splats = head.projections[frame.projection].splats;
    const HeadReader culled = in.part("culled");
    pass_culled(frame.culled, [&](const char* name, std::uint64_t& count) {
        count = culled.count(name, 0, head.scene.gaussians);
    });
    in.check("culled", frame.culled.near_in_view <= frame.culled.near,
             "has more Gaussians near and in view than near");
    in.check("culled", frame.culled.total() + splats == head.scene.gaussians,
             "and the splats of its projection do not add up to the " +
                 grouped(head.scene.gaussians) + " Gaussians of the scene");
    frame.designs = in.texts("designs");
    frame.entries = in.count("entries", 0, kMostCount);
    frame.blocks = blocks_in(in);
    in.check("blocks", !frame.blocks.empty(), "has no block, but the lengths of lists are needed");
    const TileGrid grid(head.camera, frame.tile_size);
    const auto tiles = std::uint64_t{1} * grid.tiles_x() * grid.tiles_y();
    check_inflation(in, tiles * kBytesPerEntry, frame.blocks.front());
    check_inflation(in, frame.entries * kBytesPerEntry,
                    length_of(frame.blocks) - frame.blocks.front());
    frame.xxh128 = in.text("xxh128");
    return frame;
}

} // namespace

std::uint64_t length_of(const std::vector<std::uint64_t>& blocks) {
    return std::accumulate(blocks.begin(), blocks.end(), std::uint64_t{0});
}

bool same_projection(const ProjectionOptions& a, const ProjectionOptions& b) {
    const auto rules = [](const ProjectionOptions& o) {
        return std::tie(o.near_plane, o.dilation, o.jacobian_clamp, o.alpha_min, o.cut, o.order,
                        o.compensated, o.rule, o.lens);
    };
    const bool same_points = a.rule == ProjectionRule::Linear || a.sigma == b.sigma;
    return rules(a) == rules(b) && same_points && a.numbers == b.numbers;
}

std::string frame_words(const ProjectionOptions& options, int tile_size, TileMode mode) {
    std::string words = std::to_string(tile_size) + " px tiles (" +
                        tile_mode_names()[static_cast<std::size_t>(mode)] + "), " +
                        options.numbers.name();
    const ProjectionOptions usual;
    if (options.order != usual.order || options.compensated || options.dilation != usual.dilation ||
        options.cut != usual.cut || options.near_plane != usual.near_plane) {
        words += std::string(", order ") + name_of(options.order) + ", antialiasing " +
                 (options.compensated ? "on" : "off") + ", low_pass " +
                 decimal_text(options.dilation) + ", cut " + decimal_text(options.cut) + ", near " +
                 decimal_text(options.near_plane);
    }
    if (options.rule != usual.rule || options.lens != usual.lens) {
        words += std::string(", projection ") + name_of(options.rule) + ", lens " +
                 name_of(options.lens);
    }
    return words;
}

std::string head_text(const WorkloadHead& head) {
    ordered_json json;
    json["tool"] = {{"name", "degs"}, {"version", DEGS_VERSION}};
    json["scene"] = json_of(head.scene);
    json["camera"] = json_of(head.camera);
    json["projections"] = ordered_json::array();
    for (const PackedProjection& projection : head.projections) {
        json["projections"].push_back(json_of(projection));
    }
    json["frames"] = ordered_json::array();
    for (const PackedFrame& frame : head.frames) {
        json["frames"].push_back(json_of(frame));
    }
    return dump_json(json);
}

WorkloadHead read_head(const std::string& path, const std::string& text) {
    const nlohmann::json json = parse_json(text);
    if (!json.is_object()) {
        fail_file(path, "its head is damaged; it must be a JSON object.");
    }
    const HeadReader in(path, "", json);
    WorkloadHead head;
    head.scene = scene_in(in.part("scene"));
    head.camera = camera_in(in.part("camera"));
    for (const HeadReader& projection : in.list("projections")) {
        head.projections.push_back(projection_in(projection, head.scene));
    }
    for (const HeadReader& frame : in.list("frames")) {
        head.frames.push_back(frame_in(frame, head));
    }
    return head;
}

} // namespace degs::sim
