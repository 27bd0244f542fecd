# SPDX-License-Identifier: MIT
# The module that reads and writes pictures through OpenImageIO (load_pictures.h), and where it is looked for.
set(pictures_folder ${CMAKE_INSTALL_LIBDIR}/threefold)
set(pictures_version "${PROJECT_VERSION}")

add_library(threefold_pictures MODULE ${PROJECT_SOURCE_DIR}/exporter/image/picture_module.cpp)
set_target_properties(threefold_pictures PROPERTIES
  OUTPUT_NAME threefold-pictures PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
  CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(threefold_pictures PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_definitions(threefold_pictures PRIVATE THREEFOLD_MODULE_VERSION="${pictures_version}")
target_link_libraries(threefold_pictures PRIVATE OpenImageIO::OpenImageIO fmt::fmt)
install(TARGETS threefold_pictures LIBRARY DESTINATION ${pictures_folder})

# Not linked, but every program of ours wants it beside it.
add_dependencies(threefold_exporter threefold_pictures)
file(RELATIVE_PATH from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/threefold)
set_source_files_properties(${PROJECT_SOURCE_DIR}/exporter/image/load_pictures.cpp PROPERTIES COMPILE_DEFINITIONS
  "THREEFOLD_MODULE_VERSION=\"${pictures_version}\";THREEFOLD_PICTURES_FILE=\"threefold-pictures.so\";THREEFOLD_PICTURES_FROM_PROGRAM=\"${from_program}\";THREEFOLD_PICTURES_INSTALLED=\"${CMAKE_INSTALL_FULL_LIBDIR}/threefold\"")
# Programs elsewhere that link the library find it by their library path. Ours in the build folder do, too; CMake takes
# that path out of what it installs.
set(CMAKE_BUILD_RPATH ${PROJECT_BINARY_DIR})
target_link_options(threefold_exporter INTERFACE "$<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/${pictures_folder}>")
if(NOT PROJECT_IS_TOP_LEVEL)
  target_link_options(threefold_exporter INTERFACE "$<BUILD_INTERFACE:LINKER:-rpath,${PROJECT_BINARY_DIR}>")
endif()
