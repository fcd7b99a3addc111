// SPDX-License-Identifier: Apache-2.0
// The form of workload files: what is packed comes back, and nothing else is taken.
#include "sim/workload_file/workload_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/sanitizers.hpp"
#include "degs/error.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/view/frame_checks.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"
#include "sim/workload_file/file_layout.hpp"
#include "sim/workload_file/list_block.hpp"
#include "sim/workload_file/splat_block.hpp"
#include "sim/workload_file/workload_head.hpp"

namespace degs::sim_test {
namespace {

using sim::WorkloadFile;
using ::testing::HasSubstr;

const char* const kName = "a.degsw";

struct Packed {
    FrameWorkload frame;
    std::string bytes;
};

Packed packed(int gaussians, int tile_size = 16) {
    const SyntheticScene scene = make_synthetic({"object", static_cast<std::size_t>(gaussians), 1});
    Packed result;
    result.frame = make_frame_workload(scene.cloud, scene.cameras[0].scaled_to_width(24), tile_size,
                                       TileMode::Exact);
    sim::SceneFacts facts;
    facts.name = "object";
    facts.gaussians = scene.cloud.size();
    result.bytes = sim::pack_workload(facts, {{result.frame, {"a design"}}});
    return result;
}

/// The file with another head and the checksum of it.
std::string with_whole_head(const std::string& bytes, const std::string& head) {
    const std::uint32_t size = sim::little_endian_at(bytes, sim::kHeadBytesAt);
    const std::string beginning = bytes.substr(0, sim::kHeadBytesAt) +
                                  sim::little_endian(static_cast<std::uint32_t>(head.size())) +
                                  head;
    const std::size_t behind = sim::kHeadAt + size;
    return beginning + bytes.substr(behind, bytes.size() - sim::kChecksumBytes - behind) +
           sim::checksum_bytes(beginning);
}

/// The bytes with the checksums that they must have, as far as the head can be read.
std::string signed_again(const std::string& bytes) {
    const std::uint32_t size = sim::little_endian_at(bytes, sim::kHeadBytesAt);
    if (size > bytes.size() - sim::kHeadAt - sim::kChecksumBytes) {
        return bytes;
    }
    nlohmann::ordered_json head =
        nlohmann::ordered_json::parse(bytes.substr(sim::kHeadAt, size), nullptr, false);
    std::size_t at = sim::kHeadAt + size;
    try {
        for (const char* parts : {"projections", "frames"}) {
            for (auto& part : head.at(parts)) {
                std::uint64_t length = 0;
                for (const std::uint64_t block : part.at("blocks")) {
                    length += block;
                }
                part["xxh128"] = sim::in_digits(sim::checksum_bytes(bytes.substr(at, length)));
                at += length;
            }
        }
    } catch (const std::exception&) { // a head that is no longer one
        return with_whole_head(bytes, bytes.substr(sim::kHeadAt, size));
    }
    return with_whole_head(
        bytes, head.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// A file of which a part of the head has been exchanged.
std::string with_head(const std::string& bytes, const std::string& old, const std::string& now) {
    std::string head = bytes.substr(sim::kHeadAt, sim::little_endian_at(bytes, sim::kHeadBytesAt));
    const std::size_t at = head.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    head.replace(at, old.size(), now);
    return with_whole_head(bytes, head);
}

/// What the reader says of the bytes; empty if it makes a frame of them, which then is sound.
std::string refusal(const std::string& bytes, const FrameWorkload& like) {
    try {
        const WorkloadFile file(kName, bytes);
        const FrameWorkload frame =
            file.frame("The test", like.projection, like.tile_size, like.tile_mode);
        EXPECT_TRUE(sim::is_sound(frame));
        return "";
    } catch (const InputError& error) {
        const std::string sentence = error.what();
        EXPECT_EQ(sentence.rfind(kName, 0), 0U) << sentence;
        EXPECT_EQ(sentence.back(), '.') << sentence;
        return sentence;
    }
}

TEST(WorkloadFile, GivesTheFrameBack) {
    const Packed made = packed(static_cast<int>(sim::kSplatsPerBlock) * 2 + 100);
    const FrameWorkload& frame = made.frame;
    EXPECT_GT(frame.splats.size(), sim::kSplatsPerBlock) << "needs several blocks";
    const FrameWorkload read =
        WorkloadFile(kName, made.bytes).frame("The test", frame.projection, 16, TileMode::Exact);
    ASSERT_EQ(read.splats.size(), frame.splats.size());
    for (std::size_t i = 0; i < frame.splats.size(); ++i) {
        EXPECT_EQ(read.splats[i].id, frame.splats[i].id);
        EXPECT_EQ(read.splats[i].mu_x, frame.splats[i].mu_x);
        EXPECT_EQ(read.splats[i].depth, frame.splats[i].depth);
    }
    EXPECT_EQ(read.visible_of, frame.visible_of);
    EXPECT_EQ(read.visible_means, frame.visible_means);
    EXPECT_EQ(read.tile_begin, frame.tile_begin);
    EXPECT_EQ(read.tile_splats, frame.tile_splats);
    EXPECT_EQ(read.tiles_touched, frame.tiles_touched);
    EXPECT_EQ(read.culled.off_screen, frame.culled.off_screen);
}

TEST(WorkloadFile, HoldsAFrameForEachRuleOfProjection) {
    const ProjectionOptions plain;
    EXPECT_TRUE(sim::same_projection(plain, ProjectionOptions()));
    std::vector<ProjectionOptions> others(10, plain);
    others[0].near_plane = 0.1;
    others[1].dilation = 0.1;
    others[2].jacobian_clamp = 1.1;
    others[3].alpha_min = 1.0 / 128;
    others[4].cut = 9;
    others[5].order = SplatOrder::Distance;
    others[6].compensated = true;
    others[7].rule = ProjectionRule::Unscented;
    others[8].lens = LensRule::Pinhole;
    others[9].numbers.format = parse_format("fp16");
    for (std::size_t i = 0; i < others.size(); ++i) {
        EXPECT_FALSE(sim::same_projection(plain, others[i])) << i;
    }
    ProjectionOptions points = plain; // of the unscented projection, the only one that has any
    points.sigma.alpha *= 2;
    EXPECT_TRUE(sim::same_projection(plain, points));
    points.rule = others[7].rule;
    EXPECT_FALSE(sim::same_projection(points, others[7]));
}

/// What check_whole() says of a block and one splat more, whose depth this is.
std::string check_of_blocks(double last_depth) {
    FrameWorkload frame;
    frame.splats.resize(sim::kSplatsPerBlock + 1);
    for (std::size_t i = 0; i < frame.splats.size(); ++i) {
        frame.visible_of.push_back(static_cast<std::uint32_t>(i));
        frame.splats[i].id = static_cast<std::uint32_t>(i);
        frame.splats[i].depth = 1 + 1e-3 * static_cast<double>(i);
    }
    frame.gaussians = frame.splats.size();
    frame.splats.back().depth = last_depth;
    try {
        sim::SplatUnpacker(kName, frame).check_whole("frame 0");
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(HostileWorkloadFile, RefusesBlocksOutOfOrder) {
    EXPECT_THAT(check_of_blocks(2), HasSubstr("splat 16384 is not behind the one before it"));
    EXPECT_THAT(check_of_blocks(100), HasSubstr("Gaussian 0 has no splat")); // no block was read
}

/// What is said of one list of `entries` in a frame of so many splats.
std::string refusal_of_list(std::uint64_t entries, std::uint64_t splats) {
    FrameWorkload frame;
    frame.tile_begin = {0, entries};
    const std::string block = sim::pack_lengths(frame);
    std::vector<std::uint64_t> tile_begin(2);
    try {
        sim::unpack_lengths(kName, "lists", block, splats, entries, tile_begin);
        EXPECT_EQ(tile_begin, frame.tile_begin);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(HostileWorkloadFile, RefusesAListOfMoreThanAllSplats) {
    EXPECT_EQ(refusal_of_list(3, 3), "");
    EXPECT_THAT(refusal_of_list(4, 3), HasSubstr("tile 0 lists 4 splats; at most the 3"));
}

TEST(HostileWorkloadFile, SaysWhatIsWrong) {
    const Packed made = packed(12);
    const std::string& good = made.bytes;
    const auto said = [&](const std::string& bytes) { return refusal(bytes, made.frame); };
    EXPECT_EQ(said(good), "");
    EXPECT_THAT(said("ply\nformat"), HasSubstr("begins with 'degswork'"));
    std::string bytes = good;
    bytes[sim::kVersionAt] = 1;
    EXPECT_THAT(said(bytes), HasSubstr("version at byte 8 is 1; this program reads version 2"));
    bytes[sim::kVersionAt] = 0;
    bytes[sim::kVersionAt + 3] = 2;
    EXPECT_THAT(said(bytes), HasSubstr("highest byte first"));
    bytes = good;
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    EXPECT_THAT(said(bytes), HasSubstr("the checksum in its last 16 bytes"));
    bytes = good;
    bytes[sim::kHeadBytesAt + 3] = 0x7f;
    EXPECT_THAT(said(bytes), HasSubstr("length of its head at byte 12"));
    EXPECT_THAT(said(with_whole_head(
                    good + good,
                    good.substr(sim::kHeadAt, sim::little_endian_at(good, sim::kHeadBytesAt)))),
                HasSubstr("where only the checksum may"));
    const auto changed = [&](const std::string& old, const std::string& now) {
        return said(with_head(good, old, now));
    };
    EXPECT_THAT(changed("{", "["), HasSubstr("must be a JSON object"));
    EXPECT_THAT(changed("\"width\":24", "\"width\":70000"), HasSubstr("'camera.width'"));
    EXPECT_THAT(changed("\"width\":24", "\"width\":-1"), HasSubstr("from 1 to 65536"));
    EXPECT_THAT(changed("\"width\":24", "\"wide\":24"), HasSubstr("no 'camera.width'"));
    EXPECT_THAT(changed("\"gaussians\":12", "\"gaussians\":1e9"), HasSubstr("'scene.gaussians'"));
    EXPECT_THAT(changed("\"gaussians\":12", "\"gaussians\":13"), HasSubstr("do not add up"));
    EXPECT_THAT(changed("\"format\":\"fp64\"", "\"format\":\"fp65x\""),
                HasSubstr("name of a number format"));
    EXPECT_THAT(changed("\"tile_mode\":\"exact\"", "\"tile_mode\":\"round\""),
                HasSubstr("exact or square or box or tight"));
    EXPECT_THAT(changed("\"projection\":0", "\"projection\":1"), HasSubstr("from 0 to 0"));
    EXPECT_THAT(changed("\"blocks\":[", "\"blocks\":[18446744073709551615,"),
                HasSubstr("projections[0].blocks[0]"));
}

// Counts that fit each other claim more splats than the bytes can hold.
TEST(HostileWorkloadFile, AsksForNoMoreMemoryThanItsBytesAllow) {
    const Packed made = packed(12);
    std::string bytes = with_head(made.bytes, "\"gaussians\":12", "\"gaussians\":4000000012");
    const std::uint64_t off_screen = made.frame.culled.off_screen;
    bytes = with_head(bytes, "\"off_screen\":" + std::to_string(off_screen),
                      "\"off_screen\":" + std::to_string(off_screen + 4000000000U));
    const std::string splats = "\"splats\":" + std::to_string(made.frame.splats.size());
    bytes = with_head(bytes, splats, "\"splats\":163840");
    std::string blocks = "\"blocks\":["; // as many as the splats need, of a byte each
    for (int k = 0; k < 18; ++k) {
        blocks += "1,";
    }
    bytes = with_head(bytes, "\"blocks\":[", blocks);
    EXPECT_THAT(refusal(bytes, made.frame), HasSubstr("may become 1024 at most"));
    const std::string entries = "\"entries\":" + std::to_string(made.frame.tile_splats.size());
    EXPECT_THAT(refusal(with_head(made.bytes, entries, "\"entries\":4000000000"), made.frame),
                HasSubstr("may become 1024 at most"));
}

TEST(HostileWorkloadFile, RefusesListsThatNoFrameHas) {
    const Packed made = packed(12);
    sim::SceneFacts facts;
    facts.name = "object";
    facts.gaussians = 12;
    const auto said = [&](const FrameWorkload& frame) {
        return refusal(sim::pack_workload(facts, {{frame, {}}}), made.frame);
    };
    FrameWorkload frame = made.frame;
    frame.tile_splats.back() = 12;
    EXPECT_THAT(said(frame), HasSubstr("lists splat 12; only the"));
    frame = made.frame;
    std::swap(frame.splats[0], frame.splats[1]);
    EXPECT_THAT(said(frame), HasSubstr("is not behind the one before it"));
    frame = made.frame;
    frame.splats[1].id = frame.splats[0].id;
    EXPECT_THAT(said(frame), HasSubstr("has no splat"));
    frame = made.frame;
    frame.visible_means[0].x = std::numeric_limits<float>::infinity();
    EXPECT_THAT(said(frame), HasSubstr("is not finite"));
}

TEST(HostileWorkloadFile, RefusesValuesThatNoProjectionGives) {
    const Packed made = packed(12);
    for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), -1.0}) {
        FrameWorkload frame = made.frame;
        frame.splats[3].det = value;
        sim::SceneFacts facts;
        facts.name = "object";
        facts.gaussians = 12;
        EXPECT_THAT(refusal(sim::pack_workload(facts, {{frame, {}}}), made.frame),
                    HasSubstr("has a value that is not finite or outside its range"));
    }
}

TEST(HostileWorkloadFile, TakesNoFileThatIsCutOrChanged) {
    const Packed made = packed(12);
    // The sanitizers take ten times as long; every third place finds what they look for.
    constexpr std::size_t kStep = DEGS_ADDRESS_SANITIZER ? 3 : 1;
    for (std::size_t size = 0; size < made.bytes.size(); size += kStep) {
        EXPECT_NE(refusal(made.bytes.substr(0, size), made.frame), "") << size;
        if (size >= sim::kHeadAt + sim::kChecksumBytes) {
            EXPECT_NE(refusal(signed_again(made.bytes.substr(0, size)), made.frame), "") << size;
        }
    }
    for (std::size_t at = 0; at < made.bytes.size(); at += kStep) {
        for (const int bit : {1, 16, 64}) {
            std::string bytes = made.bytes;
            bytes[at] = static_cast<char>(bytes[at] ^ bit);
            EXPECT_NE(refusal(bytes, made.frame), "") << at;
            refusal(signed_again(bytes), made.frame); // refused, or a sound frame
        }
    }
}

} // namespace
} // namespace degs::sim_test
