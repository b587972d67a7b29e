# SPDX-License-Identifier: Apache-2.0
# Runs within CPack, when the files of every component are in a folder of their own: adds what Debian's policy requires of each
# package (licence, changelog), and leaves a file that two components install only to the one that the other depends on.
string(REGEX MATCH "20[0-9][0-9]" year "${FILAMENT_PACKAGE_DATE}")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
    string(TOUPPER ${component} upper)
    set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    set(folder ${root}/usr/share/doc/${name})
    file(MAKE_DIRECTORY ${folder})
    file(CONFIGURE OUTPUT ${folder}/copyright @ONLY CONTENT
[[Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: filament_core

Files: *
Copyright: @year@ the authors of filament_core
License: Apache-2.0
 On Debian systems, the complete text of this licence is in
 /usr/share/common-licenses/Apache-2.0.
]])
    file(CONFIGURE OUTPUT ${folder}/changelog.Debian @ONLY CONTENT
[[filament-core (@CPACK_PACKAGE_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) unstable; urgency=medium

  * Release @CPACK_PACKAGE_VERSION@.

 -- @CPACK_PACKAGE_CONTACT@  @FILAMENT_PACKAGE_DATE@
]])
    execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
    file(CHMOD ${folder}/copyright ${folder}/changelog.Debian.gz PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
    if(component STREQUAL "development")
        file(GLOB_RECURSE shared RELATIVE ${CPACK_TEMPORARY_DIRECTORY}/jobsystem/usr ${CPACK_TEMPORARY_DIRECTORY}/jobsystem/usr/*)
        list(FILTER shared EXCLUDE REGEX "^share/doc/")
        list(TRANSFORM shared PREPEND ${root}/usr/)
        file(REMOVE ${shared})
    endif()
endforeach()
