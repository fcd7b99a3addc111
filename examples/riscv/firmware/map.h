/* SPDX-License-Identifier: Apache-2.0 */
/* Where things are for the processor, and what the platform leaves for the firmware at BOOT_TABLE. link.ld has the
 * core's own memory, too. */
#ifndef MAP_H
#define MAP_H

#include <stdint.h>

#define REGISTERS  0x10000000u /* of the accelerator */
#define CONSOLE    0x20000000u /* write: a character */
#define EXIT       0x20000004u /* write: ends the simulation with this status */
#define BOOT_TABLE 0x80000000u /* at the start of the memory that the accelerator uses, too */

#define MOST_FRAMES 16

/* Words of 32 bits and doubles in aligned places, so that host and firmware agree on it. */
typedef struct view {
    double focal_x, focal_y, axes[9], position[3], shift_x, shift_y;
    uint32_t width, height, origin_x, origin_y;
} view;

typedef struct boot_table {
    view views[MOST_FRAMES];
    uint32_t geometry, sh, count, sh_degree;
    uint32_t workspace, workspace_bytes, frame_buffer, frames;
} boot_table;

#endif
