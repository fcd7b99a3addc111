// SPDX-License-Identifier: Apache-2.0
// SOG scenes whose scales or opacities look as if they had been activated already.
#include <algorithm>

#include "tests/scene/sog/sog_builder.hpp"

namespace degs {
namespace {

using test::SogBuilder;

// Version 1 has the bounds of positions and scales in its meta.json; positions are logarithms, too.
TEST(ActivatedSog, ScalesAreAWarning) {
    const auto says = [](const std::string& means, const std::string& scales) {
        SogBuilder made;
        made.make_version_1();
        const auto put = [&](const std::string& before, const std::string& after) {
            const std::size_t at = made.meta.find(before);
            ASSERT_NE(at, std::string::npos);
            made.meta.replace(at, before.size(), after);
        };
        put("\"mins\":[-1,-2,0.5],\"maxs\":[1,2,3.5]", means);
        put("\"mins\":[-9,-8,-7],\"maxs\":[-1,-2,-3]", scales);
        const std::vector<std::string> notes = test::sog_content_of(made.file()).notes;
        return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("hold its scales as they are") != std::string::npos;
        });
    };
    const std::string small = "\"mins\":[-1,-1,-1],\"maxs\":[1,1,1]";    // e - 1 units to each side
    const std::string large = "\"mins\":[-5,-5,-5],\"maxs\":[5,5,5]";    // 147 units
    const std::string sizes = "\"mins\":[0.2,0.2,0.2],\"maxs\":[2,2,2]"; // or logarithms
    const std::string tiny = "\"mins\":[0.001,0.001,0.001],\"maxs\":[0.05,0.05,0.05]";
    EXPECT_TRUE(says(small, sizes));
    EXPECT_FALSE(says(large, sizes));
    EXPECT_TRUE(says(large, tiny));
    EXPECT_FALSE(says(small, "\"mins\":[-9,-8,-7],\"maxs\":[2,2,2]"));
}

// Version 1 has logits of opacities. Version 2 has shares, of which any are right.
TEST(ActivatedSog, OpacitiesOfVersion1AreAWarning) {
    const auto says = [](SogBuilder made, const std::string& before, const std::string& after) {
        made.meta.replace(made.meta.find(before), before.size(), after);
        const std::vector<std::string> notes = test::sog_content_of(made.file()).notes;
        return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("hold its opacities as they are") != std::string::npos;
        });
    };
    SogBuilder old;
    old.make_version_1();
    const std::string bounds = "\"mins\":[-2,-1,0,-5],\"maxs\":[2,1,3,5]";
    EXPECT_TRUE(says(old, bounds, "\"mins\":[-2,-1,0,0],\"maxs\":[2,1,3,1]"));
    EXPECT_FALSE(says(old, bounds, "\"mins\":[-2,-1,0,0],\"maxs\":[2,1,3,4]"));
    EXPECT_FALSE(says(old, bounds, bounds));
    SogBuilder shares;
    for (int i = 0; i < shares.width * shares.height; ++i) {
        shares.sh0[4 * i + 3] = 150;
    }
    EXPECT_FALSE(says(shares, "}", "}"));
}

} // namespace
} // namespace degs
