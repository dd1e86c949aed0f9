# What `cmake --install` puts where, for find_package(aisle) and for Debian packages (cpack).
include(CMakePackageConfigHelpers)
# Whoever packs, as Debian's own tools have it; they want an address.
set(CPACK_PACKAGE_CONTACT "the aisle developers <aisle@localhost>")
if(NOT "$ENV{DEBEMAIL}" STREQUAL "")
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # tests are not packed
# Debian's packages of the libraries that ours hand on.
set(AISLE_DEV_PACKAGES libassimp-dev libceres-dev libcli11-dev libeigen3-dev libembree-dev libfmt-dev
  liblz4-dev libopencv-dev libosmesa6-dev libpugixml-dev libsqlite3-dev libtbb-dev libxxhash-dev
  libyaml-cpp-dev libzstd-dev nlohmann-json3-dev pkg-config)
set(AISLE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/aisle)

# --- The program and what comes with it ------------------------------------------------------------
install(TARGETS aisle RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS aisle_read_model RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/aisle
  COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/assets ${CMAKE_SOURCE_DIR}/scenes
  DESTINATION ${CMAKE_INSTALL_DATADIR}/aisle COMPONENT data
  PATTERN author EXCLUDE PATTERN contact EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/reports/baselines
  DESTINATION ${CMAKE_INSTALL_DATADIR}/aisle COMPONENT data)
# The pages, linked as in the tree, and what a system of one's own begins with.
set(AISLE_DOC_DIR ${CMAKE_INSTALL_DATADIR}/doc/aisle)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${AISLE_DOC_DIR} COMPONENT data)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/reports DESTINATION ${AISLE_DOC_DIR} COMPONENT data
  FILES_MATCHING PATTERN "*.md" PATTERN baselines EXCLUDE PATTERN gallery EXCLUDE
  PATTERN pictures EXCLUDE PATTERN "*.head.md" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/tests/support/stream/client.py
  ${CMAKE_SOURCE_DIR}/tests/support/stream/client.cpp
  ${CMAKE_SOURCE_DIR}/tests/support/stream/wheels.py
  DESTINATION ${AISLE_DOC_DIR}/examples/stream COMPONENT data)
# An installed program has no tree to ask which commit it is of.
install(CODE "execute_process(
  COMMAND git -C \"${CMAKE_SOURCE_DIR}\" describe --always --dirty=+ --exclude *
  OUTPUT_FILE \"${CMAKE_BINARY_DIR}/commit\" ERROR_QUIET)" COMPONENT data)
install(FILES ${CMAKE_BINARY_DIR}/commit DESTINATION ${CMAKE_INSTALL_DATADIR}/aisle COMPONENT data)

# --- Manual pages and completion, as the program itself tells them ----------------------------------
find_program(AISLE_HELP2MAN help2man)
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/package/aisle.bash
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/describe.sh $<TARGET_FILE:aisle> ${CMAKE_BINARY_DIR}/package
          ${PROJECT_VERSION} ${AISLE_HELP2MAN}
  DEPENDS aisle ${CMAKE_CURRENT_LIST_DIR}/describe.sh VERBATIM)
add_custom_target(descriptions DEPENDS ${CMAKE_BINARY_DIR}/package/aisle.bash)
install(FILES ${CMAKE_BINARY_DIR}/package/aisle.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME aisle
  COMPONENT program OPTIONAL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/package/man1 DESTINATION ${CMAKE_INSTALL_MANDIR}
  COMPONENT program OPTIONAL)

# --- The libraries, a component a house ---------------------------------------------------------------
install(TARGETS aisle_flags aisle_nouns EXPORT aisleNouns COMPONENT dev)
foreach(house slam simulator harness)
  get_property(rooms GLOBAL PROPERTY AISLE_ROOMS_${house})
  install(TARGETS ${rooms} EXPORT aisle_${house} COMPONENT dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/aisle)
  install(EXPORT aisle_${house} NAMESPACE aisle:: DESTINATION ${AISLE_CMAKE_DIR} COMPONENT dev)
endforeach()
# Of the foundations only the public headers and what these include: the rest stays free to change.
function(aisle_install_with_includes)
  set(queue ${ARGN})
  while(queue)
    list(POP_FRONT queue header)
    if(header IN_LIST seen)
      continue()
    endif()
    list(APPEND seen ${header})
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${CMAKE_SOURCE_DIR}/${header} COMPONENT dev
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/aisle/${folder})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${header})
    file(STRINGS ${CMAKE_SOURCE_DIR}/${header} includes REGEX "^#include \"")
    list(TRANSFORM includes REPLACE "^#include \"([^\"]*)\".*" "\\1")
    list(APPEND queue ${includes})
  endwhile()
endfunction()
aisle_install_with_includes(slam/stereo_slam.h slam/moving_objects.h simulator/simulator.h
  simulator/scene_file.h simulator/site.h simulator/import_model.h
  simulator/calibration/stereo_model.h simulator/proof/proofs.h)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/aisle
  COMPONENT dev FILES_MATCHING PATTERN "*.h" PATTERN package EXCLUDE)
install(EXPORT aisleNouns NAMESPACE aisle:: DESTINATION ${AISLE_CMAKE_DIR} COMPONENT dev)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/aisleConfig.cmake.in
  ${CMAKE_BINARY_DIR}/aisleConfig.cmake INSTALL_DESTINATION ${AISLE_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/aisleConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/aisleConfig.cmake ${CMAKE_BINARY_DIR}/aisleConfigVersion.cmake
  DESTINATION ${AISLE_CMAKE_DIR} COMPONENT dev)

# --- The module for Python, where this build has it -------------------------------------------------
if(AISLE_PYTHON)
  install(TARGETS python_core LIBRARY DESTINATION lib/python3/dist-packages/aisle COMPONENT python)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness/python/aisle
    DESTINATION lib/python3/dist-packages COMPONENT python)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness/python/examples
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-aisle COMPONENT python)
endif()

# Debian wants a changelog in a form of its own; ours is for people.
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH where that is set
file(WRITE ${CMAKE_BINARY_DIR}/package/changelog "aisle (${PROJECT_VERSION}) unstable; urgency=medium\n
  * CHANGELOG.md of the source says what is new.\n
 -- ${CPACK_PACKAGE_CONTACT}  ${today}\n")
execute_process(COMMAND gzip -9nkf ${CMAKE_BINARY_DIR}/package/changelog)

# --- Debian packages ----------------------------------------------------------------------------------
foreach(owner program:aisle data:aisle-data dev:libaisle-dev python:python3-aisle)
  string(REPLACE ":" ";" owner ${owner})
  list(GET owner 0 component)
  list(GET owner 1 package)
  install(FILES ${CMAKE_BINARY_DIR}/package/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
