# SPDX-License-Identifier: Apache-2.0
# What an accelerator from outside needs beyond the library for platforms: the headers of src, the
# program as a library, its main() and its compiler options. find_package(degs COMPONENTS kit) has
# them as degs::kit, degs::sim, degs::main and degs::flags (docs/adding-an-accelerator.md). The
# headers have a folder of their own, which only these targets name, because they are included by
# names such as "config/keys.hpp". It is a component on top of `degs`:
#     cmake --install BUILD --prefix PREFIX --component kit
foreach(target kit sources flags accuracy sim main)
    set_target_properties(degs_${target} PROPERTIES EXPORT_NAME ${target})
endforeach()
install(TARGETS degs_kit degs_sources degs_flags degs_accuracy degs_sim degs_main EXPORT degsKitTargets
        ARCHIVE COMPONENT kit OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/degs COMPONENT kit)
install(EXPORT degsKitTargets NAMESPACE degs:: DESTINATION ${package_dir} COMPONENT kit)
install(DIRECTORY src/ DESTINATION ${DEGS_KIT_INCLUDEDIR} COMPONENT kit
        FILES_MATCHING PATTERN "*.hpp" PATTERN "accuracy" EXCLUDE)
install(FILES sim/program.hpp DESTINATION ${DEGS_KIT_INCLUDEDIR}/sim COMPONENT kit)
