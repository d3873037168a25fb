# The installed package: find_package(quasimc REQUIRED), then link quasimc::quasimc.

include(CMakePackageConfigHelpers)

set(quasimc_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/quasimc")
get_property(quasimc_libraries GLOBAL PROPERTY QUASIMC_LIBRARIES)

install(TARGETS quasimc ${quasimc_libraries} EXPORT quasimcTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(
    EXPORT quasimcTargets
    NAMESPACE quasimc::
    DESTINATION "${quasimc_package_dir}")
# The public headers, and no others: users link the modules and never see inside them.
install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/include/quasimc" "${PROJECT_BINARY_DIR}/generated/quasimc"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    FILES_MATCHING
    PATTERN "*.h")
if(TARGET quasimc_app)
    install(TARGETS quasimc_app quasimc_environment RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
    if(TARGET quasimc_ranks)
        install(TARGETS quasimc_ranks LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/quasimc")
    endif()
    # A link, copied as one: QuasiMC by the name of the older program.
    install(FILES "$<TARGET_FILE_DIR:quasimc_environment>/MonteCarlo"
            DESTINATION "${CMAKE_INSTALL_BINDIR}")
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
    DESTINATION "${quasimc_package_dir}")
