/* SPDX-License-Identifier: Apache-2.0 */
/* What a program of programs.py sees of its machine: the host, or the core that run_program.cpp runs. */
#include <stdint.h>

#if defined(__riscv)
static void emit(uint32_t word) {
    *(volatile uint32_t *)0x20000000u = word;
}
void on_trap(uint32_t cause);
void on_trap(uint32_t cause) {
    *(volatile uint32_t *)0x20000004u = cause | 1u;
    for (;;) {
    }
}
#else
#include <stdio.h>
static void emit(uint32_t word) {
    printf("%08x\n", word);
}
#endif
