// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/pose_path.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "scene/cameras/orbit_camera.hpp"

namespace degs {
namespace {

constexpr double kPi = 3.14159265358979323846;

class PoseFile : public ::testing::Test {
protected:
    std::vector<Pose> read(const std::string& text) const {
        std::ofstream(path_, std::ios::binary) << text;
        return read_poses(path_);
    }
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& why) {
            return why.what();
        }
        return "";
    }
    void TearDown() override { std::filesystem::remove(path_); }

    std::string path_ =
        (std::filesystem::temp_directory_path() /
         ("poses-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
          "-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + ".csv"))
            .string();
};

Pose turned_about_y(double time_s, double degrees, const glm::dvec3& position) {
    const double half = degrees * kPi / 360;
    return {time_s, position, {std::cos(half), 0, std::sin(half), 0}};
}

TEST_F(PoseFile, ReadsColumnsInAnyOrderAndSkipsOthers) {
    const std::vector<Pose> poses = read("# a headset\nqw,qx,qy,qz,confidence,x,y,z,time_s\r\n"
                                         "1,0,0,0,9,1,2,3,0.5\n\n0,0,1,0,9,-1,2e1,3,0.75\n");
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_EQ(poses[0].time_s, 0.5);
    EXPECT_EQ(poses[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(poses[1].position, glm::dvec3(-1, 20, 3));
    EXPECT_EQ(poses[1].rotation.y, 1);
}

// What spreadsheets, R and recorders with Unix time write.
TEST_F(PoseFile, ReadsMarksQuotesAndUnixTime) {
    const std::string head = "time_s,x,y,z,qw,qx,qy,qz\n";
    const std::string row = "1700000000.25,1,2,3,1,0,0,0\n";
    const std::string quoted = "\"time_s\",\"x\",\"y\",\"z\",\"qw\",\"qx\",\"qy\",\"qz\"\r\n"
                               "\"1700000000.25\",\"1\", \"2\" ,3,\"1\",0,0,\"0\"\r\n";
    for (const std::string& text : {head + row, "\xef\xbb\xbf" + head + row, quoted}) {
        const std::vector<Pose> poses = read(text);
        ASSERT_EQ(poses.size(), 1U);
        EXPECT_EQ(poses[0].time_s, 1700000000.25);
        EXPECT_EQ(poses[0].position, glm::dvec3(1, 2, 3));
    }
    EXPECT_NE(refusal(head + "1700000000000000000,0,0,0,1,0,0,0\n").find("a number of seconds"),
              std::string::npos);
}

TEST_F(PoseFile, RefusesWithTheLine) {
    const std::string head = "time_s,x,y,z,qw,qx,qy,qz\n";
    for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
             {"time_s,x,y,z,qw,qx,qy\n", "line 1 lacks the column 'qz'"},
             {"time_s,x,x,y,z,qw,qx,qy,qz\n", "line 1 has twice the column 'x'"},
             {head, "has no pose"},
             {head + "0,0,0,0,1,0,0\n", "line 2 has 7 cells, but there are 8 columns"},
             {head + "0,0,0,zero,1,0,0,0\n", "line 2 has a z of 'zero'"},
             {head + "0,0,0,nan,1,0,0,0\n", "line 2 has a z of 'nan'"},
             {head + "0,0,1e12,0,1,0,0,0\n", "line 2 has a y of '1e12'"},
             {head + "0,0,0,0,0,0,0,0\n", "line 2 has a quaternion of length 0"},
             {head + "0,0,0,0,2,0,0,0\n", "line 2 has a quaternion of length 2"},
             {head + "1,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n", "line 3 has a time_s that is not later"},
         }) {
        EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
    }
}

TEST(PosePath, OtherTextsAreCalledWhatTheyAre) {
    const test::Folder folder;
    const auto complaint = [&](const std::string& text) {
        const std::string file = folder.write("poses.csv", text);
        return test::complaint([&] { read_poses(file); });
    };
    for (const char* head : {"time_s;x;y;z;qw;qx;qy;qz", "time_s\tx\ty"}) {
        EXPECT_THAT(complaint(std::string(head) + "\n1\n"),
                    test::IsSentenceWith("commas separate the columns"));
    }
    EXPECT_THAT(complaint("\"time_s,x,y\n1\n"), test::IsSentenceWith("quote does not end"));
    for (const std::string mark : {"\xff\xfe", "\xfe\xff"}) {
        EXPECT_THAT(complaint(mark + "t"), test::IsSentenceWith("UTF-16"));
    }
}

TEST(PosePath, TurnsAtConstantSpeedBetweenPoses) {
    const std::vector<Pose> poses{turned_about_y(1, 10, {0, 0, 0}),
                                  turned_about_y(3, 50, {4, 0, 2})};
    for (const double share : {0.0, 0.25, 0.5, 0.9}) {
        const Pose pose = pose_at(poses, 1 + 2 * share);
        const Pose wanted = turned_about_y(0, 10 + 40 * share, {4 * share, 0, 2 * share});
        EXPECT_LE(glm::length(pose.position - wanted.position), 1e-14);
        EXPECT_NEAR(std::abs(glm::dot(pose.rotation, wanted.rotation)), 1, 1e-14);
    }
    EXPECT_EQ(pose_at(poses, 0).position, poses.front().position);
    EXPECT_EQ(pose_at(poses, 9).position, poses.back().position);
    // The longer way round has the opposite sign, and is the same rotation.
    std::vector<Pose> other = poses;
    other[1].rotation = -other[1].rotation;
    EXPECT_NEAR(std::abs(glm::dot(pose_at(other, 2).rotation, pose_at(poses, 2).rotation)), 1,
                1e-14);
}

TEST(PosePath, CameraAndPoseAreOneThing) {
    const Camera camera = looking_at({3, -2, -5}, {0, 0.5, 1});
    const Camera again = placed(camera, pose_of(camera, 0));
    EXPECT_EQ(again.position, camera.position);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(glm::length(again.camera_to_world[axis] - camera.camera_to_world[axis]), 1e-14);
    }
}

/// A head that steps one metre forward and looks up, from any pose of the recording.
TEST(PosePath, StartsAtACamera) {
    const Camera camera = looking_at({3, -2, -5}, {0, 0.5, 1});
    const double half = 15 * kPi / 180;
    for (const double degrees : {0.0, 70.0, 200.0}) {
        const Pose first = turned_about_y(5, degrees, {7, 1, -2});
        const glm::dquat up(std::cos(half), std::sin(half), 0, 0); // about x, which points right
        const Pose second{6, first.position + first.rotation * glm::dvec3(0, 0, -1),
                          first.rotation * up};
        const std::vector<Pose> moved = started_at({first, second}, pose_of(camera, 0), 2.5);
        const Camera start = placed(camera, moved[0]), end = placed(camera, moved[1]);
        EXPECT_LE(glm::length(start.position - camera.position), 1e-12);
        EXPECT_LE(glm::length(end.position - camera.position - 2.5 * camera.camera_to_world[2]),
                  1e-12);
        const glm::dvec3 forward = std::cos(2 * half) * camera.camera_to_world[2] -
                                   std::sin(2 * half) * camera.camera_to_world[1];
        EXPECT_LE(glm::length(end.camera_to_world[2] - forward), 1e-12);
        EXPECT_LE(glm::length(end.camera_to_world[0] - camera.camera_to_world[0]), 1e-12);
    }
}

} // namespace
} // namespace degs
