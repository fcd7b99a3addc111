// SPDX-License-Identifier: Apache-2.0
// Files of sim/page/assets, which the build compiles in.
#pragma once

namespace degs::sim::page_assets {

extern const char* const kPage;   ///< page.html, with names of parts between @ signs
extern const char* const kStyle;  ///< page.css
extern const char* const kScript; ///< page.js
extern const char* const kD3;     ///< d3 (ISC licence, see d3.LICENSE), which Plot needs
extern const char* const kPlot;   ///< Observable Plot (ISC licence, see plot.LICENSE)

} // namespace degs::sim::page_assets
