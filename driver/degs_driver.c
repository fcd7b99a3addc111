/* SPDX-License-Identifier: Apache-2.0 */
#include "degs_driver.h"

static uint32_t read_word(const degs_device *device, uint32_t offset) {
    return device->read(device->context, offset);
}

static void write_word(const degs_device *device, uint32_t offset, uint32_t value) {
    device->write(device->context, offset, value);
}

/* Values of 64 bits are pairs of words, the low one first. */
static uint64_t read_pair(const degs_device *device, uint32_t offset) {
    const uint64_t low = read_word(device, offset);
    return low | (uint64_t)read_word(device, offset + 4) << 32;
}

static void write_pair(const degs_device *device, uint32_t offset, uint64_t value) {
    write_word(device, offset, (uint32_t)value);
    write_word(device, offset + 4, (uint32_t)(value >> 32));
}

static void write_doubles(const degs_device *device, uint32_t offset, const double *values, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        union {
            double value;
            uint64_t bits;
        } number;
        number.value = values[i];
        write_pair(device, offset + 8 * i, number.bits);
    }
}

int degs_probe(const degs_device *device) {
    return read_word(device, DEGS_REG_ID) == DEGS_ID_VALUE &&
           read_word(device, DEGS_REG_VERSION) >> 16 == DEGS_VERSION_VALUE >> 16;
}

void degs_set_scene(const degs_device *device, const degs_scene *scene) {
    write_pair(device, DEGS_REG_GEOMETRY, scene->geometry);
    write_pair(device, DEGS_REG_SH, scene->sh);
    write_word(device, DEGS_REG_COUNT, scene->count);
    write_word(device, DEGS_REG_SH_DEGREE, scene->sh_degree);
}

void degs_set_camera(const degs_device *device, const degs_camera *camera) {
    write_word(device, DEGS_REG_WIDTH, camera->width);
    write_word(device, DEGS_REG_HEIGHT, camera->height);
    write_doubles(device, DEGS_REG_FOCAL_X, &camera->focal_x, 1);
    write_doubles(device, DEGS_REG_FOCAL_Y, &camera->focal_y, 1);
    write_doubles(device, DEGS_REG_AXES, camera->axes, 9);
    write_doubles(device, DEGS_REG_POSITION, camera->position, 3);
}

void degs_set_window(const degs_device *device, const degs_window *window) {
    write_doubles(device, DEGS_REG_SHIFT_X, &window->shift_x, 1);
    write_doubles(device, DEGS_REG_SHIFT_Y, &window->shift_y, 1);
    write_word(device, DEGS_REG_ORIGIN_X, window->origin_x);
    write_word(device, DEGS_REG_ORIGIN_Y, window->origin_y);
}

void degs_set_workspace(const degs_device *device, uint64_t address, uint64_t bytes) {
    write_pair(device, DEGS_REG_WORKSPACE, address);
    write_pair(device, DEGS_REG_WORKSPACE_BYTES, bytes);
}

void degs_set_frame_buffer(const degs_device *device, uint64_t address, uint32_t format) {
    write_pair(device, DEGS_REG_FRAME_BUFFER, address);
    write_word(device, DEGS_REG_FORMAT, format);
}

/* What is still pending belongs to frames before, and would fire the interrupt of this one at once. */
void degs_start(const degs_device *device, uint32_t interrupts) {
    write_word(device, DEGS_REG_IRQ_STATUS,
               DEGS_IRQ_STATUS_DONE | DEGS_IRQ_STATUS_ERROR | DEGS_IRQ_STATUS_ABORTED | DEGS_IRQ_STATUS_FAULT);
    write_word(device, DEGS_REG_IRQ_ENABLE, interrupts);
    write_word(device, DEGS_REG_CONTROL, DEGS_CONTROL_CLEAR_ERROR | DEGS_CONTROL_START);
}

void degs_abort(const degs_device *device) {
    write_word(device, DEGS_REG_CONTROL, DEGS_CONTROL_ABORT);
}

