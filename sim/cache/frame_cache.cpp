// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/frame_cache.hpp"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "degs/error.hpp"
#include "sim/cache/binary.hpp"
#include "sim/cache/digest.hpp"
#include "sim/cache/entry_checks.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/frame_checks.hpp"
#include "sim/view/frame_kind.hpp"
#include "sim/view/reference.hpp"

namespace degs::sim {
namespace {

constexpr std::uint64_t kUsualBytes = std::uint64_t{4} << 30;

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// The folder of this user's cache; empty if there is none.
std::string users_folder() {
    if (std::getenv("DEGS_CACHE") != nullptr) {
        return variable("DEGS_CACHE");
    }
    const std::filesystem::path base = variable("XDG_CACHE_HOME");
    const std::filesystem::path home = variable("HOME");
    return base.is_absolute()   ? (base / "degs").string()
           : home.is_absolute() ? (home / ".cache" / "degs").string()
                                : "";
}

std::uint64_t most_bytes() {
    const std::string text = variable("DEGS_CACHE_BYTES");
    if (text.empty()) {
        return kUsualBytes;
    }
    std::uint64_t bytes = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, bytes);
    if (error != std::errc() || rest != end) {
        throw InputError("The environment variable DEGS_CACHE_BYTES is '" + text +
                         "', but must be a number of bytes.");
    }
    return bytes;
}

// The members of each kind of value, for writing and for reading: `Value` is const for a writer.
template <class Stream, class Value>
void pass_camera(Stream& stream, Value& camera) {
    stream.pass(camera.id, camera.name, camera.width, camera.height, camera.fx, camera.fy,
                camera.shift, camera.origin, camera.hole, camera.position, camera.camera_to_world,
                camera.lens);
}

template <class Stream, class Value>
void pass_facts(Stream& stream, Value& facts) {
    stream.pass(facts.gaussians, facts.sh_degree, facts.dropped);
}

/// Lists of numbers of 8 bytes come before those of 4, so that all of them lie at their multiples.
template <class Stream, class Value>
void pass_frame(Stream& stream, Value& frame) {
    stream.pass(frame.tiles_x, frame.tiles_y, frame.gaussians, frame.culled, frame.tile_begin,
                frame.splats, frame.visible_of, frame.visible_means, frame.tile_splats,
                frame.tiles_touched, frame.sh_degree);
}

template <class Stream, class Value>
void pass_reference(Stream& stream, Value& reference) {
    auto& image = reference.image;
    stream.pass(image.width, image.height, image.rgb, image.transmittance, image.fragments,
                reference.counts, reference.render_s);
}

/// Everything that a projection depends on beside the scene.
void put_view(BinaryWriter& out, const Camera& camera, const ProjectionOptions& options,
              const std::string& format) {
    pass_camera(out, camera);
    out.pass(options.near_plane, options.dilation, options.jacobian_clamp, options.alpha_min,
             options.cut, options.order, options.compensated, options.rule, options.lens,
             options.sigma, format);
}

std::string frame_key(const std::string& scene, const Camera& camera, int tile_size, TileMode mode,
                      const ProjectionOptions& options) {
    BinaryWriter out;
    out.put(std::string("frame"));
    out.put(scene);
    put_view(out, camera, options, options.numbers.name());
    out.put(tile_size);
    out.put(mode);
    return out.bytes;
}

std::string reference_key(const std::string& scene, const FrameWorkload& frame) {
    BinaryWriter out;
    out.put(std::string("reference"));
    out.put(scene);
    put_view(out, frame.camera, frame.projection, ProjectionNumbers().name());
    const auto [size, mode] = image_tiles(frame);
    out.put(mode);
    out.put(size);
    return out.bytes;
}

} // namespace

FrameCache FrameCache::of_user() {
    const std::string folder = users_folder();
    const std::uint64_t bytes = most_bytes();
    if (folder.empty() || bytes == 0) {
        return {};
    }
    const std::string why = DiskCache::distrust(folder);
    if (!why.empty()) {
        print_warnings({"The cache '" + folder + "' is not used: " + why + "."});
        return {};
    }
    return FrameCache(DiskCache(folder, bytes));
}

