# The installed package: find_package(quasimc REQUIRED), then link quasimc::quasimc (C++, static); or
# find_package(quasimc REQUIRED COMPONENTS c), then link quasimc::c (C, shared).
#
# Each file belongs to a component, which is a Debian package too (QuasimcDebian.cmake): program,
# library, dev, python.

include(CMakePackageConfigHelpers)

set(quasimc_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/quasimc")
get_property(quasimc_libraries GLOBAL PROPERTY QUASIMC_LIBRARIES)

install(TARGETS quasimc ${quasimc_libraries} EXPORT quasimcTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(TARGETS quasimc_shared EXPORT quasimcSharedTargets
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT dev)
foreach(targets IN ITEMS quasimcTargets quasimcSharedTargets)
    install(
        EXPORT ${targets}
        NAMESPACE quasimc::
        DESTINATION "${quasimc_package_dir}"
        COMPONENT dev)
endforeach()
# The public headers, and no others: users link the modules and never see inside them.
install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/include/quasimc" "${PROJECT_BINARY_DIR}/generated/quasimc"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    COMPONENT dev
    FILES_MATCHING
    PATTERN "*.h")
if(TARGET quasimc_app)
    install(TARGETS quasimc_app quasimc_environment
            RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
    if(TARGET quasimc_ranks)
        install(TARGETS quasimc_ranks
                LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/quasimc" COMPONENT program)
    endif()
    # A link, copied as one: QuasiMC by the name of the older program.
    install(FILES "$<TARGET_FILE_DIR:quasimc_environment>/MonteCarlo"
            DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
endif()

# The Python package, in the folder that Debian's Python searches under /usr, or in a wheel, with the
# program.
set(QUASIMC_PYTHON_DESTINATION "lib/python3/dist-packages"
    CACHE STRING "Folder of the Python package, below the prefix")
if(SKBUILD)
    set(QUASIMC_PYTHON_DESTINATION .)
endif()
if(SKBUILD AND TARGET quasimc_app)
    install(TARGETS quasimc_app RUNTIME DESTINATION "${SKBUILD_SCRIPTS_DIR}" COMPONENT python)
endif()
if(TARGET quasimc_python)
    install(TARGETS quasimc_python
            LIBRARY DESTINATION "${QUASIMC_PYTHON_DESTINATION}/quasimc" COMPONENT python)
    install(
        DIRECTORY "${PROJECT_SOURCE_DIR}/python/quasimc"
        DESTINATION "${QUASIMC_PYTHON_DESTINATION}"
        COMPONENT python
        FILES_MATCHING
        PATTERN "*.py"
        PATTERN "*.pyi"
        PATTERN "py.typed"
        PATTERN "__pycache__" EXCLUDE)
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/quasimcConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/quasimcConfig.cmake"
                              INSTALL_DESTINATION "${quasimc_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/quasimcConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
    FILES "${PROJECT_BINARY_DIR}/quasimcConfig.cmake"
          "${PROJECT_BINARY_DIR}/quasimcConfigVersion.cmake"
          "${PROJECT_SOURCE_DIR}/cmake/FindQuasimcEmbree.cmake"
          "${PROJECT_SOURCE_DIR}/cmake/FindQuasimcTomlplusplus.cmake"
    DESTINATION "${quasimc_package_dir}"
    COMPONENT dev)
