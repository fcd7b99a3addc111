// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog_levels.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "base/grouped_number.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

/// The finest run of a leaf that is not finer than `level`, else its coarsest; leaves are not
/// empty.
const SogRun& run_at(const SogLeaf& leaf, int level) {
    const auto at = leaf.lower_bound(level);
    return at == leaf.end() ? leaf.rbegin()->second : at->second;
}

std::uint64_t total_at(const std::vector<SogLeaf>& leaves, int level) {
    std::uint64_t total = 0;
    for (const SogLeaf& leaf : leaves) {
        total += run_at(leaf, level).count;
    }
    return total;
}

/// Levels at which some leaf has Gaussians.
std::set<int> levels_of(const std::vector<SogLeaf>& leaves) {
    std::set<int> levels;
    for (const SogLeaf& leaf : leaves) {
        for (const auto& [level, run] : leaf) {
            levels.insert(level);
        }
    }
    return levels;
}

SogChoice one_level(const std::string& where, const std::vector<SogLeaf>& leaves, int level) {
    SogChoice choice;
    for (const SogLeaf& leaf : leaves) {
        if (const auto at = leaf.find(level); at != leaf.end()) {
            choice.runs.push_back(at->second);
        }
    }
    if (choice.runs.empty()) {
        std::string list;
        for (const int known : levels_of(leaves)) {
            list += (list.empty() ? "" : ", ") + std::to_string(known);
        }
        fail_file(where, "the scene has no level of detail " + std::to_string(level) +
                             "; allowed are " + list + ", of which the first is the finest.");
    }
    if (const std::size_t without = leaves.size() - choice.runs.size(); without > 0) {
        choice.notes.push_back(std::to_string(without) + " of the " +
                               std::to_string(leaves.size()) +
                               " parts of the scene have no Gaussians at level " +
                               std::to_string(level) + " and are not shown.");
    }
    return choice;
}

/// Gives as many leaves as the rest of the budget allows the next finer level.
void refine(const std::vector<SogLeaf>& leaves, int finer, std::uint64_t rest,
            std::vector<SogRun>& runs) {
    std::vector<std::pair<std::int64_t, std::size_t>> costs;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const auto more = static_cast<std::int64_t>(run_at(leaves[i], finer).count) -
                          static_cast<std::int64_t>(runs[i].count);
        costs.emplace_back(more, i);
    }
    std::sort(costs.begin(), costs.end());
    auto left = static_cast<std::int64_t>(std::min<std::uint64_t>(
        rest, std::numeric_limits<std::int64_t>::max() / 2)); // savings are added to it
    for (const auto& [more, leaf] : costs) {
        if (more > left) {
            return;
        }
        left -= more;
        runs[leaf] = run_at(leaves[leaf], finer);
    }
}

SogChoice within(const std::string& where, const std::vector<SogLeaf>& leaves, std::uint64_t budget,
                 std::uint64_t environment) {
    SogChoice choice;
    std::uint64_t smallest = std::numeric_limits<std::uint64_t>::max();
    int finer = -1;
    for (const int level : levels_of(leaves)) {
        const std::uint64_t total = total_at(leaves, level) + environment;
        smallest = std::min(smallest, total);
        if (total > budget) {
            finer = level;
            continue;
        }
        for (const SogLeaf& leaf : leaves) {
            choice.runs.push_back(run_at(leaf, level));
        }
        if (finer >= 0) {
            refine(leaves, finer, budget - total, choice.runs);
        }
        return choice;
    }
    fail_file(where, "a budget of " + grouped(budget) + " Gaussians is too small; allowed are " +
                         grouped(smallest) + " and more.");
}

/// Which levels a mix has, for whoever reads a report.
std::string mix_note(const std::vector<SogLeaf>& leaves, const std::vector<SogRun>& runs) {
    std::map<int, std::size_t> parts;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const auto same = [&](const auto& entry) {
            return entry.second.file == runs[i].file && entry.second.offset == runs[i].offset;
        };
        ++parts[std::find_if(leaves[i].begin(), leaves[i].end(), same)->first];
    }
    std::string list;
    for (const auto& [level, count] : parts) {
        list += (list.empty() ? "" : ", ") + std::to_string(count) + " at level " +
                std::to_string(level);
    }
    return "Within the budget the parts of the scene are shown at these levels of detail: " + list +
           ".";
}

} // namespace

SogChoice choose_sog_levels(const std::string& where, const SogIndex& index,
                            const SceneDetail& detail, std::uint64_t environment) {
    std::vector<SogLeaf> leaves = index.leaves;
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                                [](const SogLeaf& leaf) { return leaf.empty(); }),
                 leaves.end());
    if (detail.level) {
        return one_level(where, leaves, *detail.level);
    }
    const std::uint64_t budget = detail.budget.value_or(std::numeric_limits<std::uint64_t>::max());
    SogChoice choice = within(where, leaves, budget, environment);
    if (detail.budget) {
        choice.notes.push_back(mix_note(leaves, choice.runs));
    }
    return choice;
}

} // namespace degs
