/* SPDX-License-Identifier: Apache-2.0 */
/* Registers of the DeGS accelerator: offsets in bytes, bits and values. Written by
 * degs registers --format c */
#ifndef DEGS_REGISTERS_H
#define DEGS_REGISTERS_H

#define DEGS_REGISTER_BYTES             0x214u /* size of the register window */
#define DEGS_ID_VALUE                   0x53476544u /* what ID holds */
#define DEGS_VERSION_VALUE              0x00010004u /* what VERSION holds */
#define DEGS_BASE_ALIGNMENT             64u /* of all addresses, bytes */

#define DEGS_REG_ID                     0x000u /* the bytes "DeGS" */

#define DEGS_REG_VERSION                0x004u /* major and minor, 16 bits each */

#define DEGS_REG_CONTROL                0x008u /* commands */
#define DEGS_CONTROL_START              (1u << 0) /* start a frame */
#define DEGS_CONTROL_CLEAR_ERROR        (1u << 1) /* clear the error and the flags "aborted" and "start ignored" */
#define DEGS_CONTROL_RESET              (1u << 2) /* reset; the other bits are ignored */
#define DEGS_CONTROL_ABORT              (1u << 3) /* give up the present frame */
#define DEGS_CONTROL_RESUME             (1u << 4) /* issue the access that has faulted again */

#define DEGS_REG_STATUS                 0x00Cu /* state */
#define DEGS_STATUS_BUSY                (1u << 0) /* a frame is being rendered */
#define DEGS_STATUS_DONE                (1u << 1) /* the last frame is done */
#define DEGS_STATUS_ERROR               (1u << 2) /* the last frame ended with an error */
#define DEGS_STATUS_START_IGNORED       (1u << 3) /* a start was ignored because the accelerator was busy */
#define DEGS_STATUS_IN_RESET            (1u << 4) /* a reset has not ended yet */
#define DEGS_STATUS_ABORTED             (1u << 5) /* the last frame has been given up */
#define DEGS_STATUS_FAULTED             (1u << 6) /* a refused access waits for RESUME or ABORT (an option of the model) */

#define DEGS_REG_IRQ_ENABLE             0x010u /* interrupts that reach irq */
#define DEGS_IRQ_ENABLE_DONE            (1u << 0) /* a frame is done */
#define DEGS_IRQ_ENABLE_ERROR           (1u << 1) /* a frame ended with an error */
#define DEGS_IRQ_ENABLE_ABORTED         (1u << 2) /* a frame has been given up */
#define DEGS_IRQ_ENABLE_FAULT           (1u << 3) /* an access waits for software */

#define DEGS_REG_IRQ_STATUS             0x014u /* pending interrupts; writing 1 clears; irq is high while an enabled bit is set */
#define DEGS_IRQ_STATUS_DONE            (1u << 0) /* a frame is done */
#define DEGS_IRQ_STATUS_ERROR           (1u << 1) /* a frame ended with an error */
#define DEGS_IRQ_STATUS_ABORTED         (1u << 2) /* a frame has been given up */
#define DEGS_IRQ_STATUS_FAULT           (1u << 3) /* an access waits for software */

#define DEGS_REG_ERROR_CODE             0x018u /* see errors; 0 after a start */
#define DEGS_ERROR_CODE_NONE            0u /* no error */
#define DEGS_ERROR_CODE_BAD_SIZE        1u /* width or height is 0 or too large */
#define DEGS_ERROR_CODE_BAD_COUNT       2u /* no Gaussians, or too many */
#define DEGS_ERROR_CODE_BAD_DEGREE      3u /* SH degree over 3 */
#define DEGS_ERROR_CODE_BAD_FORMAT      4u /* unknown format */
#define DEGS_ERROR_CODE_MISALIGNED      5u /* a base is not a multiple of 64 */
#define DEGS_ERROR_CODE_OVERLAP         6u /* a region overlaps another, or passes the last address */
#define DEGS_ERROR_CODE_BAD_CAMERA      7u /* the camera is not finite, or its axes no rotation */
#define DEGS_ERROR_CODE_SMALL_WORKSPACE 8u /* the workspace is too small */
#define DEGS_ERROR_CODE_LOAD_ERROR      9u /* memory refused a read of the scene */
#define DEGS_ERROR_CODE_BUS_ERROR       10u /* memory refused an access of the frame */
#define DEGS_ERROR_CODE_SCENE_CHANGED   11u /* the scene was written during the frame */
#define DEGS_ERROR_CODE_OUT_OF_MEMORY   12u /* the host that simulates has too little memory */
#define DEGS_ERROR_CODE_BAD_VIEW_COUNT  13u /* more than 64 views */
#define DEGS_ERROR_CODE_BAD_FOVEATION   14u /* a gaze outside of the image, or angles that are not in order */

#define DEGS_REG_ERROR_DETAIL           0x01Cu /* offset of the register that is wrong, or, in the upper half, the entry of the table of views from 1 on, and in the lower half the offset in it; or the answer of the bus */

