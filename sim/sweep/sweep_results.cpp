// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/sweep_results.hpp"

#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "base/visible_text.hpp"
#include "sim/page/page.hpp"
#include "sim/report/report.hpp"
#include "sim/results/result_words.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/sweep/bandwidth_curve.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

constexpr const char* kCsv = "results.csv";
constexpr const char* kJson = "results.json";
constexpr const char* kHostCsv = "host.csv";
constexpr const char* kBandwidth = "bandwidth.svg";
constexpr std::size_t kMostShown = 10; ///< reasons on a terminal; the files have all

/// Columns that only some studies have.
struct MoreColumns {
    std::vector<std::string> stages, parts;
    bool intervals = false;
    std::vector<std::optional<Elasticity>> elasticity; ///< by row; empty: bandwidth is not varied

    /// With intervals, those of elasticities, too.
    std::string elasticity_headings() const {
        return elasticity.empty() ? ""
               : intervals        ? ",bandwidth_elasticity,bandwidth_elasticity.low,"
                                    "bandwidth_elasticity.high"
                                  : ",bandwidth_elasticity";
    }
    std::string elasticity_cells(std::size_t r) const {
        if (elasticity.empty()) {
            return "";
        }
        const std::optional<Elasticity>& here = elasticity[r];
        const auto cell = [](const std::optional<double>& value) {
            return "," + csv_number(value);
        };
        return cell(here ? std::optional(here->gain) : std::nullopt) +
               (intervals
                    ? cell(here ? here->low : std::nullopt) + cell(here ? here->high : std::nullopt)
                    : "");
    }
};

std::string csv_head(const StudyPlan& plan, const MoreColumns& more) {
    std::string text = "point,design";
    for (const std::string& key : plan.keys) {
        text += "," + csv_cell(key);
    }
    text += run_headings();
    for_each_measure([&](Measure m) { text += is_of_host(m) ? "" : "," + name_of(m); });
    text += ",limited_by";
    text += more.elasticity_headings();
    for (const std::string& stage : more.stages) {
        text += "," + csv_cell("stages." + stage + ".busy");
    }
    return text + part_headings(more.parts) + (more.intervals ? interval_headings() : "") +
           (plan.aims.limits.empty() ? "" : ",within") + "\n";
}

std::string csv_row(const StudyPlan& plan, const SweepResults& results, std::size_t r,
                    const MoreColumns& more) {
    const ComparisonRow& row = results.comparison.rows[r];
    const StudyVariant& variant = plan.variants[row.config];
    std::string text = std::to_string(results.points[r] + 1) + "," + csv_cell(variant.design);
    for (const std::string& value : variant.values) {
        text += "," + csv_cell(value);
    }
    text += run_cells(results.comparison, row);
    for_each_measure(
        [&](Measure m) { text += is_of_host(m) ? "" : "," + csv_number(row.measures[m]); });
    text += "," + csv_cell(row.limited_by);
    text += more.elasticity_cells(r);
    text += named_cells(row, &RunNumbers::stages, more.stages);
    text += named_cells(row, &RunNumbers::parts, more.parts) +
            (more.intervals ? interval_cells(row) : "");
    if (!plan.aims.limits.empty()) {
        text += "," + csv_cell(within_words(results.verdicts[row.config]));
    }
    return text + "\n";
}

std::string results_csv(const StudyPlan& plan, const SweepResults& results) {
    const std::vector<ComparisonRow>& rows = results.comparison.rows;
    const MoreColumns more{names_of(rows, &RunNumbers::stages), names_of(rows, &RunNumbers::parts),
                           any_interval(rows), elasticities(plan, results.comparison)};
    std::string text = csv_head(plan, more);
    for (std::size_t r = 0; r < results.comparison.rows.size(); ++r) {
        text += csv_row(plan, results, r, more);
    }
    return text;
}

std::string host_csv(const SweepResults& results) {
    std::string text = "point";
    for_each_measure([&](Measure m) { text += is_of_host(m) ? "," + name_of(m) : ""; });
    text += "\n";
    for (std::size_t r = 0; r < results.comparison.rows.size(); ++r) {
        text += std::to_string(results.points[r] + 1);
        for_each_measure([&](Measure m) {
            const auto& value = results.comparison.rows[r].measures[m];
            text += is_of_host(m) ? "," + csv_number(value) : "";
        });
        text += "\n";
    }
    return text;
}

ordered_json variant_json(const StudyPlan& plan, const StudyVariant& variant) {
    ordered_json json = {{"name", variant.name}, {"design", variant.design}};
    json["keys"] = ordered_json::object();
    for (std::size_t k = 0; k < plan.keys.size(); ++k) {
        json["keys"][plan.keys[k]] = variant.values[k];
    }
    return json;
}

