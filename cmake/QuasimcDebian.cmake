# Debian packages, made by cpack from a build with tests or without: quasimc (the programs),
# libquasimc<ABI> (the shared library), libquasimc-dev (headers, static libraries, CMake files),
# python3-quasimc.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME quasimc)
set(CPACK_PACKAGE_VENDOR "QuasiMC developers")
set(CPACK_PACKAGE_CONTACT "QuasiMC developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL library dev)
if(TARGET quasimc_app)
    list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(TARGET quasimc_python)
    list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
get_target_property(quasimc_abi quasimc_shared SOVERSION)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME quasimc)
# It is loaded when it is needed, so that shlibdeps does not see it: libnetcdf.so.19 is in libnetcdf19.
if(QuasimcNetcdf_FOUND)
    string(REGEX REPLACE "^libnetcdf\\.so\\.([0-9]+)$" "libnetcdf\\1" CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
                         "${QuasimcNetcdf_SONAME}")
endif()
string(CONCAT CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "The programs quasimc, and QuasiMC, the light environment of cpfg and lpfg models. Method: "
    "Cieslak, Lemieux, Hanan and Prusinkiewicz (2008), Functional Plant Biology 35, 837-849.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libquasimc${quasimc_abi})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "The shared library, with a C interface.")

# What static libraries are linked with (quasimcConfig.cmake.in).
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libquasimc-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(quasimc_dev_depends "libquasimc${quasimc_abi} (= ${PROJECT_VERSION})" libembree-dev libfmt-dev libhwy-dev
                        libpugixml-dev libtomlplusplus-dev)
if(PNG_FOUND)
    list(APPEND quasimc_dev_depends libpng-dev)
endif()
list(JOIN quasimc_dev_depends ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers for C and C++, static libraries, and CMake files.")

# The module is for the Python that it was made for.
if(TARGET quasimc_python)
    execute_process(COMMAND "${QUASIMC_PYTHON}" -c
                            "import sys; print('%d.%d %d.%d' % (*sys.version_info[:2], sys.version_info[0], sys.version_info[1] + 1))"
                    OUTPUT_VARIABLE quasimc_pythons OUTPUT_STRIP_TRAILING_WHITESPACE)
    separate_arguments(quasimc_pythons)
    list(GET quasimc_pythons 0 quasimc_python_this)
    list(GET quasimc_pythons 1 quasimc_python_next)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-quasimc)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= ${quasimc_python_this}), python3 (<< ${quasimc_python_next}~), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-xarray, python3-matplotlib")
    set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python package.")
endif()

# Every package has its file of copyright.
foreach(package IN ITEMS program:quasimc library:libquasimc${quasimc_abi} dev:libquasimc-dev python:python3-quasimc)
    string(REPLACE ":" ";" package "${package}")
    list(GET package 0 component)
    list(GET package 1 name)
    if(component IN_LIST CPACK_COMPONENTS_ALL)
        install(FILES "${PROJECT_SOURCE_DIR}/cmake/debian_copyright" DESTINATION "share/doc/${name}" RENAME copyright
                COMPONENT ${component})
    endif()
endforeach()

include(CPack)
