# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by cpack: clatter (program), clatter-mpi (the program for clusters), libclatter-dev (libraries),
# python3-clatter (Python module).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clatter)
set(CPACK_PACKAGE_VENDOR clatter)
set(CLATTER_CONTACT "The clatter authors <clatter@localhost>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_CONTACT "${CLATTER_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(CLATTER_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(CLATTER_MPI)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME clatter)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS gnuplot-nox)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "table and simulation of the impacts of a falling rigid body
A rod, a phone or any rigid body that falls on the floor at an angle
strikes it again and again.  This program prints the sequence of impacts
by a discrete model (impulse and momentum) and by a continuous-contact
simulation in space, and compares the two.")

set(CPACK_DEBIAN_MPI_PACKAGE_NAME clatter-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "clatter (= ${PROJECT_VERSION}-1)")
set(CPACK_DEBIAN_MPI_PACKAGE_SUGGESTS openmpi-bin)
set(CPACK_COMPONENT_MPI_DESCRIPTION
    "impacts of a falling rigid body: sweeps shared among processes
With this package mpirun and srun share the scenes of clatter sweep
among the processes that they start, on one machine or many.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libclatter-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libgsl-dev, libboost-dev, libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "libraries of clatter: impact sequences of falling rigid bodies
Headers and static libraries of the discrete model and of the
continuous-contact simulator, with files for CMake and pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-clatter)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-numpy)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, jupyter-notebook")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Python module of clatter: impact sequences of falling rigid bodies
Impact sequences, contact angles, simulations and comparisons of the two
models as Python objects and NumPy arrays, with what the notebooks import.")

# Compiled Python files come and go with the package.
set(scripts ${PROJECT_BINARY_DIR}/generated/packages/python)
file(WRITE ${scripts}/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ]; then py3compile -p python3-clatter; fi\n")
file(WRITE ${scripts}/prerm "#!/bin/sh\nset -e\npy3clean -p python3-clatter\n")
file(CHMOD ${scripts}/postinst ${scripts}/prerm
     PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)

# What Debian asks of every package: the licence, and the changes.
set(documents ${PROJECT_BINARY_DIR}/generated/packages)
file(READ ${PROJECT_SOURCE_DIR}/validation/measured/data-licence.txt data_licence)
string(STRIP "${data_licence}" data_licence)
string(REPLACE "\n\n" "\n.\n" data_licence " ${data_licence}")
string(REPLACE "\n" "\n " data_licence "${data_licence}")
file(CONFIGURE OUTPUT ${documents}/copyright @ONLY CONTENT [[
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: clatter

Files: *
Copyright: 2026 The clatter authors
License: GPL-3+
Comment: The page of clatter demo also holds three.js, KaTeX and uPlot (MIT licence), and compiled in it the GNU
 Scientific Library (GPL-3+), Qhull (its own licence), Eigen (MPL-2.0), Boost.Math (BSL-1.0), fmt, JSON for Modern C++, toml++, musl and
 emscripten's runtime (MIT) and LLVM's libraries (Apache-2.0 with exception); it shows their notices.

Files: validation/measured/*.csv
Copyright: 2020 Dynamic Autonomy and Intelligent Robotics Lab
License: BSD-3-Clause
Comment: Rows of these data are part of the program and of the Python module.

License: BSD-3-Clause
@data_licence@

License: GPL-3+
 This program is free software: you can redistribute it and/or modify it under the terms of the GNU General Public
 License as published by the Free Software Foundation, either version 3 of the License, or (at your option) any later
 version.
 .
 On Debian systems the full text of the licence is in /usr/share/common-licenses/GPL-3.
]])
set(package_of_program clatter)
set(package_of_mpi clatter-mpi)
set(package_of_development libclatter-dev)
set(package_of_python python3-clatter)
file(TIMESTAMP ${PROJECT_SOURCE_DIR}/CHANGELOG.md date "%a, %d %b %Y 00:00:00 +0000" UTC)
find_program(CLATTER_GZIP gzip REQUIRED)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(package ${package_of_${component}})
  set(changes ${documents}/${package}/changelog.Debian)
  file(WRITE ${changes} "${package} (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * See CHANGELOG.md of the source.\n\n"
                        " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND ${CLATTER_GZIP} -9nf ${changes} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${documents}/copyright ${changes}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

include(CPack)
