# SPDX-License-Identifier: MIT
# `cpack -G DEB` in the build folder: one Debian package with the program, and the library for programs of one's own.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME threefold)
set(CPACK_PACKAGE_VENDOR "The Threefold authors")
# A package's maintainer is who built it, by the variables that Debian's own tools read.
if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
  set(CPACK_PACKAGE_CONTACT "The Threefold authors <threefold@localhost>")
else()
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION
"A scene is described once, rendered by POV-Ray, by Blender Cycles and by
Threefold's own tracer, measured by the same code, held against exact optics,
and judged: holds, fails or undecided. With the static library, its headers
and CMake files for scenes and claims of one's own.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# python3-numpy: Blender's glTF exporter needs it, and its package only recommends it.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "blender, povray, python3-numpy")
# What a program needs that links the static library.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libembree-dev, libassimp-dev, libopenexr-dev, libpng-dev, zlib1g-dev, libtbb-dev, libboost-dev, libglm-dev, nlohmann-json3-dev, libfmt-dev, libpugixml-dev")
include(CPack)
