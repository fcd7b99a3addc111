/* SPDX-License-Identifier: Apache-2.0 */
/* Driver of the DeGS accelerator in C11, freestanding: no library, no allocation, no interrupts of its own. The
 * platform supplies two functions that read and write a register; degs_mmio_read and degs_mmio_write do so where the
 * registers are mapped into memory. docs/accelerator.md explains the registers and the layout of a scene.
 *
 * A frame: degs_set_scene, degs_set_camera (or, for several views, lenses and foveation, degs_set_views), degs_set_workspace, degs_set_frame_buffer, degs_start, then either
 * degs_wait, or sleep until the interrupt and degs_acknowledge. A start samples all registers, so that the next frame
 * may be described while one is being rendered. One processor at a time may use a device. */
#ifndef DEGS_DRIVER_H
#define DEGS_DRIVER_H

#include <stdint.h>

#include "degs_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How to reach one accelerator. offset: bytes, of one of the registers in degs_registers.h. */
typedef struct degs_device {
    void *context; /* of the two functions, e.g. the address of the first register */
    uint32_t (*read)(void *context, uint32_t offset);
    void (*write)(void *context, uint32_t offset, uint32_t value);
} degs_device;

/* Addresses are those of the accelerator's memory socket, multiples of DEGS_BASE_ALIGNMENT. */
typedef struct degs_scene {
    uint64_t geometry;  /* address of 44 B per Gaussian */
    uint64_t sh;        /* address of 12 (sh_degree + 1)^2 B per Gaussian */
    uint32_t count;     /* Gaussians, at least 1 */
    uint32_t sh_degree; /* 0 to 3 */
} degs_scene;

typedef struct degs_camera {
    uint32_t width, height;  /* px, 1 to 65536 */
    double focal_x, focal_y; /* px, positive */
    double axes[9];          /* x (right), y (down), z (forward) of the view in world space, orthonormal */
    double position[3];      /* in world space */
} degs_camera;

/* Where an image lies in its raster (docs/cameras.md), whose middle is the principal point; all 0 for an image that is
 * its raster. */
typedef struct degs_window {
    double shift_x, shift_y;     /* px, of the principal point from the middle of the image, right and down */
    uint32_t origin_x, origin_y; /* px, the first pixel of the image; more is taken if the shift needs it */
} degs_window;

/* What the lens makes of directions (docs/cameras.md); all 0 for a pinhole. */
typedef struct degs_lens {
    uint32_t kind;         /* DEGS_LENS_PINHOLE, DEGS_LENS_OPENCV or DEGS_LENS_FISHEYE */
    double radial[4];      /* k1, k2, k3 and the factor of r^8; of a fisheye k1 to k4 */
    double denominator[3]; /* k4, k5, k6 of OpenCV's lens */
    double tangential[2];  /* p1, p2 of OpenCV's lens */
} degs_lens;

/* Where an eye looks, and how far from there each resolution reaches (docs/foveation.md). */
typedef struct degs_gaze {
    double x, y;             /* shares of width and height from the upper left corner, 0 to 1 */
    double fovea, periphery; /* degrees, in this order, up to 90; a fovea of 0: the view is not foveated */
} degs_gaze;

/* One of several views of a frame, such as an eye. */
typedef struct degs_view {
    uint64_t frame_buffer; /* address of its pixels; of a foveated view, of those of its levels, finest first */
    degs_camera camera;
    degs_window window;
    degs_lens lens;
    degs_gaze gaze;
} degs_view;

/* A view that the last frame has drawn: one of the table, or a level of it. */
typedef struct degs_drawn_view {
    uint32_t entry;         /* of the table, from 0 on */
    uint32_t scale;         /* px of the image along a side of a pixel: 1, 2 or 4; 0: there is no such view */
    uint64_t address;       /* of its pixels, row by row */
    uint32_t width, height; /* its pixels */
    uint32_t x, y;          /* its first pixel, among all pixels of its size in the image */
    uint32_t shown[4];      /* first column and row, width and height of what it shows, px of the image */
    uint64_t cycles;        /* scene loaded to its last pixel in memory */
    uint64_t fragments;
} degs_drawn_view;

/* Of the last frame, but for `frames`. */
typedef struct degs_counters {
    uint64_t cycles, load_cycles;
    uint64_t bytes_read, bytes_written;
    uint64_t fragments;
    uint64_t frame_energy; /* nJ, without the memory */
    uint64_t idle_energy;  /* nJ, leakage between the frame before and this one */
    uint32_t frames;       /* so far */
    uint32_t dropped;      /* Gaussians that cannot be drawn */
} degs_counters;

/* An access that the memory has refused. */
typedef struct degs_fault {
    uint64_t address;
    uint32_t stream; /* DEGS_FAULT_STREAM_ */
    uint32_t answer; /* of the bus: 1 address, 2 command, 3 burst, 4 byte enable, 5 generic error, 6 no answer */
} degs_fault;

