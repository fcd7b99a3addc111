// SPDX-License-Identifier: Apache-2.0
// degs_fuzz_seeds FOLDER: writes a small valid input, or a few, for every fuzz target, to
// FOLDER/TARGET.
#include <cmath>
#include <cstdio>
#include <sstream>

#include <nlohmann/json.hpp>
#include <webp/encode.h>

#include "scene/gltf/gltf.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/fuzz/fuzz_cache.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/spz/spz_builder.hpp"
#include "tests/scene/zip_builder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace degs;

class Seeds {
public:
    explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}
    void add(const std::string& target, const std::string& bytes) {
        fs::create_directories(folder_ / target);
        std::ofstream(folder_ / target / ("seed-" + std::to_string(count_++)), std::ios::binary)
            << bytes;
    }

private:
    fs::path folder_;
    int count_ = 0;
};

std::string length_and(const std::string& part) {
    return test::ZipBuilder::little(part.size(), 2) + part;
}

using Parts = std::vector<std::pair<std::string, std::string>>;

/// As fuzz_archive.hpp reads it.
std::string listed(const Parts& parts, char kind) {
    std::string bytes(1, kind);
    for (const auto& [name, content] : parts) {
        bytes += length_and(name) + length_and(content);
    }
    return bytes;
}

std::string bytes_in(const std::string& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return content.str();
}

template <class Value>
std::string raw(const std::vector<Value>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

void add_ply(Seeds& seeds) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        for (const int rest : {0, 9, 45}) {
            test::PlyBuilder ply = test::PlyBuilder::splat(rest);
            ply.format = format;
            if (rest == 9) {
                ply.add({"filter_3D"});
                ply.before =
                    "comment SplatRenderMode: mip\nelement camera 1\nproperty list uchar int a\n";
                ply.body_before = ply.format == "ascii" ? "2 7 8\n" : std::string(1, '\0');
            }
            for (int i = 0; i < 2; ++i) {
                ply.add_row(
                    [i](const std::string& name) { return name == "rot_0" ? 1.0 : 0.1 * i - 0.2; });
            }
            seeds.add("ply", ply.file());
            seeds.add("scene", ply.file());
        }
    }
    std::string packed = "ply\nformat binary_little_endian 1.0\nelement chunk 1\n";
    for (const char* end : {"min_", "max_"}) {
        for (const char* name : {"x", "y", "z", "scale_x", "scale_y", "scale_z"}) {
            packed += std::string("property float ") + end + name + "\n";
        }
    }
    packed += "element vertex 3\n";
    for (const char* name : {"position", "rotation", "scale", "color"}) {
        packed += std::string("property uint packed_") + name + "\n";
    }
    packed += "end_header\n" + raw(std::vector<float>{0, 0, 0, -3, -3, -3, 1, 1, 1, 0, 0, 0}) +
              raw(std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    seeds.add("ply", packed);
}

void add_spz(Seeds& seeds) {
    for (const unsigned version : {1U, 2U, 3U, 4U}) {
        for (const int degree : {0, 1, 3}) {
            test::SpzBuilder spz = test::SpzBuilder::scene(version, 3, degree);
            spz.flags = degree == 1 ? 3 : 0;
            spz.records =
                degree == 1 ? test::SpzBuilder::record(0xADBE0003, std::string(1, 5)) : "";
            seeds.add("spz", std::string(1, '\0') + spz.file());
            if (version != 4) {
                seeds.add("spz", std::string(1, '\1') + spz.inflated());
            }
            seeds.add("scene", spz.file());
        }
    }
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header.resize((header.size() + 11) / 64 * 64 + 53, ' ');
    header += '\n';
    return "\x93NUMPY" + std::string("\x01\x00", 2) + length_and(header) + data;
}

void add_npz(Seeds& seeds) {
    const auto floats = [](std::size_t count) {
        std::vector<float> values;
        for (std::size_t i = 0; i < count; ++i) {
            values.push_back(0.25F * static_cast<float>(i % 7) - 0.5F);
        }
        return raw(values);
    };
    const Parts gaussians = {{"means.npy", npy("<f4", "(2, 3)", floats(6))},
                             {"quats.npy", npy("<f4", "(2, 4)", floats(8))},
                             {"scales.npy", npy("<f4", "(2, 3)", floats(6))},
                             {"opacities.npy", npy("<f4", "(2,)", floats(2))},
                             {"sh0.npy", npy("<f4", "(2, 1, 3)", floats(6))},
                             {"shN.npy", npy("<f4", "(2, 3, 3)", floats(18))}};
    const Parts points = {
        {"points.npy", npy("<f8", "(5, 3)", raw(std::vector<double>(15, 0.5)))},
        {"rgb.npy", npy("|u1", "(5, 3)", std::string(15, 'a'))},
        {"viewmats.npy",
         npy("<f4", "(1, 4, 4)",
             raw(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}))},
        {"Ks.npy", npy("<f4", "(1, 3, 3)", raw(std::vector<float>{50, 0, 32, 0, 50, 24, 0, 0, 1}))},
        {"width.npy", npy("<i8", "()", raw(std::vector<std::int64_t>{64}))},
        {"height.npy", npy("<i8", "()", raw(std::vector<std::int64_t>{48}))}};
    for (const Parts& parts : {gaussians, points}) {
        for (const char kind : {'\1', '\2'}) {
            seeds.add("npz", listed(parts, kind));
        }
        test::ZipBuilder zip;
        zip.files = parts;
        zip.deflated = true;
        seeds.add("npz", std::string(1, '\0') + zip.file());
        seeds.add("scene", zip.file());
    }
}

