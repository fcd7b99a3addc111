// SPDX-License-Identifier: Apache-2.0
// degs accuracy on whole scenes, as a user calls it.
#include <cmath>

#include "accuracy/flip/flip.hpp"
#include "scene/files/image_io.hpp"
#include "sim/shell/scene_list.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

constexpr const char* kAccuracyScene = "synthetic:object,gaussians=800";

json accuracy_of_scenes(const Folder& folder, std::vector<std::string> arguments) {
    std::vector<std::string> all{"accuracy", "--out", folder / "out"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = degs(all);
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("PSNR dB"), std::string::npos) << outcome.out;
    return json::parse(read_file(folder / "out/accuracy.json"));
}

TEST(LongAccuracyScenes, ARowPerSceneResolutionAndSet) {
    const Folder folder;
    const json rows = accuracy_of_scenes(
        folder, {"--scene", std::string(kAccuracyScene) + ",synthetic:single", "--camera", "1",
                 "--numbers", "ideal,tuned", "--resolution", "720p,1080p"});
    ASSERT_EQ(rows.size(), 8U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const json& row = rows[i];
        EXPECT_EQ(row["scene"], i < 4 ? "object" : "single");
        EXPECT_EQ(row["camera"], 1);
        EXPECT_EQ(row["resolution"], i % 4 < 2 ? "1280x720" : "1920x1080");
        EXPECT_EQ(row["numbers"], i % 2 == 0 ? "ideal" : "tuned");
        EXPECT_EQ(row["nonfinite"], 0);
        EXPECT_EQ(row["span_ends"], "exact");
        EXPECT_TRUE(fs::exists(folder / "out/" + row["error_image"].get<std::string>()));
        if (i % 2 == 1) {
            EXPECT_GT(row["psnr_db"], 60);
            EXPECT_GT(row["alpha_error_max"], row["alpha_error_mean"]);
            EXPECT_FALSE(row["worst_pixel"]["operation"].is_null()) << row;
        }
    }
    EXPECT_NE(read_file(folder / "out/accuracy.svg").find("tuned"), std::string::npos);
}

/// The row, the error image and two images made by other commands say the same. `rules` are options
/// of commands without a configuration, `more` of all.
void expect_difference_of_run_and_render(const std::string& numbers,
                                         const std::vector<std::string>& keys,
                                         const std::string& projection,
                                         const std::vector<std::string>& rules = {},
                                         const std::vector<std::string>& more = {}) {
    const Folder folder;
    const std::vector<std::string> view{"--scene", kAccuracyScene, "--camera", "0"};
    const auto with = [&view, &more](std::vector<std::string> arguments,
                                     const std::vector<std::string>& own = {}) {
        for (const std::vector<std::string>& words : {view, more, own}) {
            arguments.insert(arguments.end(), words.begin(), words.end());
        }
        return arguments;
    };
    const json rows = accuracy_of_scenes(folder, with({"--numbers", numbers}, rules));
    ASSERT_EQ(rows.size(), 1U);
    expect_success(degs(with({"render", "--out", folder / "render"}, rules)));
    std::vector<std::string> command{"run",   config("degs-64"),     "--out", folder / "run",
                                     "--set", "pipeline.tiles=exact"}; // the lists of both others
    for (const std::string& key : keys) {
        command.insert(command.end(), {"--set", key});
    }
    expect_success(degs(with(command)));
    EXPECT_EQ(report_in(folder / "run")["workload"]["projection"], projection);
    const Image run = read_exr(folder / "run/image.exr");
    const Image reference = read_exr(folder / "render/image.exr");
    const Image error = read_exr(folder / "out/" + rows[0]["error_image"].get<std::string>());
    ASSERT_EQ(run.width, error.width);
    ASSERT_EQ(run.height, error.height);
    float worst = 0;
    for (std::size_t i = 0; i < run.rgb.size(); ++i) {
        ASSERT_EQ(run.rgb[i] - reference.rgb[i], error.rgb[i]) << i;
        worst = std::max(worst, std::abs(run.rgb[i] - reference.rgb[i]));
    }
    for (std::size_t i = 0; i < run.pixels(); ++i) {
        ASSERT_EQ(run.transmittance[i] - reference.transmittance[i], error.transmittance[i]) << i;
        worst = std::max(worst, std::abs(error.transmittance[i]));
    }
    EXPECT_NEAR(rows[0]["max_abs_error"], worst, 1e-6);
    EXPECT_NEAR(rows[0]["flip"], flip_difference(reference, run), 1e-12);
    EXPECT_GT(rows[0]["flip"], 0);
    const json& pixel = rows[0]["worst_pixel"];
    const std::size_t at = run.at(pixel["x"], pixel["y"]);
    EXPECT_EQ(worst,
              std::max({std::abs(error.rgb[3 * at]), std::abs(error.rgb[3 * at + 1]),
                        std::abs(error.rgb[3 * at + 2]), std::abs(error.transmittance[at])}));
    EXPECT_NEAR(pixel["error"], worst, 0.1 * worst); // the pixel's replay
}

