# SPDX-License-Identifier: Apache-2.0
# Packages of Debian from a build, by `cpack -G DEB` in its folder: one for each component that can
# be installed, and one for the shipped configurations, which the others share. The names of
# libraries come from dpkg-shlibdeps, so that a package suits the Debian on which it was made.
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/degs COMPONENT common EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL common degs python)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/DegsDebianFiles.cmake)
set(CPACK_DEGS_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE) # for that script
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The DeGS authors")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(same_version "(= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_COMMON_PACKAGE_NAME degs-common)
set(CPACK_DEBIAN_COMMON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_COMMON_DESCRIPTION "Configurations of the DeGS model of 3D Gaussian Splatting accelerators
 Designs, studies, memories and technologies, as files.")

# What degsConfig.cmake and degs.pc look for.
set(CPACK_DEBIAN_DEGS_PACKAGE_NAME libdegs-dev)
set(CPACK_DEBIAN_DEGS_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEGS_PACKAGE_DEPENDS "degs-common ${same_version}, pkg-config, libsystemc-dev, libglm-dev, \
libopenexr-dev, libpng-dev, zlib1g-dev, libzstd-dev, libzip-dev, libwebp-dev, libhwy-dev, libtinygltf-dev, \
libyaml-cpp-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_DEGS_DESCRIPTION "SystemC/TLM model of the DeGS accelerator, as a library
 Headers, static libraries, the driver and examples for platforms in SystemC.")

if(TARGET degs_program)
    list(APPEND CPACK_COMPONENTS_ALL kit program)
    set(CPACK_DEBIAN_KIT_PACKAGE_NAME libdegs-kit-dev)
    set(CPACK_DEBIAN_KIT_PACKAGE_SECTION libdevel)
    set(CPACK_DEBIAN_KIT_PACKAGE_DEPENDS "libdegs-dev ${same_version}, libxxhash-dev, libjemalloc-dev, libpugixml-dev")
    set(CPACK_DEBIAN_KIT_DESCRIPTION "SystemC/TLM model of the DeGS accelerator, for accelerators of one's own
 Headers of its blocks and the program as a library, to which an accelerator is added.")
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME degs)
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "degs-common ${same_version}")
    set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}
 The program degs, with its manual page, completion for bash and zsh, and schemas.")
endif()

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-degs)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "degs ${same_version}, python3, python3-numpy, python3-pandas, python3-pil, \
python3-yaml")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-tqdm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "SystemC/TLM model of the DeGS accelerator, from Python
 Runs the program degs and reads its results into tables and images.")
include(CPack)