int degs_read_fault(const degs_device *device, degs_fault *fault) {
    if ((read_word(device, DEGS_REG_STATUS) & DEGS_STATUS_FAULTED) == 0) {
        return 0;
    }
    fault->address = read_pair(device, DEGS_REG_FAULT_ADDRESS);
    fault->stream = read_word(device, DEGS_REG_FAULT_STREAM);
    fault->answer = read_word(device, DEGS_REG_FAULT_ANSWER);
    return 1;
}

void degs_resume(const degs_device *device) {
    write_word(device, DEGS_REG_CONTROL, DEGS_CONTROL_RESUME);
}

int degs_busy(const degs_device *device) {
    return (read_word(device, DEGS_REG_STATUS) & DEGS_STATUS_BUSY) != 0;
}

static int unfinished(uint32_t status) {
    return (status & (DEGS_STATUS_BUSY | DEGS_STATUS_IN_RESET)) != 0;
}

uint32_t degs_reset(const degs_device *device, uint32_t polls) {
    write_word(device, DEGS_REG_CONTROL, DEGS_CONTROL_RESET);
    for (; polls > 0; polls--) {
        if (!unfinished(read_word(device, DEGS_REG_STATUS))) {
            return DEGS_ERROR_CODE_NONE;
        }
    }
    return DEGS_RESULT_BUSY;
}

uint32_t degs_wait(const degs_device *device) {
    while (unfinished(read_word(device, DEGS_REG_STATUS))) {
    }
    return degs_error(device);
}

uint32_t degs_wait_for(const degs_device *device, uint32_t polls) {
    for (; polls > 0; polls--) {
        if (!unfinished(read_word(device, DEGS_REG_STATUS))) {
            return degs_error(device);
        }
    }
    return DEGS_RESULT_BUSY;
}

uint32_t degs_acknowledge(const degs_device *device) {
    const uint32_t pending = read_word(device, DEGS_REG_IRQ_STATUS);
    write_word(device, DEGS_REG_IRQ_STATUS, pending);
    return pending;
}

uint32_t degs_error(const degs_device *device) {
    const uint32_t status = read_word(device, DEGS_REG_STATUS);
    const uint32_t code = read_word(device, DEGS_REG_ERROR_CODE);
    if (unfinished(status)) {
        return DEGS_RESULT_BUSY;
    }
    if ((status & DEGS_STATUS_START_IGNORED) != 0) {
        return DEGS_RESULT_START_IGNORED;
    }
    if ((status & DEGS_STATUS_ABORTED) != 0) {
        return DEGS_RESULT_ABORTED;
    }
    if (code != DEGS_ERROR_CODE_NONE) {
        return code;
    }
    return (status & DEGS_STATUS_DONE) != 0 ? DEGS_ERROR_CODE_NONE : DEGS_RESULT_NO_FRAME;
}

uint64_t degs_workspace_needed(const degs_device *device) {
    return read_pair(device, DEGS_REG_WORKSPACE_NEEDED);
}

void degs_read_counters(const degs_device *device, degs_counters *counters) {
    counters->cycles = read_pair(device, DEGS_REG_CYCLES);
    counters->load_cycles = read_pair(device, DEGS_REG_LOAD_CYCLES);
    counters->bytes_read = read_pair(device, DEGS_REG_BYTES_READ);
    counters->bytes_written = read_pair(device, DEGS_REG_BYTES_WRITTEN);
    counters->fragments = read_pair(device, DEGS_REG_FRAGMENTS);
    counters->frames = read_word(device, DEGS_REG_FRAMES);
    counters->dropped = read_word(device, DEGS_REG_DROPPED);
}

uint32_t degs_mmio_read(void *context, uint32_t offset) {
    return *(volatile uint32_t *)((uintptr_t)context + offset);
}

void degs_mmio_write(void *context, uint32_t offset, uint32_t value) {
    *(volatile uint32_t *)((uintptr_t)context + offset) = value;
}
