# SPDX-License-Identifier: Apache-2.0
# Headers under include/degs, static libraries, configurations, a CMake package and a pkg-config file.
# One component, so that a build without the program can be installed, too:
#     cmake --install BUILD --prefix PREFIX --component degs
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/degs)

set_target_properties(degs_glm PROPERTIES EXPORT_NAME glm_headers)
foreach(room config cost splat scene tlm dram modules baselines platform)
    set_target_properties(degs_${room} PROPERTIES EXPORT_NAME ${room})
    install(TARGETS degs_${room} EXPORT degsTargets COMPONENT degs)
    if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/src/${room})
        install(DIRECTORY src/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/degs COMPONENT degs
                FILES_MATCHING PATTERN "*.hpp")
    endif()
endforeach()
install(TARGETS degs degs_glm EXPORT degsTargets COMPONENT degs)
install(EXPORT degsTargets NAMESPACE degs:: DESTINATION ${package_dir} COMPONENT degs)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT degs)

configure_package_config_file(cmake/degsConfig.cmake.in ${PROJECT_BINARY_DIR}/degsConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/degsConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/degsConfig.cmake ${PROJECT_BINARY_DIR}/degsConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT degs)
# At install time, because only then the prefix is known.
install(CODE "
    set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
    set(PROJECT_VERSION \"${PROJECT_VERSION}\")
    set(CMAKE_INSTALL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
    set(CMAKE_INSTALL_INCLUDEDIR \"${CMAKE_INSTALL_INCLUDEDIR}\")
    configure_file(\"${PROJECT_SOURCE_DIR}/cmake/degs.pc.in\"
                   \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig/degs.pc\" @ONLY)
" COMPONENT degs)
