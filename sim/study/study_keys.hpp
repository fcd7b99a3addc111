// SPDX-License-Identifier: Apache-2.0
// The keys of a study, which its reader and its schema share.
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

enum class StudyKind {
    kText,
    kWords, ///< a word or a list of words, each as `pattern` if there is one
    kInteger,
    kReal,
    kBoolean,
    kChoice,
    kViews, ///< a section with those of the keys that stand in 'quick'
    kDesigns,
    kAxes,
};

struct StudyKey {
    const char* name;
    StudyKind kind;
    const char* doc;
    const char* default_value = ""; ///< as it is written in a file; empty: none
    double low = 0, high = 0;       ///< of numbers
    std::vector<const char*> words = {};
    bool in_quick = false; ///< may stand in the section 'quick'
    bool of_sweep = false; ///< nothing that `degs compare` could do
    std::string pattern = {};
};

const std::vector<StudyKey>& study_keys();
/// The key with this name, which exists.
const StudyKey& study_key(const std::string& name);

} // namespace degs::sim
