// SPDX-License-Identifier: Apache-2.0
// Overrides of several designs: "path=value" for all, "NAME:path=value" for one.
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// The overrides that concern the design of this name, each as "path=value".
std::vector<std::string> overrides_of(const std::string& name,
                                      const std::vector<std::string>& overrides);

/// Throws InputError for an override of a name that is not among `names`.
void check_addressees(const std::vector<std::string>& overrides,
                      const std::vector<std::string>& names);

/// The path of an override without addressee, "a.b" of "a.b=1".
std::string override_path(const std::string& override_text);

} // namespace degs::sim