TEST(AccuracyScenes, IsTheDifferenceOfRunAndRender) {
    expect_difference_of_run_and_render(
        "paper", {"pipeline.numbers=paper", "pipeline.span_ends=slope"}, "fp32");
}

TEST(AccuracyScenes, DrawsByTheRulesAndInThePartOfRuns) {
    expect_difference_of_run_and_render(
        "paper",
        {"pipeline.numbers=paper", "pipeline.span_ends=slope", "pipeline.rules.preset=khr",
         "pipeline.rules.low_pass=0.1", "pipeline.rules.antialiasing=on", "pipeline.rules.cut=8"},
        "fp32", {"--rules", "khr", "--low-pass", "0.1", "--antialiasing", "on", "--cut", "8"},
        {"--width", "320", "--crop", "101,57,96x64"});
}

TEST(AccuracyScenes, HasARowForEachView) {
    const Folder folder;
    const auto rows_of = [&folder](const std::vector<std::string>& views) {
        std::vector<std::string> all{"--scene", kAccuracyScene, "--width",
                                     "64",      "--numbers",    "paper"};
        all.insert(all.end(), views.begin(), views.end());
        json rows = accuracy_of_scenes(folder, all);
        for (json& row : rows) {
            row.erase("error_image");
        }
        return rows;
    };
    const json eyes = rows_of({"--eyes", "0.1"});
    ASSERT_EQ(eyes.size(), 2U);
    EXPECT_EQ(eyes[0]["eye"], "left");
    EXPECT_EQ(eyes[1]["eye"], "right");
    EXPECT_NE(eyes[0]["alpha_error_mean"], eyes[1]["alpha_error_mean"]);
    EXPECT_NE(read_file(folder / "out/accuracy.svg").find("right eye"), std::string::npos);
    EXPECT_EQ(rows_of({"--eyes", "0.05", "--units-per-metre", "2"}), eyes);
    const json views = rows_of({"--views", "2,1"});
    ASSERT_EQ(views.size(), 2U);
    EXPECT_EQ(views[0], rows_of({"--camera", "2"})[0]);
    EXPECT_EQ(views[1], rows_of({"--camera", "1"})[0]);
    EXPECT_FALSE(views[0].contains("eye"));
    expect_success(degs({"accuracy", "--single-gaussian", "--splats", "20", "--scene",
                         kAccuracyScene, "--views", "2,1", "--out", folder / "single"}));
    EXPECT_EQ(json::parse(read_file(folder / "single/accuracy.json")).back()["camera"], 1);
}

TEST(AccuracyScenes, ProjectsAsTheRunDoes) {
    const std::pair<const char*, const char*> sets[] = {
        {"fp32:projection=fp32", "fp32"},
        {"fp32:projection=e8m14", "e8m14"},
        {"tuned:projection=fp64:alpha=uq0.12", "fp64"}};
    for (const auto& [numbers, projection] : sets) {
        expect_difference_of_run_and_render(
            numbers, {"pipeline.span_ends=exact", std::string("pipeline.numbers=") + numbers},
            projection);
    }
}