ordered_json run_json(const SweepResults& results, std::size_t r,
                      const std::vector<std::optional<Elasticity>>& elasticity) {
    const ComparisonRow& row = results.comparison.rows[r];
    ordered_json json = {{"point", results.points[r] + 1},
                         {"variant", row.config},
                         {"view", row.view},
                         {"fidelity", row.fidelity}};
    for_each_measure([&](Measure m) {
        if (!is_of_host(m)) {
            put_measure(json, m, row.measures[m]);
        }
    });
    put_parts(json, row);
    put_interval(json, row);
    json["limited_by"] = row.limited_by;
    if (!elasticity.empty()) {
        const std::optional<Elasticity>& here = elasticity[r];
        json["bandwidth_elasticity"] = here ? number_json(here->gain) : ordered_json();
        if (here && here->low) {
            json["bandwidth_elasticity_interval"] = {number_json(here->low),
                                                     number_json(here->high)};
        }
    }
    json["stages"] = ordered_json::object();
    for (const auto& [name, busy] : row.stages) {
        json["stages"][name] = number_json(busy);
    }
    json["report"] = row.report;
    return json;
}

void put_lists(const StudyPlan& plan, const SweepResults& results, ordered_json& json) {
    for (const char* list : {"variants", "views", "runs", "skipped", "failed"}) {
        json[list] = ordered_json::array();
    }
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
        const ComparedConfig& config = results.comparison.configs[v];
        ordered_json variant = variant_json(plan, plan.variants[v]);
        variant["accelerator"] = plan.request.configs[v].config.kind();
        variant["pes"] = value_or_null(config.pes);
        variant["tile_size"] = value_or_null(config.tile_size);
        if (!plan.aims.limits.empty()) {
            variant["within"] = within_words(results.verdicts[v]);
        }
        json["variants"].push_back(std::move(variant));
    }
    for (const ComparedView& view : results.comparison.views) {
        json["views"].push_back(view_json(view));
    }
    const auto elasticity = elasticities(plan, results.comparison);
    for (std::size_t r = 0; r < results.comparison.rows.size(); ++r) {
        json["runs"].push_back(run_json(results, r, elasticity));
    }
    for (const SkippedVariant& skipped : plan.skipped) {
        json["skipped"].push_back(variant_json(plan, skipped.variant));
        json["skipped"].back()["why"] = skipped.why;
    }
    for (const FailedPoint& failed : results.failed) {
        json["failed"].push_back({{"point", failed.point + 1},
                                  {"variant", plan.points[failed.point].variant},
                                  {"why", failed.failure.sentence}});
    }
}

ordered_json results_json(const StudyPlan& plan, const SweepResults& results) {
    ordered_json json;
    json["schema"] = {{"name", "degs-sweep"}, {"version", kSweepVersion}};
    json["tool"] = tool_json();
    json["study"] = plan.name;
    json["digest"] = plan.digest;
    json["frames"] = plan.request.path.frames;
    json["path_step_degrees"] = plan.request.path.frames > 1
                                    ? ordered_json(plan.request.path.step_degrees)
                                    : ordered_json();
    json["array_only"] = plan.request.array_only;
    json["keys"] = plan.keys;
    json["baseline"] = plan.baseline;
    json["points"] = plan.points.size();
    json["missing"] = results.missing;
    put_lists(plan, results, json);
    return json;
}

std::string page_of(const StudyPlan& plan, const SweepResults& results) {
    PageFacts facts;
    facts.title = plan.name;
    facts.swept = true;
    facts.keys = plan.keys;
    for (const StudyPlan::LinkedAxis& axis : plan.linked) {
        facts.axes.push_back({axis.name, axis.keys});
    }
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
        const StudyVariant& variant = plan.variants[v];
        const DesignVerdict& verdict = results.verdicts[v];
        facts.variants.push_back({variant.design,
                                  {variant.values.begin(), variant.values.end()},
                                  verdict.goals,
                                  verdict.on_front,
                                  within_words(verdict)});
    }
    for (const Aim& goal : plan.aims.goals) {
        facts.goals.push_back({goal.name, goal.better == Direction::Maximise});
    }
    facts.limited = !plan.aims.limits.empty();
    for (std::size_t point : results.points) {
        facts.points.push_back(point + 1);
    }
    for (const SkippedVariant& skipped : plan.skipped) {
        facts.skipped.emplace_back(skipped.variant.name, skipped.why);
    }
    for (const FailedPoint& failed : results.failed) {
        facts.failed.emplace_back("point " + std::to_string(failed.point + 1),
                                  failed.failure.sentence);
    }
    facts.missing = results.missing;
    facts.spent = results.spent;
    facts.picture = bandwidth_picture(plan, results.comparison);
    return study_page(facts, results.comparison);
}