std::string webp(int width, int height) {
    std::vector<unsigned char> rgba;
    for (int i = 0; i < 4 * width * height; ++i) {
        rgba.push_back(static_cast<unsigned char>(i % 4 == 3 ? 255 : i * 37));
    }
    unsigned char* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &out);
    std::string file(reinterpret_cast<const char*>(out), size);
    WebPFree(out);
    return file;
}

void add_sog(Seeds& seeds) {
    std::string book;
    for (int i = 0; i < 256; ++i) {
        book += (i == 0 ? "" : ",") + std::to_string(i / 64.0 - 2).substr(0, 5);
    }
    const std::string image = webp(2, 2);
    const std::string start =
        "\"means\":{\"mins\":[-1,-1,-1],\"maxs\":[1,1,1],\"files\":[\"a\",\"a\"]},";
    const std::string version_2 = "{\"version\":2,\"count\":3," + start +
                                  "\"scales\":{\"codebook\":[" + book +
                                  "],\"files\":[\"a\"]},\"quats\":{\"files\":[\"a\"]},\"sh0\":{" +
                                  "\"codebook\":[" + book + "],\"files\":[\"a\"]}}";
    const std::string shape = "\"shape\":[3,3],\"dtype\":\"float32\",";
    const std::string version_1 =
        "{\"means\":{" + shape + start.substr(9) + "\"scales\":{" + shape +
        "\"mins\":[-3,-3,-3],\"maxs\":[0,0,0],\"files\":[\"a\"]},\"quats\":{\"shape\":[3,4]," +
        "\"dtype\":\"uint8\",\"encoding\":\"quaternion_packed\",\"files\":[\"a\"]},\"sh0\":{" +
        "\"shape\":[3,1,4],\"dtype\":\"float32\",\"mins\":[-1,-1,-1,-1],\"maxs\":[1,1,1,1]," +
        "\"files\":[\"a\"]}}";
    const std::string levels =
        R"({"version":1,"lodLevels":2,"counts":[3,2],"filenames":["m","n"],"environment":null,)"
        R"("tree":{"children":[{"lods":{"0":{"file":0,"offset":0,"count":2},)"
        R"("1":{"file":1,"offset":2,"count":1}}},{"lods":{"0":{"file":0,"offset":2,"count":1},)"
        R"("1":{"file":1,"offset":0,"count":1}}}]}})";
    for (const std::string& meta : {version_2, version_1}) {
        seeds.add("sog", listed({{"meta.json", meta}, {"a", image}}, '\1'));
        seeds.add("sog", listed({{"meta.json", meta}, {"a", image}}, '\x80'));
        for (const char kind : {'\xc0', '\xc1', '\xc3', '\xd2'}) { // finest, levels, a budget
            seeds.add(
                "sog",
                listed({{"lod-meta.json", levels}, {"m", meta}, {"n", meta}, {"a", image}}, kind));
        }
    }
}

/// The JSON with four bytes more data, of which one is the index at which the last accessor takes
/// what the first view has.
std::string with_sparse_accessor(const std::string& text, std::size_t bytes) {
    nlohmann::json json = nlohmann::json::parse(text);
    json["buffers"][0]["byteLength"] = bytes + 4;
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", 4}});
    const std::size_t view = json["bufferViews"].size() - 1;
    json["accessors"].back()["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", view}, {"componentType", 5121}}},
        {"values", {{"bufferView", 0}}}};
    return json.dump();
}