#define DEGS_REG_GEOMETRY               0x020u /* 2 words: address of the geometry records */

#define DEGS_REG_SH                     0x028u /* 2 words: address of the SH coefficients */

#define DEGS_REG_COUNT                  0x030u /* Gaussians, 1 to 2^30 (an option of the model) */

#define DEGS_REG_SH_DEGREE              0x034u /* 0 to 3 */

#define DEGS_REG_WORKSPACE              0x038u /* 2 words: address of memory for splat records and lists */

#define DEGS_REG_WORKSPACE_BYTES        0x040u /* 2 words: its size */

#define DEGS_REG_FRAME_BUFFER           0x048u /* 2 words: address of the frame buffer */

#define DEGS_REG_FORMAT                 0x050u /* format of a pixel */
#define DEGS_FORMAT_RGBA8               0u /* 4 B per pixel */
#define DEGS_FORMAT_RGBA16F             1u /* 8 B per pixel */

#define DEGS_REG_WIDTH                  0x054u /* pixels, 1 to 65536 */

#define DEGS_REG_HEIGHT                 0x058u /* pixels, 1 to 65536; at most 2^26 pixels in all (an option of the model) */

#define DEGS_REG_FOCAL_X                0x060u /* 2 words: double, focal length in pixels of the width */

#define DEGS_REG_FOCAL_Y                0x068u /* 2 words: double, focal length in pixels of the height */

#define DEGS_REG_AXES                   0x070u /* 18 words: 9 doubles: view axes x (right), y (down), z (forward) in world space */

#define DEGS_REG_POSITION               0x0B8u /* 6 words: 3 doubles: camera centre in world space */

#define DEGS_REG_SHIFT_X                0x0D0u /* 2 words: double, pixels from the middle of the image to the right, where the principal point is */

#define DEGS_REG_SHIFT_Y                0x0D8u /* 2 words: double, the same downwards */

#define DEGS_REG_ORIGIN_X               0x0E0u /* first column of the image in its raster, whose tiles begin at column 0; at least -2 SHIFT_X, rounded down, is taken */

#define DEGS_REG_ORIGIN_Y               0x0E4u /* the same of its first row */

#define DEGS_REG_CYCLES                 0x100u /* 2 words: of the last frame: scene loaded to last pixel in memory */

#define DEGS_REG_LOAD_CYCLES            0x108u /* 2 words: of the last frame: reading the scene; 0 if the memory has debug transport */

#define DEGS_REG_BYTES_READ             0x110u /* 2 words: of the last frame, in CYCLES: of its transactions, full bursts as a whole */

#define DEGS_REG_BYTES_WRITTEN          0x118u /* 2 words: of the last frame, likewise */

#define DEGS_REG_FRAGMENTS              0x120u /* 2 words: of the last frame: pixel updates; with outward span ends more than its useful PE slots */

#define DEGS_REG_WORKSPACE_NEEDED       0x128u /* 2 words: of the last frame, bytes; 0 if its scene could not be loaded */

#define DEGS_REG_FRAMES                 0x130u /* frames rendered so far, those with a bus error or a changed scene included */

#define DEGS_REG_DROPPED                0x134u /* of the last frame: Gaussians that no renderer can draw */

#define DEGS_REG_FRAME_ENERGY           0x138u /* 2 words: of the last frame, nJ: what its blocks have done, and leakage over CYCLES; without the memory */

#define DEGS_REG_VIEW_COUNT             0x140u /* views in the table, up to 64; 0: FRAME_BUFFER and the registers from WIDTH to ORIGIN_Y describe the one view */

#define DEGS_REG_VIEW                   0x144u /* drawn view, from 0 on, of which the registers from VIEW_SCALE on tell whose names begin with VIEW */

#define DEGS_REG_VIEWS                  0x148u /* 2 words: address of the table of views */

#define DEGS_REG_VIEWS_DRAWN            0x150u /* of the last frame: its drawn views; each level of a foveated view is one */

#define DEGS_REG_VIEW_SCALE             0x154u /* pixels of the image along a side of a pixel of the drawn view: 1, 2 or 4; 0 if there is no such view */

#define DEGS_REG_VIEW_ADDRESS           0x158u /* 2 words: address of its pixels */

#define DEGS_REG_VIEW_CYCLES            0x160u /* 2 words: of the last frame: scene loaded to last pixel of this view, and those before it, in memory */

#define DEGS_REG_VIEW_FRAGMENTS         0x168u /* 2 words: its part of FRAGMENTS */

#define DEGS_REG_VIEW_WIDTH             0x170u /* its pixels in a row */

#define DEGS_REG_VIEW_HEIGHT            0x174u /* its rows */

#define DEGS_REG_VIEW_X                 0x178u /* its first column among all of its size in the image */

#define DEGS_REG_VIEW_Y                 0x17Cu /* the same of its first row */

#define DEGS_REG_FAULT_ADDRESS          0x180u /* 2 words: of the access that has faulted, or of the last one; 0 after a start */

