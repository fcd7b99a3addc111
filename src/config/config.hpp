// SPDX-License-Identifier: Apache-2.0
// The configuration as a module sees it: a struct with defaults that describes its own keys.
// Reading files is config_source.hpp, printing and documenting is config_document.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "degs/error.hpp"

namespace degs {

/// A rule between keys, which no range can say. Keys are relative to the section that requires it
/// and may name one further down ("span.count").
struct ConfigRule {
    const char* key;                      ///< whose value is to change
    std::string rule;                     ///< what it has to fulfil: "must divide span.count"
    std::string remedy;                   ///< a value that would do; empty if `rule` names it
    std::vector<const char*> others = {}; ///< the other keys that decide
};

/// Where a text was written, for a struct that reads more out of it than its letters.
struct ConfigOrigin {
    std::string place;  ///< begins a sentence about it: "my.yaml:7: key 'pipeline.numbers'"
    std::string folder; ///< in which a path in it is looked up; empty: where the program started
};

/// Walks the fields of a configuration struct. A struct describes itself once,
///     void describe(ConfigVisitor& v) { v.integer("rows", rows, 1, 64, "rows per cycle"); }
/// and reading, validating, printing and documenting all use that one description. `describe` may
/// branch on a value that it has just visited (a choice of accelerator, say), because a reader has
/// set it by then.
class ConfigVisitor {
public:
    ConfigVisitor() = default;
    ConfigVisitor(const ConfigVisitor&) = delete;
    ConfigVisitor& operator=(const ConfigVisitor&) = delete;
    virtual ~ConfigVisitor() = default;
    /// Begins a nested mapping; every begin has its end. `doc` describes the section.
    virtual void begin_section(const char* key, const char* doc) = 0;
    virtual void end_section() = 0;
    /// Both bounds belong to the range. `doc` starts with the unit and gives the reason for the
    /// default.
    virtual void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                         const char* doc) = 0;
    virtual void real(const char* key, double& value, double low, double high, const char* doc) = 0;
    virtual void boolean(const char* key, bool& value, const char* doc) = 0;
    virtual void text(const char* key, std::string& value, const char* doc) = 0;
    /// Says how the text `key`, visited before, is spelled: a regular expression for all of it, and
    /// in words what is allowed. It is for those who describe configurations; who describes the key
    /// checks the text as well.
    virtual void spelled(const char* key, const std::string& expression,
                         const std::string& allowed) {
        (void)key, (void)expression, (void)allowed;
    }
    /// The origin of the value of `key`, visited before.
    virtual ConfigOrigin origin(const char* key) const {
        return {std::string("key '") + key + "'", ""};
    }
    /// Says that `key`, a value or a section, is one no more. A reader refuses it all the same, and
    /// its sentence ends with `advice`: what to say in its place.
    virtual void replaced(const char* key, const char* advice) { (void)key, (void)advice; }
    /// `value` is an index into `names`.
    virtual void choice(const char* key, int& value, const std::vector<const char*>& names,
                        const char* doc) = 0;
    /// Stands after the keys that the rule looks at. A reader refuses what does not hold, once
    /// every single value is known to be right.
    virtual void require(bool holds, const ConfigRule& rule) { (void)holds, (void)rule; }
    /// The rule that the integer `key` must be at least `least`; `reason` follows the number: "to
    /// hold one tile".
    void require_at_least(const char* key, std::int64_t value, std::int64_t least,
                          const std::string& reason, const std::vector<const char*>& others) {
        require(value >= least,
                {key, "must be at least " + std::to_string(least) + " " + reason, "", others});
    }

    /// The rule that the integer `key`, above 0, must be a power of two.
    void require_power_of_two(const char* key, int value) {
        int below = 1;
        while (below <= value / 2) {
            below *= 2;
        }
        require(value == below, {key, "must be a power of two", std::to_string(below)});
    }

    /// A design that can be built, but whose parts are out of proportion: the same as a rule, but a
    /// reader only warns. `rule` completes "but": "should be at least 2 to fill a packet".
    virtual void advise(bool in_proportion, const ConfigRule& rule) {
        (void)in_proportion, (void)rule;
    }
    /// A design that can be built, but in which a part of a value is of no use. A reader warns only
    /// if an override or a study gives the key: then somebody expects that it has an effect.
    virtual void advise_if_set(bool of_use, const ConfigRule& rule) { (void)of_use, (void)rule; }

    /// Says that `key`, a value or a section, has no effect while `decider` has its present value;
    /// both are of this section and visited before. `reason` completes "has no effect, because". A
    /// reader warns if the source gives the key another value than its default, unless what names
    /// the decider was written over it.
    virtual void unused(const char* key, const char* decider, const char* reason) {
        (void)key, (void)decider, (void)reason;
    }

    /// Says that sections `keys` of the section `section` of this one, as far as they were not
    /// visited, are those of other structs, which may stand in a file that both include. A reader
    /// does not look at them, and warns if an override gives a key of theirs. `reason` completes
    /// "has no effect, because".
    virtual void of_others(const char* section, const std::vector<const char*>& keys,
                           const char* reason) {
        (void)section, (void)keys, (void)reason;
    }

    /// True if this visitor also goes through sections that only another choice would use: those
    /// who read and document do, so that every key is known; who writes a configuration down does
    /// not.
    virtual bool visits_unused() const { return true; }

    void integer(const char* key, int& value, int low, int high, const char* doc) {
        std::int64_t wide = value;
        integer(key, wide, low, high, doc);
        value = static_cast<int>(wide);
    }
    template <class Enum>
    void choice(const char* key, Enum& value, const std::vector<const char*>& names,
                const char* doc) {
        int index = static_cast<int>(value);
        choice(key, index, names, doc);
        value = static_cast<Enum>(index);
    }
    template <class Section>
    void section(const char* key, Section& part, const char* doc) {
        begin_section(key, doc);
        part.describe(*this);
        end_section();
    }
};

} // namespace degs
