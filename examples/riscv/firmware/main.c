/* SPDX-License-Identifier: Apache-2.0 */
/* Renders a frame for each view of the table, and prints the checksum of its red, green and blue bytes. */
#include "degs_driver.h"
#include "map.h"

#define EXTERNAL_INTERRUPT 0x8000000Bu
#define MIE_EXTERNAL       (1u << 11)
#define MSTATUS_MIE        (1u << 3)

__asm__(".option arch, +zicsr"); /* not in -march, for which GCC 12 has a 32-bit libgcc only as rv32im */

static const degs_device device = {(void *)REGISTERS, degs_mmio_read, degs_mmio_write};
static volatile uint32_t interrupts; /* bits of IRQ_STATUS of the present frame */

static void leave(uint32_t status) {
    *(volatile uint32_t *)EXIT = status;
    for (;;) {
    }
}

static void print(const char *text) {
    for (; *text != 0; ++text) {
        *(volatile uint32_t *)CONSOLE = (uint32_t)*text;
    }
}

static void print_hex(uint32_t value) {
    for (int shift = 28; shift >= 0; shift -= 4) {
        *(volatile uint32_t *)CONSOLE = (uint32_t)"0123456789abcdef"[value >> shift & 15];
    }
}

void on_trap(uint32_t cause);
void on_trap(uint32_t cause) {
    if (cause != EXTERNAL_INTERRUPT) {
        print("unexpected trap ");
        print_hex(cause);
        print("\n");
        leave(2);
    }
    interrupts |= degs_acknowledge(&device);
}

/* The interrupt may come between the question and wfi, so they are asked with interrupts disabled; wfi wakes all the
 * same, and the interrupt is taken when they are enabled. */
static void sleep_until_interrupt(void) {
    __asm__ volatile("csrc mstatus, %0" ::"r"(MSTATUS_MIE) : "memory");
    while (interrupts == 0) {
        __asm__ volatile("wfi\n\tcsrs mstatus, %0\n\tnop\n\tcsrc mstatus, %0" ::"r"(MSTATUS_MIE) : "memory");
    }
    __asm__ volatile("csrs mstatus, %0" ::"r"(MSTATUS_MIE) : "memory");
}

/* CRC-32 of zlib and PNG, without alpha. */
static uint32_t checksum(const volatile uint32_t *pixels, uint32_t count) {
    static uint32_t table[256];
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t rest = i;
        for (int bit = 0; bit < 8; ++bit) {
            rest = rest >> 1 ^ (rest & 1 ? 0xEDB88320u : 0);
        }
        table[i] = rest;
    }
    uint32_t sum = ~0u;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t pixel = pixels[i];
        for (int channel = 0; channel < 3; ++channel, pixel >>= 8) {
            sum = table[(sum ^ pixel) & 255] ^ sum >> 8;
        }
    }
    return ~sum;
}

static void set_view(const view *from) {
    degs_camera camera = {.width = from->width, .height = from->height, .focal_x = from->focal_x,
                          .focal_y = from->focal_y};
    for (int i = 0; i < 9; ++i) {
        camera.axes[i] = from->axes[i];
    }
    for (int i = 0; i < 3; ++i) {
        camera.position[i] = from->position[i];
    }
    degs_set_camera(&device, &camera);
    const degs_window window = {from->shift_x, from->shift_y, from->origin_x, from->origin_y};
    degs_set_window(&device, &window);
}

int main(void) {
    const boot_table *const table = (const boot_table *)BOOT_TABLE;
    if (!degs_probe(&device)) {
        print("no accelerator\n");
        return 1;
    }
    const degs_scene scene = {table->geometry, table->sh, table->count, table->sh_degree};
    degs_set_scene(&device, &scene);
    degs_set_workspace(&device, table->workspace, table->workspace_bytes);
    degs_set_frame_buffer(&device, table->frame_buffer, DEGS_FORMAT_RGBA8);
    __asm__ volatile("csrw mie, %0\n\tcsrs mstatus, %1" ::"r"(MIE_EXTERNAL), "r"(MSTATUS_MIE));
    for (uint32_t frame = 0; frame < table->frames; ++frame) {
        const view *const from = &table->views[frame];
        set_view(from);
        interrupts = 0;
        degs_start(&device, DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR);
        sleep_until_interrupt();
        const uint32_t error = degs_error(&device);
        if (error != DEGS_ERROR_CODE_NONE) {
            print("error ");
            print_hex(error);
            print("\n");
            return 1;
        }
        print("image ");
        print_hex(checksum((const volatile uint32_t *)table->frame_buffer, from->width * from->height));
        print("\n");
    }
    return 0;
}
