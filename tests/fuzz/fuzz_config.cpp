// SPDX-License-Identifier: Apache-2.0
// Configurations: the input is YAML, read into a struct that has every kind of key.
#include "config/config.hpp"
#include "config/config_source.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

enum class Shade { Light, Dark };

struct Everything {
    struct Part {
        int count = 3;
        double share = 0.5;
        void describe(degs::ConfigVisitor& visitor) {
            visitor.integer("count", count, 1, 64, "units");
            visitor.real("share", share, 0, 1, "of all");
            visitor.require(count != 13, {"count", "must not be 13", "12"});
        }
    };
    std::string name = "plain";
    bool on = true;
    Shade shade = Shade::Light;
    Part part;

    void describe(degs::ConfigVisitor& visitor) {
        visitor.text("name", name, "in reports");
        visitor.boolean("on", on, "works at all");
        visitor.choice("shade", shade, {"light", "dark"}, "of grey");
        visitor.section("part", part, "of the whole");
        if (!on) {
            visitor.unused("part", "on", "it is off");
        }
    }
};

} // namespace

void degs::fuzz::run(std::string_view bytes) {
    const std::string text(bytes);
    read_or_refuse([&text] {
        Everything config;
        const ConfigSource source = ConfigSource::from_text(folder() / "a.yaml", text);
        source.load(config);
        if (config.part.count < 1 || config.part.count > 64 ||
            !(config.part.share >= 0 && config.part.share <= 1)) {
            fail("a value outside its range was accepted");
        }
    });
    // The input once more as the text of an override on a command line.
    read_or_refuse([&text] {
        Everything config;
        ConfigSource::from_overrides({text}).load(config);
    });
}
