# Finds Embree 4, or else 3, and makes the target QuasimcEmbree::embree, which carries the
# definition QUASIMC_EMBREE_MAJOR.  Used by our own build and by the installed package.

set(QuasimcEmbree_MAJOR "")
foreach(major 4 3)
    if(NOT QuasimcEmbree_MAJOR)
        find_package(embree ${major} CONFIG QUIET)
        if(embree_FOUND AND TARGET embree)
            set(QuasimcEmbree_MAJOR ${major})
            set(QuasimcEmbree_LIBRARY embree)
        endif()
    endif()
endforeach()

# Some distributions ship the library without its CMake files.
foreach(major 4 3)
    if(NOT QuasimcEmbree_MAJOR)
        find_path(QuasimcEmbree_INCLUDE_DIR_${major} embree${major}/rtcore.h)
        find_library(QuasimcEmbree_LIBRARY_${major} embree${major})
        mark_as_advanced(QuasimcEmbree_INCLUDE_DIR_${major} QuasimcEmbree_LIBRARY_${major})
        if(QuasimcEmbree_INCLUDE_DIR_${major} AND QuasimcEmbree_LIBRARY_${major})
            set(QuasimcEmbree_MAJOR ${major})
            set(QuasimcEmbree_LIBRARY "${QuasimcEmbree_LIBRARY_${major}}")
            set(QuasimcEmbree_INCLUDE_DIR "${QuasimcEmbree_INCLUDE_DIR_${major}}")
        endif()
    endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
    QuasimcEmbree
    REQUIRED_VARS QuasimcEmbree_LIBRARY QuasimcEmbree_MAJOR
    REASON_FAILURE_MESSAGE "Embree 3 or 4 is needed (Debian and Ubuntu: libembree-dev)")

if(QuasimcEmbree_FOUND AND NOT TARGET QuasimcEmbree::embree)
    add_library(QuasimcEmbree::embree INTERFACE IMPORTED)
    set_target_properties(
        QuasimcEmbree::embree
        PROPERTIES INTERFACE_LINK_LIBRARIES "${QuasimcEmbree_LIBRARY}"
                   INTERFACE_COMPILE_DEFINITIONS "QUASIMC_EMBREE_MAJOR=${QuasimcEmbree_MAJOR}"
                   INTERFACE_INCLUDE_DIRECTORIES "${QuasimcEmbree_INCLUDE_DIR}")
endif()
