# Three packages: the program, its data, and the libraries with their headers; and of a build for
# Python the module alone.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME aisle)
set(CPACK_PACKAGE_VENDOR "the aisle developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
if(AISLE_PYTHON)
  set(CPACK_COMPONENTS_ALL python)
else()
  set(CPACK_COMPONENTS_ALL program data dev)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME aisle)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "aisle-data (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ffmpeg")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "simulation-in-the-loop tests for stereo visual SLAM in dynamic scenes
Renders a stereo camera that drives through a warehouse with walking people and
forklifts, with exact ground truth, drives SLAM systems with it and scores what
they say of it, in headless runs that end in a verdict, a report and an exit
code.")

set(CPACK_DEBIAN_DATA_PACKAGE_NAME aisle-data)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DATA_DESCRIPTION
  "scenes, people, vehicles and goods for aisle
What the simulated warehouse of aisle is made of, the scenes and suites that
come with it, and the baselines its gate compares with.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libaisle-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
list(JOIN AISLE_DEV_PACKAGES ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEV_DESCRIPTION
  "libraries and headers of aisle
The stereo visual SLAM, the simulator and the scores of aisle as static
libraries, for find_package(aisle COMPONENTS slam simulator harness).")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-aisle)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "aisle (= ${PROJECT_VERSION}), python3 (>= 3.11), \
python3 (<< 3.12), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "aisle as a module of Python
Renders stereo pictures with their truth into NumPy arrays, tracks them by the
SLAM of aisle, scores trajectories and masks, and steps a vehicle that steers
by what a system says.")
include(CPack)
