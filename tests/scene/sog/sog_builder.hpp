// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <webp/encode.h>

#include "scene/sog/sog.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/zip_builder.hpp"

namespace degs::test {

using Bytes = std::vector<unsigned char>;

inline std::string webp(const Bytes& rgba, int width, int height) {
    unsigned char* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &out);
    std::string file(reinterpret_cast<const char*>(out), size);
    WebPFree(out);
    return file;
}

/// A scene of random bytes with a pixel more than it has Gaussians.
struct SogBuilder {
    int width = 5, height = 4, count = 19;
    int degree = 2, palette = 70;
    bool version_2 = true;
    Bytes low, high, scales, quats, sh0, labels, centroids;
    std::string meta;

    SogBuilder() {
        std::mt19937 random(11);
        for (Bytes* const bytes : {&low, &high, &scales, &quats, &sh0, &labels}) {
            for (int i = 0; i < 4 * width * height; ++i) {
                bytes->push_back(static_cast<unsigned char>(random()));
            }
        }
        for (int i = 0; i < width * height; ++i) {
            for (Bytes* const bytes : {&low, &high, &scales, &labels}) {
                bytes->at(4 * i + 3) = 255; // transparent pixels lose their colour in WebP
            }
            quats[4 * i + 3] = static_cast<unsigned char>(252 + i % 4);
            sh0[4 * i + 3] |= 1;
            labels[4 * i] = static_cast<unsigned char>(labels[4 * i] % palette);
            labels[4 * i + 1] = 0;
        }
        set_degree(2);
    }

    int rest() const { return degree * (degree + 2); }
    void set_degree(int value) {
        degree = value;
        std::mt19937 random(12);
        centroids.clear();
        for (int i = 0; i < 64 * rest() * 2; ++i) {
            for (int c = 0; c < 4; ++c) {
                centroids.push_back(c == 3 ? 255 : static_cast<unsigned char>(random()));
            }
        }
        meta = version_2 ? meta_2() : meta_1();
    }
    void make_version_1() {
        version_2 = false;
        meta = meta_1();
    }

    static double code(const char* name, int byte) {
        const double at = byte / 255.0;
        return *name == 's' ? -9 + 8 * at : *name == 'c' ? 4 * at * at - 2 : at - 0.5;
    }
    static std::string code_book(const char* name) {
        std::string list;
        for (int byte = 0; byte < 256; ++byte) {
            list += (byte == 0 ? "" : ",") + std::to_string(code(name, byte));
        }
        return "\"codebook\":[" + list + "]";
    }

    std::string meta_2() const {
        return "{\"version\":2,\"antialias\":true,\"count\":" + std::to_string(count) +
               ",\"means\":{\"mins\":[-1,-2,0.5],\"maxs\":[1,2,3.5],"
               "\"files\":[\"l.webp\",\"u.webp\"]},\"scales\":{" +
               code_book("scale") + ",\"files\":[\"s.webp\"]},\"quats\":{\"files\":[\"q.webp\"]}," +
               "\"sh0\":{" + code_book("colour") + ",\"files\":[\"c.webp\"]}" +
               (degree == 0 ? ""
                            : ",\"shN\":{\"count\":" + std::to_string(palette) +
                                  ",\"bands\":" + std::to_string(degree) + "," + code_book("rest") +
                                  ",\"files\":[\"p.webp\",\"n.webp\"]}") +
               "}";
    }
    std::string meta_1() const {
        return "{\"means\":{\"shape\":[" + std::to_string(count) +
               ",3],\"mins\":[-1,-2,0.5],\"maxs\":[1,2,3.5],\"files\":[\"l.webp\",\"u.webp\"]},"
               "\"scales\":{\"mins\":[-9,-8,-7],\"maxs\":[-1,-2,-3],\"files\":[\"s.webp\"]},"
               "\"quats\":{\"files\":[\"q.webp\"]},\"sh0\":{\"mins\":[-2,-1,0,-5],"
               "\"maxs\":[2,1,3,5],\"files\":[\"c.webp\"]},\"shN\":{\"mins\":-0.5,\"maxs\":0.75,"
               "\"files\":[\"p.webp\",\"n.webp\"]}}";
    }

    ZipBuilder archive() const {
        ZipBuilder zip;
        const auto add = [&](const char* name, const Bytes& bytes) {
            zip.files.emplace_back(name, webp(bytes, width, height));
        };
        add("l.webp", low);
        add("u.webp", high);
        add("s.webp", scales);
        add("q.webp", quats);
        add("c.webp", sh0);
        if (degree > 0) {
            add("n.webp", labels);
            zip.files.emplace_back("p.webp", webp(centroids, 64 * rest(), 2));
        }
        zip.files.emplace_back("meta.json", meta);
        return zip;
    }
    std::string file() const { return archive().file(); }
};

inline SceneContent sog_content_of(const std::string& bytes) {
    const Folder folder;
    return read_sog(folder.write("scene.sog", bytes));
}

} // namespace degs::test