TEST(AccuracyScenes, EveryRowHasItsOwnProjection) {
    const Folder folder;
    const json rows = accuracy_of_scenes(
        folder, {"--scene", kAccuracyScene, "--numbers",
                 "ideal,ideal:projection=e8m14,ideal:projection=bf16,ideal:projection=fp32"});
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0]["identical"], true);
    EXPECT_EQ(rows[1]["numbers"], "ideal projection=e8m14");
    EXPECT_GT(rows[1]["psnr_db"].get<double>(), rows[2]["psnr_db"].get<double>() + 20);
    EXPECT_GT(rows[3]["psnr_db"].get<double>(), rows[1]["psnr_db"].get<double>() + 20);
    EXPECT_EQ(rows[2]["worst_pixel"]["operation"], "projection");
}

TEST(AccuracyScenes, EqualImagesHaveNoPsnr) {
    const Folder folder;
    const json rows = accuracy_of_scenes(
        folder, {"--scene", "synthetic:single", "--numbers", "ideal", "--no-error-images"});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0]["identical"], true);
    EXPECT_TRUE(rows[0]["psnr_db"].is_null());
    EXPECT_TRUE(rows[0]["worst_pixel"].is_null());
    EXPECT_TRUE(rows[0]["error_image"].is_null());
    EXPECT_EQ(rows[0]["max_abs_error"], 0);
    EXPECT_EQ(rows[0]["flip"], 0);
}

TEST(AccuracyScenes, ErrorImagesOfAnEarlierRunAreReplaced) {
    const Folder folder;
    const std::vector<std::string> earlier{"error-0-object-1280x720-tuned.exr",
                                           "error-17--1x1-.exr",
                                           "error-3-a-12x7-b-640x480-c-d.exr"};
    const std::vector<std::string> foreign{
        "error-1-1280x720-tuned.exr",         "error-a-object-1280x720-tuned.exr",
        "error-1-object-1280x-tuned.exr",     "error-1-object-1280x720.exr",
        "error-1-object-1280x720-tuned.png",  "my-error-1-object-1280x720-tuned.exr",
        "error-1-object-1280x720-tuned.exr2", "error-1-object.exr"};
    fs::create_directory(folder / "out");
    for (const std::vector<std::string>& names : {earlier, foreign, {"accuracy.json"}}) {
        for (const std::string& name : names) {
            std::ofstream(folder / ("out/" + name)) << name;
        }
    }
    accuracy_of_scenes(folder,
                       {"--scene", "synthetic:single", "--numbers", "ideal", "--no-error-images"});
    for (const std::string& name : earlier) {
        EXPECT_FALSE(fs::exists(folder / ("out/" + name))) << name;
    }
    for (const std::string& name : foreign) {
        EXPECT_EQ(read_file(folder / ("out/" + name)), name);
    }
}

