// SPDX-License-Identifier: Apache-2.0
// Statistics as a block sees them: a struct of counters that describes its own numbers. Printing
// and documenting them is statistics_document.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace degs {

/// Empty where a number does not exist for a run.
using StatValue = std::variant<std::monostate, bool, std::uint64_t, double, std::string,
                               std::vector<std::uint64_t>>;

/// What a statistic means. The three texts are literals.
struct StatDoc {
    const char* name;     ///< key in results: words joined by '_'
    const char* unit;     ///< "cycles"; "share" is 0 to 1; empty for a text or a truth value
    const char* sentence; ///< what is counted
};

/// Walks the numbers of a result. A struct of counters describes itself once,
///     void Stats::describe(StatsVisitor& v) const {
///         v.count("rows", rows, "rows", "Rows of splats that were solved.");
///     }
/// and reports, tables of the manual, sums over units and error messages all use that description.
class StatsVisitor {
public:
    StatsVisitor() = default;
    StatsVisitor(const StatsVisitor&) = default;
    StatsVisitor& operator=(const StatsVisitor&) = default;
    virtual ~StatsVisitor() = default;

    /// A group of statistics; every begin has its end.
    virtual void begin_section(const std::string& name, const std::string& sentence) = 0;
    virtual void end_section() = 0;
    virtual void statistic(const StatDoc& doc, const StatValue& value) = 0;
    /// A whole number of which several units of a kind report the largest, not the sum.
    virtual void peak(const StatDoc& doc, std::uint64_t value) { statistic(doc, value); }
    /// Whether to describe a part that only some runs have: values are listed only if the part
    /// exists, the manual lists all.
    virtual bool wants(bool exists) const { return exists; }

    /// A whole number; several units of a kind report the sum.
    void count(const char* name, std::uint64_t value, const char* unit, const char* sentence) {
        statistic({name, unit, sentence}, value);
    }
    void count(const char* name, const std::optional<std::uint64_t>& value, const char* unit,
               const char* sentence) {
        statistic({name, unit, sentence}, value ? StatValue(*value) : StatValue());
    }
    void peak(const char* name, std::uint64_t value, const char* unit, const char* sentence) {
        peak(StatDoc{name, unit, sentence}, value);
    }
    void real(const char* name, const std::optional<double>& value, const char* unit,
              const char* sentence) {
        statistic({name, unit, sentence}, value ? StatValue(*value) : StatValue());
    }
    void text(const char* name, const std::string& value, const char* sentence) {
        statistic({name, "", sentence}, value);
    }
    void truth(const char* name, bool value, const char* sentence) {
        statistic({name, "", sentence}, value);
    }
    void list(const char* name, const std::vector<std::uint64_t>& values, const char* unit,
              const char* sentence) {
        statistic({name, unit, sentence}, values);
    }
    /// A number, or a whole section, that does not exist for this run.
    void nothing(const char* name, const char* sentence) { statistic({name, "", sentence}, {}); }
    template <class Part>
    void section(const std::string& name, const Part& part, const std::string& sentence) {
        begin_section(name, sentence);
        part.describe(*this);
        end_section();
    }
};

/// Whole numbers with their meaning: what the units of one kind have counted together.
class Counters final : public StatsVisitor {
public:
    struct Counter {
        StatDoc doc;
        std::uint64_t value;
    };

    /// Adds what every unit has counted: pointers to modules with stats().
    template <class Units>
    Counters& add(const Units& units) {
        for (const auto& unit : units) {
            unit->stats().describe(*this);
        }
        return *this;
    }
    void describe(StatsVisitor& visitor) const;
    auto begin() const { return counters_.begin(); }
    auto end() const { return counters_.end(); }

    /// Both throw std::logic_error: counters of units have no sections.
    void begin_section(const std::string& name, const std::string& sentence) override;
    void end_section() override;
    /// Whole numbers only, else std::logic_error.
    void statistic(const StatDoc& doc, const StatValue& value) override;
    using StatsVisitor::peak;
    void peak(const StatDoc& doc, std::uint64_t value) override;

private:
    std::uint64_t& counter(const StatDoc& doc);
    std::vector<Counter> counters_; // in the order of their description
};

/// What a single unit has counted.
template <class Stats>
Counters counters_of(const Stats& stats) {
    Counters counters;
    stats.describe(counters);
    return counters;
}

} // namespace degs