void add_gltf(Seeds& seeds) {
    SyntheticSpec spec = parse_synthetic("uniform,gaussians=3");
    const SyntheticScene scene = make_synthetic(spec);
    const std::string path = fuzz::folder() / "seed.glb";
    write_glb(scene.cloud, scene.cameras,
              {{"left", {1, 0, 0}}, {"right", {0, 1, 0}, {0, 0.6, 0, 0.8}}}, path);
    const std::string glb = bytes_in(path);
    std::size_t length = 0;
    for (int i = 3; i >= 0; --i) {
        length = length << 8 | static_cast<unsigned char>(glb[12 + i]);
    }
    seeds.add("gltf", std::string(1, '\0') + glb);
    const std::string text = glb.substr(20, length);
    const std::string data = glb.substr(std::min(glb.size(), 28 + length));
    seeds.add("gltf", std::string(1, '\1') + length_and(text) + data);
    seeds.add("gltf", std::string(1, '\1') + length_and(with_sparse_accessor(text, data.size())) +
                          data + std::string(4, '\1'));
    seeds.add("scene", glb);
}

void add_cameras(Seeds& seeds) {
    seeds.add("cameras", R"([{"id":0,"img_name":"a","width":64,"height":48,"position":[0,0,-5],)"
                         R"("rotation":[[1,0,0],[0,1,0],[0,0,1]],"fy":50,"fx":50}])");
    seeds.add("cameras", R"({"camera_angle_x":0.7,"w":64,"h":48,"frames":[{"file_path":"a.png",)"
                         R"("transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})");
    seeds.add(
        "cameras",
        R"({"fl_x":50,"fl_y":51,"cx":32,"cy":24,"w":64,"h":48,"k1":0.1,"camera_model":"OPENCV",)"
        R"("applied_transform":[[1,0,0,0],[0,0,1,0],[0,-1,0,0]],"frames":[{"file_path":"b",)"
        R"("fl_x":40,"transform_matrix":[[0,1,0,2],[-1,0,0,3],[0,0,1,4],[0,0,0,1]]}]})");
    const std::string cameras =
        "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 PINHOLE 64 48 50 51 32 24\n"
        "2 SIMPLE_RADIAL 64 48 50 32 24 0.1\n";
    const std::string images = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
                               "1 1 0 0 0 0 0 5 1 a.jpg\n1 2 3\n2 0.6 0 0.8 0 1 2 3 2 b.jpg\n\n";
    seeds.add("colmap", std::string(1, '\0') + length_and(cameras) + images);
    const auto u64 = [](std::uint64_t v) { return test::ZipBuilder::little(v, 8); };
    const auto u32 = [](std::uint64_t v) { return test::ZipBuilder::little(v, 4); };
    const std::string lens =
        u64(1) + u32(1) + u32(1) + u64(64) + u64(48) + raw(std::vector<double>{50, 51, 32, 24});
    const std::string view = u64(1) + u32(1) + raw(std::vector<double>{1, 0, 0, 0, 0, 0, 5}) +
                             u32(1) + "a.jpg" + std::string(1, '\0') + u64(1) +
                             std::string(24, 'p');
    seeds.add("colmap", std::string(1, '\1') + length_and(lens) + view);
}

void add_text(Seeds& seeds) {
    seeds.add("config", "name: a\non: false\nshade: dark\npart:\n  count: 7\n  share: 0.25\n");
    seeds.add("config", "part: {count: 64, share: 1e-3}\n# comment\nname: \"x y\"\n");
    seeds.add("config", "part: &a {count: 2}\nname: *a\n---\n- 1\n");
    seeds.add("config", "part.count=7");
    for (const char* text :
         {"a.ply?axes=RDF", "scene.spz?axes=RUB", "synthetic:object,gaussians=10",
          "object,gaussians=10,seed=2", "a?b=c,d=e"}) {
        seeds.add("scene_spec", text);
    }
    seeds.add("splat", raw(std::vector<float>{1, 2, 3, 0.1F, 0.2F, 0.3F}) +
                           std::string("\x80\x90\xa0\xff\xff\x80\x80\x80", 8));
}

/// As fuzz_cache.cpp reads them.
void add_cache(Seeds& seeds) {
    const fuzz::KeptEntries kept;
    for (const fuzz::Entry kind :
         {fuzz::Entry::Scene, fuzz::Entry::Frame, fuzz::Entry::Reference}) {
        seeds.add("cache", static_cast<char>(kind) + kept.whole(kind));
        seeds.add("cache", static_cast<char>(static_cast<int>(kind) + 3) + kept.content(kind));
    }
}

} // namespace

void degs::fuzz::run(std::string_view) {}

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: degs_fuzz_seeds FOLDER\n");
        return 2;
    }
    Seeds seeds{fs::path(words[1])};
    add_ply(seeds);
    add_spz(seeds);
    add_npz(seeds);
    add_sog(seeds);
    add_gltf(seeds);
    add_cameras(seeds);
    add_text(seeds);
    add_cache(seeds);
    return 0;
}
