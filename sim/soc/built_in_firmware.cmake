# SPDX-License-Identifier: Apache-2.0
# cmake -D ELF=FILE -D TEMPLATE=FILE -D SOURCE=FILE -P built_in_firmware.cmake: writes the bytes of
# an ELF file into a C++ source; none without ELF.
set(bytes "")
if(ELF)
    file(READ ${ELF} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
endif()
configure_file(${TEMPLATE} ${SOURCE} @ONLY)