#define DEGS_REG_FAULT_STREAM           0x188u /* its stream */
#define DEGS_FAULT_STREAM_OTHER         0u /* one without a name here */
#define DEGS_FAULT_STREAM_SCENE_LOAD    1u /* reading the scene before the frame */
#define DEGS_FAULT_STREAM_GEOMETRY      2u /* geometry records */
#define DEGS_FAULT_STREAM_SH            3u /* SH coefficients */
#define DEGS_FAULT_STREAM_SPLATS_WRITTEN 4u /* splat records, written */
#define DEGS_FAULT_STREAM_SPLATS_READ   5u /* splat records, read */
#define DEGS_FAULT_STREAM_TILE_LISTS_WRITTEN 6u /* lists of tiles, written */
#define DEGS_FAULT_STREAM_TILE_LISTS_SORTED 7u /* lists of tiles, read and sorted */
#define DEGS_FAULT_STREAM_LIST_HEADS    8u /* where lists end */
#define DEGS_FAULT_STREAM_FRAME_BUFFER  9u /* pixels */
#define DEGS_FAULT_STREAM_MEANS         10u /* means of the geometry */
#define DEGS_FAULT_STREAM_SHAPES        11u /* the rest of the geometry */
#define DEGS_FAULT_STREAM_GROUP_LISTS_WRITTEN 12u /* lists of groups, written */
#define DEGS_FAULT_STREAM_GROUP_LISTS_READ 13u /* lists of groups, read */

#define DEGS_REG_FAULT_ANSWER           0x18Cu /* the answer of the bus to it */

#define DEGS_REG_IDLE_ENERGY            0x190u /* 2 words: of the last frame, nJ: leakage before it, from the end of the frame before, or from power-on or reset on */

#define DEGS_REG_POWER                  0x198u /* power states */
#define DEGS_POWER_GATE_IDLE            (1u << 0) /* the supply is gated while no frame is being rendered */

#define DEGS_REG_VIEW_SHOWN             0x200u /* 4 words: first column and row, width and height of what it shows of the image, in pixels of the image, with what finer levels show */

#define DEGS_REG_VIEW_ENTRY             0x210u /* entry of the table, from 0 on, that it belongs to */

/* An entry of the table of views: its size, and offsets of its fields in bytes. */
#define DEGS_VIEW_BYTES                 320u /* of an entry */
#define DEGS_MOST_VIEWS                 64u /* entries of a table */
#define DEGS_ENTRY_FRAME_BUFFER         0x000u /* 2 words: address of the frame buffer */
#define DEGS_ENTRY_WIDTH                0x008u /* pixels, 1 to 65536 */
#define DEGS_ENTRY_HEIGHT               0x00Cu /* pixels, 1 to 65536; at most 2^26 pixels in all (an option of the model) */
#define DEGS_ENTRY_FOCAL_X              0x010u /* 2 words: double, focal length in pixels of the width */
#define DEGS_ENTRY_FOCAL_Y              0x018u /* 2 words: double, focal length in pixels of the height */
#define DEGS_ENTRY_AXES                 0x020u /* 18 words: 9 doubles: view axes x (right), y (down), z (forward) in world space */
#define DEGS_ENTRY_POSITION             0x068u /* 6 words: 3 doubles: camera centre in world space */
#define DEGS_ENTRY_SHIFT_X              0x080u /* 2 words: double, pixels from the middle of the image to the right, where the principal point is */
#define DEGS_ENTRY_SHIFT_Y              0x088u /* 2 words: double, the same downwards */
#define DEGS_ENTRY_ORIGIN_X             0x090u /* first column of the image in its raster, whose tiles begin at column 0; at least -2 SHIFT_X, rounded down, is taken */
#define DEGS_ENTRY_ORIGIN_Y             0x094u /* the same of its first row */
#define DEGS_ENTRY_LENS                 0x098u /* kind of lens */
#define DEGS_LENS_PINHOLE               0u /* all coefficients are 0 */
#define DEGS_LENS_OPENCV                1u /* OpenCV's lens */
#define DEGS_LENS_FISHEYE               2u /* OpenCV's fisheye */
#define DEGS_ENTRY_RADIAL               0x0A0u /* 8 words: 4 doubles: k1, k2, k3 and the factor of r^8; of a fisheye k1 to k4 */
#define DEGS_ENTRY_DENOMINATOR          0x0C0u /* 6 words: 3 doubles: k4, k5, k6 of OpenCV's lens */
#define DEGS_ENTRY_TANGENTIAL           0x0D8u /* 4 words: 2 doubles: p1, p2 of OpenCV's lens */
#define DEGS_ENTRY_GAZE_X               0x0E8u /* 2 words: double, point looked at, in shares of the width from the left, 0 to 1 */
#define DEGS_ENTRY_GAZE_Y               0x0F0u /* 2 words: double, the same of the height from the top */
#define DEGS_ENTRY_FOVEA                0x0F8u /* 2 words: double, degrees from there with full resolution, up to 90; 0: the view is not foveated */
#define DEGS_ENTRY_PERIPHERY            0x100u /* 2 words: double, degrees from there with half of it, FOVEA to 90 */

#endif