/// FP16 has no colour like these: pixels of infinite colour, and some that are not a number.
TEST(AccuracyScenes, SayOfInfinitePixelsWhatRunSays) {
    const Folder folder;
    Splat hot, behind;
    hot.colour = behind.colour = {3e5F, 3e5F, 3e5F};
    behind.mean = {0.02F, 0, 0.1F};
    write_ply(folder / "hot.ply", {hot, behind});
    write_camera(folder / "cameras.json", {0, 0, -4});
    const Outcome measured = degs({"accuracy", "--scene", folder / "hot.ply", "--numbers", "fp16",
                                   "--out", folder / "a", "--no-error-images"});
    EXPECT_EQ(measured.code, 0) << measured.err;
    EXPECT_EQ(measured.out.find("-nan"), std::string::npos) << measured.out;
    const json row = json::parse(read_file(folder / "a/accuracy.json")).at(0);
    const Outcome ran = degs({"run", config("degs-16"), "--set", "pipeline.numbers=fp16", "--scene",
                              folder / "hot.ply", "--out", folder / "r"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out.find("-nan"), std::string::npos) << ran.out;
    const json image = report_in(folder / "r")["image"];
    EXPECT_EQ(row["max_abs_error"], "inf");
    EXPECT_EQ(row["psnr_db"], "-inf");
    EXPECT_TRUE(row["ssim"].is_null());
    for (const char* key : {"max_abs_error", "psnr_db", "ssim"}) {
        EXPECT_EQ(image[key], row[key]) << key;
    }
    int infinite = 0;
    for (const float value : read_exr(folder / "r/image.exr").rgb) {
        infinite += std::isfinite(value) ? 0 : 1;
    }
    EXPECT_EQ(row["nonfinite"], infinite);
}

TEST(AccuracyScenes, SpanEndsCanBeChosen) {
    const Folder folder;
    const json own = accuracy_of_scenes(folder, {"--scene", kAccuracyScene, "--numbers", "paper"});
    const json exact = accuracy_of_scenes(
        folder, {"--scene", kAccuracyScene, "--numbers", "paper", "--span-ends", "exact"});
    EXPECT_EQ(own[0]["span_ends"], "slope");
    EXPECT_EQ(exact[0]["span_ends"], "exact");
    EXPECT_GT(exact[0]["psnr_db"], own[0]["psnr_db"]);
    EXPECT_LT(exact[0]["recounted_pixels"], own[0]["recounted_pixels"]);
}

TEST(AccuracyScenes, NamesMistakes) {
    const Folder folder;
    const std::string out = folder / "out";
    const auto mistake = [&out](std::vector<std::string> arguments, const char* words) {
        arguments.insert(arguments.begin(), "accuracy");
        arguments.insert(arguments.end(), {"--out", out});
        expect_mistake(degs(arguments), words);
    };
    mistake({"--scene", kAccuracyScene, "--numbers", "fp8"}, "'fp8'");
    mistake({"--scene", kAccuracyScene, "--numbers", "tuned:alfa=fp16"}, "key 'alfa' is unknown");
    mistake({"--scene", kAccuracyScene, "--numbers", "tuned:projection=fp8"},
            "key 'projection' is 'fp8', but must be");
    mistake({"--scene", kAccuracyScene, "--numbers", "tuned:projection=ue8m9"}, "must have a sign");
    mistake({"--scene", kAccuracyScene, "--resolution", "720p,16k"}, "'16k'");
    mistake({"--scene", "absent.ply"}, "absent.ply");
    mistake({"--scene", "synthetic:object,"}, "empty name");
    mistake({"--scene", kAccuracyScene, "--camera", "9"}, "Camera 9");
    mistake({"--scene", kAccuracyScene, "--span-ends", "inward"}, "inward");
    mistake({"--scene", kAccuracyScene, "--tile-size", "0"}, "--tile-size");
    mistake({"--only", "H1"}, "--hard-cases");
    mistake({"--hard-cases", "--only", "H99"}, "'H99'");
    mistake({"--hard-cases", "--numbers", "fp8"}, "'fp8'");
    mistake({"--hard-cases", "--resolution", "9k"}, "'9k'");
    std::ofstream(folder / "file") << "no folder";
    expect_mistake(degs({"accuracy", "--scene", kAccuracyScene, "--out", folder / "file"}), "file");
    expect_mistake(degs({"accuracy", "--hard-cases", "--out", folder / "file/below"}), "below");
}

TEST(SceneList, CommasBelongToSyntheticScenes) {
    using List = std::vector<std::string>;
    using sim::split_scenes;
    EXPECT_EQ(split_scenes({"a.ply"}), List{"a.ply"});
    EXPECT_EQ(split_scenes({"a.ply,b.ply", "c.ply"}), (List{"a.ply", "b.ply", "c.ply"}));
    EXPECT_EQ(split_scenes({"synthetic:object,gaussians=5,seed=2,b.ply,synthetic:single"}),
              (List{"synthetic:object,gaussians=5,seed=2", "b.ply", "synthetic:single"}));
    EXPECT_EQ(split_scenes({"synthetic:single", "seed=2"}), (List{"synthetic:single", "seed=2"}));
    EXPECT_EQ(split_scenes({"a.ply,"}), (List{"a.ply", ""}));
    const Folder folder;
    const std::string odd = folder / "a,b.ply";
    std::ofstream(odd) << "ply";
    EXPECT_EQ(split_scenes({odd}), List{odd});
}

} // namespace
} // namespace degs::sim_test