/* Whether there is an accelerator whose registers have the layout of this header: 1 or 0. */
int degs_probe(const degs_device *device);

void degs_set_scene(const degs_device *device, const degs_scene *scene);
void degs_set_camera(const degs_device *device, const degs_camera *camera);
/* For cameras that are not centred; the setting stays until the next one or a reset. */
void degs_set_window(const degs_device *device, const degs_window *window);
/* Writes the DEGS_VIEW_BYTES of an entry of the table of views, which the processor then puts into the accelerator's
 * memory. */
void degs_encode_view(const degs_view *view, unsigned char *entry);
/* A frame of `count` views, up to DEGS_MOST_VIEWS, whose table of entries lies at `address`; degs_set_camera,
 * degs_set_window and the address of degs_set_frame_buffer then have no effect, until this is called with a count of 0.
 * The table is read when the frame begins. */
void degs_set_views(const degs_device *device, uint64_t address, uint32_t count);
/* Memory for splat records and lists; degs_workspace_needed says after a frame how many bytes it took. */
void degs_set_workspace(const degs_device *device, uint64_t address, uint64_t bytes);
/* format: DEGS_FORMAT_RGBA8 or DEGS_FORMAT_RGBA16F. */
void degs_set_frame_buffer(const degs_device *device, uint64_t address, uint32_t format);

/* What degs_error, degs_wait and degs_wait_for return beside the codes of ERROR_CODE. */
#define DEGS_RESULT_ABORTED       0x100u /* the last frame has been given up */
#define DEGS_RESULT_START_IGNORED 0x101u /* a start came while the accelerator was busy or in reset */
#define DEGS_RESULT_NO_FRAME      0x102u /* no frame has been started since power-on or the last reset */
#define DEGS_RESULT_BUSY          0x103u /* a frame, an abort or a reset has not ended yet */

/* Clears what is left of the last frame (error, aborted, start ignored, pending interrupts) and starts a frame.
 * interrupts: bits of IRQ_ENABLE, as DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR, or 0. While the accelerator is busy
 * or in reset the start is ignored, which degs_wait reports. */
void degs_start(const degs_device *device, uint32_t interrupts);
/* Gives up the present frame; the accelerator is busy until it has. */
void degs_abort(const degs_device *device);
/* Whether an access has faulted and waits: 1 or 0. Then `fault` is the oldest one. After an interrupt: degs_acknowledge,
 * then, as long as this returns 1, for instance map the page, and degs_resume. */
int degs_read_fault(const degs_device *device, degs_fault *fault);
/* Lets the access of degs_read_fault go out again. degs_abort gives it up together with its frame. */
void degs_resume(const degs_device *device);
/* Whether a frame is being rendered: 1 or 0. */
int degs_busy(const degs_device *device);
/* Resets the accelerator, which gives up its frame and forgets its registers, and reads STATUS at most `polls` times
 * until the reset has ended. Returns DEGS_ERROR_CODE_NONE or DEGS_RESULT_BUSY. */
uint32_t degs_reset(const degs_device *device, uint32_t polls);
/* Reads STATUS until the frame, abort or reset has ended; returns degs_error(). */
uint32_t degs_wait(const degs_device *device);
/* The same with at most `polls` readings of STATUS; DEGS_RESULT_BUSY if it has not ended by then. */
uint32_t degs_wait_for(const degs_device *device, uint32_t polls);
/* Takes back the pending interrupts, and returns them (bits of IRQ_STATUS). */
uint32_t degs_acknowledge(const degs_device *device);
/* Why the last frame was not rendered, or cannot be trusted: DEGS_ERROR_CODE_NONE (0) if it is in the frame buffer, else
 * another code of ERROR_CODE or one of DEGS_RESULT_. */
uint32_t degs_error(const degs_device *device);

/* Whether the supply is gated while no frame is being rendered: 1 or 0. It is not after power-on and a reset. */
void degs_gate_idle(const degs_device *device, int gated);

/* Bytes of workspace that the last frame needed. A frame with a workspace of 0 bytes ends at once with
 * DEGS_ERROR_CODE_SMALL_WORKSPACE, and asks for nothing else. */
uint64_t degs_workspace_needed(const degs_device *device);
void degs_read_counters(const degs_device *device, degs_counters *counters);
/* The views that the last frame has drawn; after DEGS_ERROR_CODE_SMALL_WORKSPACE, those that it would have drawn. */
uint32_t degs_views_drawn(const degs_device *device);
/* One of them, from 0 on, those of the first entry first and of each the finest first. */
void degs_read_view(const degs_device *device, uint32_t number, degs_drawn_view *view);

/* For registers that are mapped into memory; context: the address of the first one. */
uint32_t degs_mmio_read(void *context, uint32_t offset);
void degs_mmio_write(void *context, uint32_t offset, uint32_t value);

#ifdef __cplusplus
}
#endif

#endif