FrameCache::FrameCache(DiskCache disk) : disk_(std::move(disk)) {}

std::string FrameCache::scene_key(const std::string& spec, const std::string& camera_file) const {
    if (!on()) {
        return "";
    }
    Digest program; // only here, because a run of a workload file has no scene and no use for it
    program.add_file("/proc/self/exe");
    Digest digest;
    digest.add(program.text());
    digest.add_scene(spec);
    digest.add_cameras(camera_file);
    return digest.text();
}

std::optional<SceneCard> FrameCache::scene(const std::string& scene_key) const {
    SceneCard card;
    const auto read = [&card](const char* content, std::size_t bytes) {
        BinaryReader in(content, bytes);
        std::uint64_t notes = 0, cameras = 0;
        pass_facts(in, card.facts);
        std::uint8_t antialiased = 0; // not every byte is a bool
        in.get(antialiased);
        card.facts.traits.antialiased = antialiased == 1;
        in.get(notes);
        for (; notes > 0 && in.good(); --notes) {
            in.get(card.facts.notes.emplace_back());
        }
        in.get(cameras);
        for (; cameras > 0 && in.good(); --cameras) {
            pass_camera(in, card.cameras.emplace_back());
        }
        return in.complete() && antialiased <= 1 && is_sound(card);
    };
    return on() && disk_->find("scene " + scene_key, read) ? std::optional(std::move(card))
                                                           : std::nullopt;
}

void FrameCache::keep(const std::string& scene_key, const SceneCard& card) const {
    if (!on()) {
        return;
    }
    BinaryWriter out;
    pass_facts(out, card.facts);
    out.put(std::uint8_t{card.facts.traits.antialiased ? std::uint8_t{1} : std::uint8_t{0}});
    out.put(std::uint64_t{card.facts.notes.size()});
    for (const std::string& note : card.facts.notes) {
        out.put(note);
    }
    out.put(std::uint64_t{card.cameras.size()});
    for (const Camera& camera : card.cameras) {
        pass_camera(out, camera);
    }
    disk_->put("scene " + scene_key, out.bytes);
}

std::optional<FrameWorkload> FrameCache::frame(const std::string& scene_key, const Camera& camera,
                                               int tile_size, TileMode mode,
                                               const ProjectionOptions& options) const {
    FrameWorkload frame;
    frame.camera = camera;
    frame.projection = options;
    frame.tile_size = tile_size;
    frame.tile_mode = mode;
    const auto read = [&frame](const char* content, std::size_t bytes) {
        BinaryReader in(content, bytes);
        pass_frame(in, frame);
        return in.complete() && is_sound(frame);
    };
    const bool found =
        on() && disk_->find(frame_key(scene_key, camera, tile_size, mode, options), read);
    return found ? std::optional(std::move(frame)) : std::nullopt;
}

void FrameCache::keep(const std::string& scene_key, const FrameWorkload& frame) const {
    if (!on()) {
        return;
    }
    BinaryWriter out;
    out.bytes.reserve(frame.splats.size() * (sizeof(ProjectedSplat) + 3 * sizeof(float) + 8) +
                      frame.tile_begin.size() * sizeof(std::uint64_t) +
                      frame.tile_splats.size() * sizeof(std::uint32_t) + 1024);
    pass_frame(out, frame);
    disk_->put(
        frame_key(scene_key, frame.camera, frame.tile_size, frame.tile_mode, frame.projection),
        out.bytes);
}

std::optional<Reference> FrameCache::reference(const std::string& scene_key,
                                               const FrameWorkload& frame) const {
    Reference reference;
    const auto read = [&reference, &frame](const char* content, std::size_t bytes) {
        BinaryReader in(content, bytes);
        pass_reference(in, reference);
        return in.complete() && is_sound(reference, frame);
    };
    return on() && disk_->find(reference_key(scene_key, frame), read)
               ? std::optional(std::move(reference))
               : std::nullopt;
}

void FrameCache::keep(const std::string& scene_key, const FrameWorkload& frame,
                      const Reference& reference) const {
    if (!on()) {
        return;
    }
    BinaryWriter out;
    pass_reference(out, reference);
    disk_->put(reference_key(scene_key, frame), out.bytes);
}

} // namespace degs::sim
