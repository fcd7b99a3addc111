# SPDX-License-Identifier: Apache-2.0
# The public headers in include/degs, static libraries, configurations, a CMake package and a
# pkg-config file. One component, so that a build without the program can be installed, too:
#     cmake --install BUILD --prefix PREFIX --component degs
# DegsInstallKit.cmake installs what accelerators from outside need beyond it.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/degs)

set_target_properties(degs_glm PROPERTIES EXPORT_NAME glm_headers)
set_target_properties(degs_systemc PROPERTIES EXPORT_NAME systemc)
set_target_properties(degs_driver PROPERTIES EXPORT_NAME driver)
# Each stands behind those that it needs.
set(rooms base config stats cost splat scene tlm dram modules baselines platform)
foreach(room IN LISTS rooms)
    set_target_properties(degs_${room} PROPERTIES EXPORT_NAME ${room})
    install(TARGETS degs_${room} EXPORT degsTargets COMPONENT degs)
endforeach()
install(TARGETS degs degs_glm degs_systemc degs_driver EXPORT degsTargets COMPONENT degs)
install(EXPORT degsTargets NAMESPACE degs:: DESTINATION ${package_dir} COMPONENT degs)
install(DIRECTORY include/degs DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT degs FILES_MATCHING PATTERN "*.hpp")
install(FILES driver/degs_driver.h driver/degs_registers.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/degs COMPONENT degs)
install(DIRECTORY driver DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT degs
        FILES_MATCHING PATTERN "*.c" PATTERN "*.svd" PATTERN "*.xml")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT degs)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT degs)
# Component `python`: the package that drives the program, with the designs that it knows by name.
install(DIRECTORY python/degs DESTINATION ${CMAKE_INSTALL_DATADIR}/degs/python COMPONENT python
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT python)

configure_package_config_file(cmake/degsConfig.cmake.in ${PROJECT_BINARY_DIR}/degsConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/degsConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/degsConfig.cmake ${PROJECT_BINARY_DIR}/degsConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT degs)

# Paths in it are relative to the file, so that the package can be moved.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH PC_PREFIX /${pc_dir} /)
string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")
# The SystemC of the system by its name, any other by its files: pkg-config would find another one.
set(PC_SYSTEMC_REQUIRED "")
set(PC_SYSTEMC_CFLAGS "")
set(PC_SYSTEMC_LIBS "")
if(DEGS_SYSTEMC_FROM STREQUAL "pkg-config")
    pkg_get_variable(systemc_pc systemc pcfiledir)
    pkg_get_variable(pc_path pkg-config pc_path)
    if(":${pc_path}:" MATCHES ":${systemc_pc}:")
        set(PC_SYSTEMC_REQUIRED "systemc ")
    endif()
endif()
if(NOT PC_SYSTEMC_REQUIRED)
    get_filename_component(systemc_dir "${DEGS_SYSTEMC_LIBRARY}" DIRECTORY)
    set(PC_SYSTEMC_CFLAGS " -isystem ${DEGS_SYSTEMC_INCLUDE}")
    set(PC_SYSTEMC_LIBS " ${DEGS_SYSTEMC_LIBRARY} -pthread")
    if(DEGS_SYSTEMC_LIBRARY MATCHES "\\.so")
        string(APPEND PC_SYSTEMC_LIBS " -Wl,-rpath,${systemc_dir}")
    endif()
endif()
# A library stands before those that it needs.
list(REVERSE rooms)
list(TRANSFORM rooms PREPEND "-ldegs_")
list(JOIN rooms " " PC_LIBS)
configure_file(cmake/degs.pc.in ${PROJECT_BINARY_DIR}/degs.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/degs.pc DESTINATION ${pc_dir} COMPONENT degs)
install(FILES cmake/DegsSystemC.cmake DESTINATION ${package_dir} COMPONENT degs)
