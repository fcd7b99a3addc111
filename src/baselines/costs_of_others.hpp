// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config_source.hpp"
#include "degs/design.hpp"

namespace degs {

/// A file of cost constants has the rows of all accelerators, of which `design`, loaded from
/// `source`, reads its own. Throws InputError for a mistake in the rows of the others, as it would
/// for a design of theirs.
void check_costs_of_others(const ConfigSource& source, const Design& design);

} // namespace degs