/// Sentences of one kind, as many as a terminal should show.
class Reasons {
public:
    explicit Reasons(std::string& text) : text_(text) {}
    void add(const std::string& line) {
        if (++count_ <= kMostShown) {
            text_ += visible(line) + "\n";
        }
    }
    ~Reasons() {
        if (count_ > kMostShown) {
            text_ += "... and " + std::to_string(count_ - kMostShown) + " more\n";
        }
    }
    Reasons(const Reasons&) = delete;
    Reasons& operator=(const Reasons&) = delete;

private:
    std::string& text_;
    std::size_t count_ = 0;
};

} // namespace

std::vector<std::string> sweep_files() {
    return {kJson, kCsv, kHostCsv, kPageFile, kBandwidth};
}

std::vector<std::string> search_files() {
    return {"explore.json", "front.csv", "front.svg", "beliefs.csv"};
}

SweepResults read_results(const StudyPlan& plan, const PointStore& store, Reports reports) {
    SweepResults results;
    std::vector<ComparedRun> runs;
    std::set<std::string> known;
    const std::vector<std::string> labels = scene_labels(plan.request.scenes);
    for (std::size_t p = 0; p < plan.points.size(); ++p) {
        std::optional<StoredPoint> found = store.read(p);
        if (reports == Reports::Put) {
            store.put_reports(p, found);
        }
        if (found) {
            found->frame.view.scene = labels[plan.points[p].scene];
            found->frame.report.clear(); // all of them would take much memory
            if (found->path) {
                found->path->report.clear();
            }
            for (const auto* list : {&found->frame.notes, &found->frame.warnings}) {
                for (const std::string& sentence : *list) {
                    if (known.insert(sentence).second) {
                        results.warnings.push_back(sentence);
                    }
                }
            }
            results.points.push_back(p);
            runs.push_back({plan.variants[plan.points[p].variant].name, std::move(found->frame),
                            std::move(found->path), PointStore::report_of(p)});
        } else if (const std::optional<Failure> failure = store.failure(p)) {
            results.failed.push_back({p, *failure});
        } else {
            ++results.missing;
            results.damaged += store.is_damaged(p) ? 1 : 0;
        }
    }
    std::vector<std::string> names;
    for (const StudyVariant& variant : plan.variants) {
        names.push_back(variant.name);
    }
    results.comparison = compare(names, runs, plan.baseline);
    results.comparison.frames = plan.request.path.frames;
    results.comparison.path_step_degrees = plan.request.path.step_degrees;
    results.comparison.array_only = plan.request.array_only;
    results.verdicts =
        judge(results.comparison, plan.points.size() / plan.variants.size(), plan.aims);
    return results;
}

void write_results(const StudyPlan& plan, const SweepResults& results, const OutputFolder& folder) {
    const auto write = [&] {
        folder.write_text(kCsv, results_csv(plan, results));
        folder.write_text(kHostCsv, host_csv(results));
        folder.write_json(kJson, results_json(plan, results));
        folder.write_text(kPageFile, page_of(plan, results));
        const std::string picture = bandwidth_picture(plan, results.comparison);
        if (!picture.empty()) {
            folder.write_text(kBandwidth, picture);
        }
    };
    std::vector<std::string> old;
    const std::vector<std::string> of_search = search_files();
    if (std::filesystem::exists(folder.path(of_search.front()))) { // else they may be the user's
        for (const std::string& file : of_search) {
            old.push_back(folder.path(file));
        }
    }
    folder.replace(write, old);
}

std::string results_text(const StudyPlan& plan, const SweepResults& results) {
    std::string text = visible(plan.name) + ": " + grouped(results.points.size()) + " of " +
                       grouped(plan.points.size()) + " points";
    if (!plan.skipped.empty()) {
        text += " · " + grouped(plan.skipped.size()) + " cannot be built";
    }
    if (!results.failed.empty()) {
        text += " · " + grouped(results.failed.size()) + " failed";
    }
    if (results.missing != 0) {
        text += " · " + grouped(results.missing) + " missing";
    }
    text += plan.request.analytic ? " · estimates of the analytic model, not simulations" : "";
    text += "\n";
    {
        Reasons reasons(text);
        for (const SkippedVariant& skipped : plan.skipped) {
            reasons.add("cannot be built: " + skipped.why);
        }
    }
    Reasons reasons(text);
    for (const FailedPoint& failed : results.failed) {
        reasons.add("failed: point " + std::to_string(failed.point + 1) + ": " +
                    failed.failure.sentence);
    }
    return text;
}

} // namespace degs::sim
