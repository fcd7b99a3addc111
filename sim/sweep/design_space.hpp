// SPDX-License-Identifier: Apache-2.0
// The designs of a study as a space with an axis per dimension, whose points are built one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/config_document.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// A place in the space: which design of the study, then a position on each of its axes.
using Genes = std::vector<std::size_t>;

/// A dimension of the space.
struct Gene {
    std::size_t positions = 0;
    bool ordered = false; ///< the positions are numbers, so neighbours are alike
};

/// The product of whole numbers, or the largest there is.
std::uint64_t bounded_product(std::uint64_t a, std::uint64_t b);

class DesignSpace {
public:
    /// The position on an axis that leaves a design its own value.
    static constexpr std::size_t kOwn = -1;

    /// How many places the space of a study is going to have, before anything is loaded.
    static std::uint64_t size_of(const Study& study);

    /// Loads the designs, and puts the keys of the axes into the plan. Both outlive this object.
    /// Throws InputError for mistakes in designs, axes and overrides.
    DesignSpace(const Study& study, StudyPlan& plan);

    /// The designs as they stand.
    std::vector<NamedConfig> designs() const;
    const std::vector<Gene>& genes() const { return genes_; }
    /// Whether every value of an axis is combined with every value of the others.
    bool is_product() const { return !study_.one_at_a_time; }
    /// How many places there are, or the largest number.
    std::uint64_t size() const { return size_of(study_); }
    /// All places, one design after the other, the last axis fastest.
    std::vector<Genes> places() const;

    struct Added {
        std::optional<std::size_t> variant; ///< of the plan; empty for what cannot be built
        bool is_new = false;
        std::string name{};
    };
    /// Builds what is at a place, unless the plan has a design of the same name.
    Added add(const Genes& place);
    /// Puts the baseline as it stands in front of the plan, unless the plan has it. Variants that
    /// were added before may move. Throws InputError if no design is called like the baseline.
    void add_baseline();
    /// The design of this name as it stands; nothing if there is none.
    void add_design(const std::string& name);

private:
    /// A design that loads as it stands, with its keys and their values.
    struct LoadedDesign {
        std::string name;
        ConfigNode tree;
        std::vector<std::string> overrides;
        RunConfig config;
        std::map<std::string, KeyDoc> keys;       ///< by path
        std::map<std::string, std::string> files; ///< see own_file(), by key of an axis
    };

    static LoadedDesign load(const StudyDesign& design, const std::vector<std::string>& overrides);
    static const KeyDoc& key_of(const LoadedDesign& design, const std::string& path,
                                const std::string& place);
    void add_axis(const Axis& axis);
    std::string own_file(const LoadedDesign& design, const Axis& axis, std::size_t k,
                         const std::string& section);
    const ConfigNode& file_of(const LoadedDesign& design, const std::string& section,
                              const AxisValue& value);
    template <class Change>
    void for_each_change(const Genes& place, const Change& change) const;
    void note_memory(const RunConfig& config, StudyVariant& variant) const;
    StudyVariant variant(const LoadedDesign& design,
                         const std::map<std::string, std::string>& texts) const;

    const Study& study_;
    StudyPlan& plan_;
    std::vector<LoadedDesign> designs_;
    std::vector<Gene> genes_;
    std::map<std::string, ConfigNode> files_;                    ///< that axes include, by path
    std::map<std::string, std::string> places_;                  ///< of the axes in files, by key
    std::map<std::string, std::optional<std::size_t>> variants_; ///< of the plan, by name
};

} // namespace degs::sim
