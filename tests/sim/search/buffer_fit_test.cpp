// SPDX-License-Identifier: Apache-2.0
// The smallest buffers, of a design whose losses are made up, and of a real one.
#include "sim/search/buffer_fit.hpp"

#include <cmath>

#include "degs/error.hpp"
#include "sim/search/design_study.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

/// Leads a fit through a design whose loss in percent is the sum of those of its buffers: what each
/// loses for every halving below a size that it needs. At most 1 may be lost.
struct MadeUp {
    StudyPlan plan;
    Study study;
    std::vector<double> needed; ///< by axis, shares of its own size

    double loss(const std::vector<std::string>& values) const {
        double loss = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double share = std::stod(values[k]) / std::stod(plan.variants[0].values[k]);
            loss += std::max(0.0, std::log2(needed[k] / share));
        }
        return loss;
    }
    StepResults results_of(const Step& step) const {
        StepResults results;
        for (const std::size_t variant : step.variants) {
            Candidate candidate{variant, {}};
            candidate.verdict.goals = {1};
            candidate.verdict.judged = true;
            const double lost = loss(plan.variants[variant].values);
            candidate.verdict.limits = {{1 - lost / 100, 0.99}};
            if (lost > 1) {
                candidate.verdict.broken = {"too slow"};
            }
            results.candidates.push_back(candidate);
        }
        return results;
    }
};

/// Whether a design with buffers of these sizes can be built.
bool can_be_built(const std::vector<Axis>& axes, const std::vector<std::string>& values) {
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        settings.push_back(axes[k].name + "=" + values[k]);
    }
    try {
        load_run_config(config("degs-64"), settings);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

void expect_none_smaller(const MadeUp& made, const std::vector<std::string>& values,
                         const std::vector<Axis>& axes) {
    EXPECT_LE(made.loss(values), 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
        std::vector<std::string> smaller = values;
        const auto& positions = axes[k].positions;
        for (std::size_t p = 0; p + 1 < positions.size(); ++p) {
            if (positions[p].front().text == values[k]) {
                smaller[k] = positions[p + 1].front().text;
            }
        }
        EXPECT_TRUE(smaller == values || made.loss(smaller) > 1 || !can_be_built(axes, smaller))
            << axes[k].name;
    }
}

TEST(BufferFit, EndsWhereNoBufferCanBeSmallerAlone) {
    const Folder folder;
    std::ofstream(folder / "s.yaml") << "designs:\n  - include: " << config("degs-64")
                                     << "\n    name: a\nscenes: synthetic:object,gaussians=10\n"
                                        "width: 16\n";
    for (const std::vector<double>& needed : std::vector<std::vector<double>>{
             {1, 1, 1, 1, 1}, {0.1, 0.3, 0.6, 1.5, 0.05}, {0.25, 0.25, 0.25, 0.25, 0.25}}) {
        MadeUp made{
            {}, study_of_designs(read_study(folder / "s.yaml"), "s.yaml", "a test"), needed};
        made.study.axes = buffer_axes(first_design(made.study), {});
        ASSERT_EQ(made.study.axes.size(), needed.size());
        made.plan = plan_views(made.study);
        DesignSpace space(made.study, made.plan);
        space.add_baseline();
        BufferFit fit(space, made.plan);
        int steps = 0;
        while (const std::optional<Step> step = fit.next()) {
            fit.take(made.results_of(*step));
            ASSERT_LT(++steps, 100);
        }
        const StudyVariant& found = made.plan.variants[fit.smallest()];
        expect_none_smaller(made, found.values, made.study.axes);
        EXPECT_LT(fit.simulated(), 60U);
    }
}

TEST(BufferFit, LeavesOutWhatIsFixed) {
    const RunConfig design = load_run_config(config("degs-64"), {});
    const std::vector<Axis> axes = buffer_axes(design, {"packing.bytes"});
    EXPECT_EQ(axes.size(), 4U);
    for (const Axis& axis : axes) {
        EXPECT_NE(axis.name, "packing.bytes");
        EXPECT_EQ(axis.name.substr(axis.name.size() - 6), ".bytes");
    }
    EXPECT_EQ(axes[0].positions[1].front().text, "55296"); // 3/4 of 72 KB
    EXPECT_EQ(axes[0].positions[2].front().text, "36864");
}

double cycles_with(const std::vector<std::string>& settings) {
    const Folder folder;
    std::vector<std::string> words{"run",           config("degs-64"),
                                   "--scene",       "synthetic:object,gaussians=600",
                                   "--camera",      "2",
                                   "--width",       "160",
                                   "--out",         folder / "out",
                                   "--no-reference"};
    for (const std::string& setting : settings) {
        words.insert(words.end(), {"--set", setting});
    }
    expect_success(degs(words));
    return report_in(folder / "out")["timing"]["cycles"].get<double>();
}

TEST(BuffersCommand, GivesADesignThatLosesAtMostWhatIsAllowed) {
    const Folder folder;
    const Outcome outcome =
        degs({"buffers", config("degs-64"), "--scene", "synthetic:object,gaussians=600", "--camera",
              "2", "--width", "160", "--lose", "2", "--jobs", "2", "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto found = nlohmann::json::parse(read_file(folder / "out/buffers.json"));
    EXPECT_LT(found["smallest_bytes"], found["bytes"]);
    const std::vector<std::string> settings = found["settings"];
    ASSERT_FALSE(settings.empty());
    const double loss = 1 - cycles_with({}) / cycles_with(settings);
    EXPECT_LE(loss, 0.02);
    EXPECT_NEAR(loss, found["loss"].get<double>(), 1e-9);
    EXPECT_NE(outcome.out.find("--set " + settings.front()), std::string::npos) << outcome.out;
    expect_mistake(degs({"buffers", config("degs-64"), "--scene", "synthetic:single", "--fidelity",
                         "analytic"}),
                   "simulates");
}

} // namespace
} // namespace degs::sim_test
