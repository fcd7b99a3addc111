// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/number_set.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "config/config_document.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

TEST(NumberSets, GoByName) {
    EXPECT_EQ(number_set_names().size(), 5U);
    for (const std::string& name : number_set_names()) {
        const NumberSet set = number_set(name);
        EXPECT_EQ(set.name, name);
        EXPECT_FALSE(set.meaning.empty());
    }
    try {
        number_set("best");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "There is no number set 'best'; there are ideal, fp32, fp16, "
                                   "paper, tuned.");
    }
}

// What `tuned` may spend: the 32 B of the splat record, and words of 16 bits between the units.
TEST(NumberSets, RecordsStandForTheirSixFormats) {
    EXPECT_EQ(with_record_formats({"alpha=fp16", "records=fp16"}),
              (std::vector<std::string>{"alpha=fp16", "gaussian_mean=fp16", "gaussian_scale=fp16",
                                        "gaussian_rotation=fp16", "gaussian_opacity=fp16",
                                        "sh_dc=fp16", "sh_rest=fp16"}));
    EXPECT_EQ(with_record_formats({"records=fp32"}), std::vector<std::string>());
    EXPECT_EQ(number_set("tuned", {"records=tuned"}).name, "tuned records=tuned");
    EXPECT_THROW(number_set("tuned", {"records=small"}), InputError);
}

TEST(NumberSets, TunedHasTheBudgetOfPaper) {
    const NumberSet paper = number_set("paper");
    const NumberSet tuned = number_set("tuned");
    for (const NumberSet& set : {paper, tuned}) {
        EXPECT_LE(record_bits(set), 256) << set.name;
        for (const NumberFormat& word : {set.g0, set.d0, set.conic, set.q, set.alpha, set.colour,
                                         set.exp.values, set.sqrt.values}) {
            EXPECT_EQ(word.storage_bits(), 16) << set.name << " " << word.name();
        }
        // A pixel of the DeGS configurations (pixel_buffer.state_bytes).
        EXPECT_LE(pixel_bits(set), 128) << set.name;
    }
    const auto table_bits = [](const TableSpec& table) {
        return table.entries * table.values.storage_bits() *
               (table.interpolation == Interpolation::Linear ? 2 : 1);
    };
    EXPECT_LE(table_bits(tuned.exp), table_bits(paper.exp));
    EXPECT_LE(table_bits(tuned.sqrt), table_bits(paper.sqrt));
}

TEST(NumberSets, RecordsAddUp) {
    int bits = 0;
    std::set<std::string> names;
    for (const RecordField& field : splat_record(number_set("paper"))) {
        bits += field.bits;
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
    }
    // mu 2 x 24; m, r_x, 1/r_y^2, A, Q_th, C', B, depth 8 x 16; colour 3 x 16; id 32.
    EXPECT_EQ(bits, 48 + 128 + 48 + 32);
    EXPECT_EQ(record_bits(number_set("paper")), bits);
}

TEST(NumberSets, RangesFitTheirQuantities) {
    const NumberSet tuned = number_set("tuned");
    const double half_log2e = 0.5 / std::log(2.0);
    // A <= 1/0.3 by dilation, log2 255 for q, d0 within one pixel of both ends of the ellipse.
    const double a = half_log2e / 0.3;
    EXPECT_GT(tuned.conic.max(), a);
    EXPECT_GT(tuned.q.max(), tuned.q_limit());
    EXPECT_GT(tuned.d0.max(), 2 * std::sqrt(a * tuned.q_limit()) + a);
    EXPECT_GT(tuned.q_threshold.max(), std::log2(255.0));
    // sigma of 16 000 px keeps all bits of A.
    EXPECT_LT(tuned.conic.min_normal(), half_log2e / (13000.0 * 13000.0));
}

std::string value_of(const NumberSet& set, const std::string& key) {
    return resolved(set).at(nlohmann::ordered_json::json_pointer("/" + key));
}

// Whatever describe() names as a format is what uniform sets fill, what changes by name change, and
// what a record has fields for.
TEST(NumberSets, EveryStageIsInEveryUse) {
    const NumberSet half = number_set("fp16");
    int stages = 0, stored = 0;
    for (const KeyDoc& key : document(half)) {
        if (key.doc.rfind("format: ", 0) != 0 || key.path.find('.') != std::string::npos) {
            continue;
        }
        SCOPED_TRACE(key.path);
        if (key.path != "projection" && NumberSet::makes_splats(key.path)) {
            ++stored; // in the scene or in lists, no stage of the data path
            EXPECT_EQ(value_of(number_set("fp16", {key.path + "=e7m12"}), key.path), "e7m12");
            continue;
        }
        ++stages;
        EXPECT_EQ(value_of(half, key.path), key.path == "projection" ? "fp32" : "fp16");
        const NumberSet changed = number_set("fp16", {key.path + "=e7m12"});
        EXPECT_EQ(value_of(changed, key.path), "e7m12");
        EXPECT_EQ(changed.name, "fp16 " + key.path + "=e7m12");
    }
    EXPECT_EQ(stages, 22);
    EXPECT_EQ(stored, 7);
    for (const char* table : {"sqrt", "exp"}) {
        const NumberSet changed = number_set("fp16", {std::string(table) + ".values=e7m12"});
        EXPECT_EQ(value_of(changed, std::string(table) + "/values"), "e7m12");
    }
}

// Formats that are the same in every set are those nobody fills.
TEST(NumberSets, EveryFormatOfTheStructIsAStage) {
    NumberSet set;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(&set);
    std::set<std::ptrdiff_t> places;
    for (const NumberStage& stage : number_stages()) {
        places.insert(reinterpret_cast<const unsigned char*>(&(set.*stage.format)) - bytes);
    }
    const auto first = reinterpret_cast<const unsigned char*>(&set.projection) - bytes;
    const auto last = reinterpret_cast<const unsigned char*>(&set.sum) - bytes;
    EXPECT_EQ(*places.begin(), first);
    EXPECT_EQ(*places.rbegin(), last);
    EXPECT_EQ(places.size(), static_cast<std::size_t>(last - first) / sizeof(NumberFormat) + 1);
}

} // namespace
} // namespace degs
