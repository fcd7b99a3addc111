# SPDX-License-Identifier: Apache-2.0
# Run by CPack before it makes the packages of Debian from what the components install: their files
# go where Debian has them, and the configurations into the package that the others need.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
    string(TOUPPER ${component} name)
    configure_file(${CPACK_DEGS_LICENSE} ${usr}/share/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME}/copyright COPYONLY)
    if(NOT component STREQUAL "common")
        file(REMOVE_RECURSE ${usr}/share/degs/configs)
    endif()
endforeach()
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python/usr)
file(MAKE_DIRECTORY ${usr}/lib/python3)
file(RENAME ${usr}/share/degs/python ${usr}/lib/python3/dist-packages)
file(REMOVE_RECURSE ${usr}/share/degs)
