// SPDX-License-Identifier: Apache-2.0
// Entries of the cache with a content of one's own under a right head and checksum, through which
// no mutation finds its way.
#pragma once

#include <array>
#include <cstring>
#include <sstream>

#include <xxhash.h>

#include "scene/synthetic/synthetic.hpp"
#include "sim/cache/entry_checks.hpp"
#include "sim/cache/frame_cache.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace degs::fuzz {

enum class Entry { Scene, Frame, Reference };

/// An entry of each kind in a folder of its own, of one small view.
class KeptEntries {
public:
    KeptEntries() {
        const SyntheticScene scene = make_synthetic({"object", 12, 1});
        frame_ = make_frame_workload(scene.cloud, scene.cameras[0].scaled_to_width(24), 16,
                                     TileMode::Exact);
        reference_.image = render_reference(frame_, reference_.counts);
        card_.facts.gaussians = scene.cloud.size();
        card_.facts.notes = {"a note"};
        card_.cameras = scene.cameras;
        for (const Entry kind : {Entry::Scene, Entry::Frame, Entry::Reference}) {
            keep(kind);
            const std::string file = only_file(kind);
            std::ostringstream bytes;
            bytes << std::ifstream(file, std::ios::binary).rdbuf();
            files_.at(at(kind)) = file;
            whole_.at(at(kind)) = bytes.str();
        }
    }

    /// The bytes of an entry as the cache wrote them.
    const std::string& whole(Entry kind) const { return whole_.at(at(kind)); }
    std::string content(Entry kind) const {
        return whole(kind).substr(whole(kind).size() - content_bytes(kind));
    }

    /// Whether the cache takes the bytes for the entry. What it takes must be sound, and can be
    /// drawn.
    bool takes_file(Entry kind, const std::string& bytes) const {
        const std::string& file = files_.at(at(kind));
        std::filesystem::remove(file);
        std::ofstream(file, std::ios::binary) << bytes;
        std::filesystem::permissions(file, std::filesystem::perms::owner_read |
                                               std::filesystem::perms::owner_write);
        const bool taken = kind == Entry::Scene   ? takes_card()
                           : kind == Entry::Frame ? takes_frame()
                                                  : takes_reference();
        // A file without bytes has not been read, and the next entry takes its place.
        if (!bytes.empty() && taken != std::filesystem::exists(file)) {
            fail("an entry that was refused is still there, or one that was taken is gone");
        }
        return taken;
    }
    /// Whether the checksum in the head of a file is that of all behind it.
    static bool has_checksum(const std::string& file) {
        std::uint64_t checksum = 0;
        if (file.size() < kHead) {
            return false;
        }
        std::memcpy(&checksum, &file[kChecksum], sizeof checksum);
        return checksum == XXH3_64bits(file.data() + kHead, file.size() - kHead);
    }
    bool takes_content(Entry kind, const std::string& content) const {
        std::string bytes =
            whole(kind).substr(0, whole(kind).size() - content_bytes(kind)) + content;
        const std::uint64_t size = content.size();
        std::memcpy(&bytes[kContentBytes], &size, sizeof size);
        const std::uint64_t checksum = XXH3_64bits(bytes.data() + kHead, bytes.size() - kHead);
        std::memcpy(&bytes[kChecksum], &checksum, sizeof checksum);
        return takes_file(kind, bytes);
    }

private:
    static constexpr std::size_t kHead = 32, kContentBytes = 16, kChecksum = 24; ///< bytes, places
    static std::size_t at(Entry kind) { return static_cast<std::size_t>(kind); }
    static std::string folder_of(Entry kind) { return folder() / std::to_string(at(kind)); }
    static std::string only_file(Entry kind) {
        return std::filesystem::directory_iterator(folder_of(kind))->path().string();
    }
    std::size_t content_bytes(Entry kind) const {
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, &whole(kind)[kContentBytes], sizeof bytes);
        return bytes;
    }
    const sim::FrameCache& cache(Entry kind) const { return caches_.at(at(kind)); }

    void keep(Entry kind) const {
        if (kind == Entry::Scene) {
            cache(kind).keep("scene", card_);
        } else if (kind == Entry::Frame) {
            cache(kind).keep("scene", frame_);
        } else {
            cache(kind).keep("scene", frame_, reference_);
        }
    }
    bool takes_card() const {
        const auto card = cache(Entry::Scene).scene("scene");
        if (card && !sim::is_sound(*card)) {
            fail("a scene that is not sound was taken");
        }
        return card.has_value();
    }
    bool takes_frame() const {
        const auto frame = cache(Entry::Frame)
                               .frame("scene", frame_.camera, frame_.tile_size, frame_.tile_mode,
                                      frame_.projection);
        if (frame) {
            if (!sim::is_sound(*frame)) {
                fail("a frame that is not sound was taken");
            }
            ReferenceCounts counts;
            render_reference(*frame, counts);
        }
        return frame.has_value();
    }
    bool takes_reference() const {
        const auto reference = cache(Entry::Reference).reference("scene", frame_);
        if (reference && !sim::is_sound(*reference, frame_)) {
            fail("a reference that is not sound was taken");
        }
        return reference.has_value();
    }

    static sim::FrameCache cache_in(Entry kind) {
        constexpr std::uint64_t kBytes = 1U << 24;
        return sim::FrameCache(sim::DiskCache(folder_of(kind), kBytes));
    }
    FrameWorkload frame_;
    sim::Reference reference_;
    sim::SceneCard card_;
    std::array<sim::FrameCache, 3> caches_{cache_in(Entry::Scene), cache_in(Entry::Frame),
                                           cache_in(Entry::Reference)};
    std::array<std::string, 3> files_, whole_;
};

} // namespace degs::fuzz
