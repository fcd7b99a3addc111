/* SPDX-License-Identifier: Apache-2.0 */
/* What a compiler calls in a freestanding program, too. */
#include <stddef.h>

void *memcpy(void *to, const void *from, size_t bytes);
void *memcpy(void *to, const void *from, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i) {
        ((unsigned char *)to)[i] = ((const unsigned char *)from)[i];
    }
    return to;
}

void *memset(void *to, int value, size_t bytes);
void *memset(void *to, int value, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i) {
        ((unsigned char *)to)[i] = (unsigned char)value;
    }
    return to;
}
