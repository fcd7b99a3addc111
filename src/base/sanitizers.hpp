// SPDX-License-Identifier: Apache-2.0
#pragma once

// DEGS_ADDRESS_SANITIZER: 1 in a build with the address sanitizer, which g++ tells by a macro and
// clang by a feature, and 0 in others.
#ifdef __SANITIZE_ADDRESS__
#define DEGS_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DEGS_ADDRESS_SANITIZER 1
#endif
#endif
#ifndef DEGS_ADDRESS_SANITIZER
#define DEGS_ADDRESS_SANITIZER 0
#endif
