# SPDX-License-Identifier: MIT
# What of the figure and of the robe no parameter changes takes a second to make: it is made here, once, and kept in the library
# (stored_figure.h). The objects that make it are in the library too.
set(figure ${PROJECT_SOURCE_DIR}/scenes/figure)
set(figure_makers ${figure}/drawing.cpp ${figure}/hand_shape.cpp ${figure}/painted_relief.cpp ${figure}/painting.cpp
    ${figure}/painting_blessing.cpp ${figure}/painting_face.cpp ${figure}/painting_robe.cpp ${figure}/surface_net.cpp
    ${PROJECT_SOURCE_DIR}/scenes/catalogue/painted_robe.cpp)
add_library(threefold_figure OBJECT ${figure_makers})
target_include_directories(threefold_figure PRIVATE ${PROJECT_SOURCE_DIR})
add_executable(threefold_store_figure ${figure}/store_figure.cpp $<TARGET_OBJECTS:threefold_figure>)
target_include_directories(threefold_store_figure PRIVATE ${PROJECT_SOURCE_DIR})

set(stored ${PROJECT_BINARY_DIR}/figure/stored_figure.bin)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/figure)
add_custom_command(OUTPUT ${stored} COMMAND threefold_store_figure ${stored} DEPENDS threefold_store_figure VERBATIM
                   COMMENT "Making the figure")
set_source_files_properties(${figure}/stored_figure.cpp PROPERTIES
  OBJECT_DEPENDS ${stored} COMPILE_OPTIONS "-Wa,-I${PROJECT_BINARY_DIR}/figure")

get_target_property(scene_sources threefold_scenes SOURCES)
list(REMOVE_ITEM scene_sources ${figure_makers} ${figure}/store_figure.cpp)
set_target_properties(threefold_scenes PROPERTIES SOURCES "${scene_sources}")
target_sources(threefold_scenes PRIVATE $<TARGET_OBJECTS:threefold_figure>)
