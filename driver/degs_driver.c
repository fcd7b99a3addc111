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

static uint64_t bits_of(double value) {
    union {
        double value;
        uint64_t bits;
    } number;
    number.value = value;
    return number.bits;
}

static void write_doubles(const degs_device *device, uint32_t offset, const double *values, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        write_pair(device, offset + 8 * i, bits_of(values[i]));
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

static void put_word(unsigned char *entry, uint32_t offset, uint32_t value) {
    for (uint32_t i = 0; i < 4; ++i) {
        entry[offset + i] = (unsigned char)(value >> 8 * i);
    }
}

static void put_pair(unsigned char *entry, uint32_t offset, uint64_t value) {
    put_word(entry, offset, (uint32_t)value);
    put_word(entry, offset + 4, (uint32_t)(value >> 32));
}

static void put_doubles(unsigned char *entry, uint32_t offset, const double *values, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        put_pair(entry, offset + 8 * i, bits_of(values[i]));
    }
}

void degs_encode_view(const degs_view *view, unsigned char *entry) {
    for (uint32_t i = 0; i < DEGS_VIEW_BYTES; ++i) {
        entry[i] = 0;
    }
    put_pair(entry, DEGS_ENTRY_FRAME_BUFFER, view->frame_buffer);
    put_word(entry, DEGS_ENTRY_WIDTH, view->camera.width);
    put_word(entry, DEGS_ENTRY_HEIGHT, view->camera.height);
    put_doubles(entry, DEGS_ENTRY_FOCAL_X, &view->camera.focal_x, 1);
    put_doubles(entry, DEGS_ENTRY_FOCAL_Y, &view->camera.focal_y, 1);
    put_doubles(entry, DEGS_ENTRY_AXES, view->camera.axes, 9);
    put_doubles(entry, DEGS_ENTRY_POSITION, view->camera.position, 3);
    put_doubles(entry, DEGS_ENTRY_SHIFT_X, &view->window.shift_x, 1);
    put_doubles(entry, DEGS_ENTRY_SHIFT_Y, &view->window.shift_y, 1);
    put_word(entry, DEGS_ENTRY_ORIGIN_X, view->window.origin_x);
    put_word(entry, DEGS_ENTRY_ORIGIN_Y, view->window.origin_y);
    put_word(entry, DEGS_ENTRY_LENS, view->lens.kind);
    put_doubles(entry, DEGS_ENTRY_RADIAL, view->lens.radial, 4);
    put_doubles(entry, DEGS_ENTRY_DENOMINATOR, view->lens.denominator, 3);
    put_doubles(entry, DEGS_ENTRY_TANGENTIAL, view->lens.tangential, 2);
    put_doubles(entry, DEGS_ENTRY_GAZE_X, &view->gaze.x, 1);
    put_doubles(entry, DEGS_ENTRY_GAZE_Y, &view->gaze.y, 1);
    put_doubles(entry, DEGS_ENTRY_FOVEA, &view->gaze.fovea, 1);
    put_doubles(entry, DEGS_ENTRY_PERIPHERY, &view->gaze.periphery, 1);
}

void degs_set_views(const degs_device *device, uint64_t address, uint32_t count) {
    write_pair(device, DEGS_REG_VIEWS, address);
    write_word(device, DEGS_REG_VIEW_COUNT, count);
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

void degs_gate_idle(const degs_device *device, int gated) {
    write_word(device, DEGS_REG_POWER, gated != 0 ? DEGS_POWER_GATE_IDLE : 0);
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
    counters->frame_energy = read_pair(device, DEGS_REG_FRAME_ENERGY);
    counters->idle_energy = read_pair(device, DEGS_REG_IDLE_ENERGY);
    counters->frames = read_word(device, DEGS_REG_FRAMES);
    counters->dropped = read_word(device, DEGS_REG_DROPPED);
}

uint32_t degs_views_drawn(const degs_device *device) {
    return read_word(device, DEGS_REG_VIEWS_DRAWN);
}

void degs_read_view(const degs_device *device, uint32_t number, degs_drawn_view *view) {
    write_word(device, DEGS_REG_VIEW, number);
    view->entry = read_word(device, DEGS_REG_VIEW_ENTRY);
    view->scale = read_word(device, DEGS_REG_VIEW_SCALE);
    view->address = read_pair(device, DEGS_REG_VIEW_ADDRESS);
    view->width = read_word(device, DEGS_REG_VIEW_WIDTH);
    view->height = read_word(device, DEGS_REG_VIEW_HEIGHT);
    view->x = read_word(device, DEGS_REG_VIEW_X);
    view->y = read_word(device, DEGS_REG_VIEW_Y);
    for (uint32_t i = 0; i < 4; ++i) {
        view->shown[i] = read_word(device, DEGS_REG_VIEW_SHOWN + 4 * i);
    }
    view->cycles = read_pair(device, DEGS_REG_VIEW_CYCLES);
    view->fragments = read_pair(device, DEGS_REG_VIEW_FRAGMENTS);
}

uint32_t degs_mmio_read(void *context, uint32_t offset) {
    return *(volatile uint32_t *)((uintptr_t)context + offset);
}

void degs_mmio_write(void *context, uint32_t offset, uint32_t value) {
    *(volatile uint32_t *)((uintptr_t)context + offset) = value;
}
