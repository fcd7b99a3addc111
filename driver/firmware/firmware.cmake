# SPDX-License-Identifier: Apache-2.0
# degs_firmware(<elf> <include>): a command that compiles the firmware in this folder and the driver
# beside it to <elf> with RISCV_GCC, the compiler of Debian's gcc-riscv64-unknown-elf. <include> has
# degs_driver.h.
set(DEGS_FIRMWARE_DIR ${CMAKE_CURRENT_LIST_DIR})
function(degs_firmware elf include)
    set(here ${DEGS_FIRMWARE_DIR})
    set(sources ${here}/start.S ${here}/main.c ${here}/memory.c ${here}/../degs_driver.c)
    add_custom_command(
        OUTPUT ${elf}
        COMMAND ${RISCV_GCC} -march=rv32im -mabi=ilp32 -std=c11 -O2 -Wall -Wextra -Werror -ffreestanding
                -nostdlib -fno-tree-loop-distribute-patterns -ffunction-sections -Wl,--gc-sections -I ${here}
                -I ${include} -T ${here}/link.ld ${sources} -lgcc -s -o ${elf}
        DEPENDS ${sources} ${here}/map.h ${here}/link.ld ${include}/degs_driver.h ${include}/degs_registers.h
        VERBATIM)
endfunction()
