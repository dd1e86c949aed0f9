# aisle._core, and beside it in the build folder the rest of the package, ready to be imported.
# Debian's own Python: a pyenv or conda earlier in PATH is not what pybind11-dev was made for.
set(PYBIND11_FINDPYTHON ON)
find_program(Python_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_package(Python 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 CONFIG REQUIRED)

set(python_folder ${CMAKE_CURRENT_LIST_DIR})
set(python_package ${CMAKE_BINARY_DIR}/python/aisle)
file(GLOB python_sources CONFIGURE_DEPENDS ${python_folder}/*.cc)
pybind11_add_module(python_core MODULE NO_EXTRAS ${python_sources})
list(TRANSFORM python_uses REPLACE "/" "_" OUTPUT_VARIABLE python_links)
target_link_libraries(python_core PRIVATE aisle_nouns ${python_links})
target_precompile_headers(python_core REUSE_FROM aisle_pch)
# What comes along from static libraries stays inside: another module may bring its own.
target_link_options(python_core PRIVATE -Wl,--exclude-libs,ALL)
set_target_properties(python_core PROPERTIES
  OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${python_package})

file(GLOB python_files CONFIGURE_DEPENDS ${python_folder}/aisle/*)
foreach(file ${python_files})
  get_filename_component(name ${file} NAME)
  add_custom_command(OUTPUT ${python_package}/${name} DEPENDS ${file} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E copy ${file} ${python_package}/${name})
  list(APPEND python_copies ${python_package}/${name})
endforeach()
add_custom_target(python DEPENDS python_core ${python_copies})
add_dependencies(python aisle_read_model)
