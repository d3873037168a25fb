# quasimc_module(NAME <module> [COLD] SOURCES a.cpp ... PUBLIC <lib>... PRIVATE <lib>...)
#
# Makes the static library quasimc_<module> (alias quasimc::<module>) of the current folder and
# adds it to the installed package, without its headers: those of users are in include/quasimc/
# (tools/check_layers.py knows which module each belongs to).  A library is the name of a lower
# module or of a third party in the list below.  PUBLIC if a header includes it, PRIVATE if only
# sources do.  A module without SOURCES is made of headers alone.
#
# COLD modules take little time of a run, such as readers of small files: in a release build they
# are optimized lightly, which halves the time of the compiler.

set(QUASIMC_THIRD_PARTY_fmt fmt::fmt)
set(QUASIMC_THIRD_PARTY_threads Threads::Threads)
set(QUASIMC_THIRD_PARTY_embree QuasimcEmbree::embree)
set(QUASIMC_THIRD_PARTY_boost_headers $<BUILD_INTERFACE:Boost::headers>)
set(QUASIMC_THIRD_PARTY_highway hwy::hwy)
set(QUASIMC_THIRD_PARTY_tomlplusplus QuasimcTomlplusplus::tomlplusplus)
set(QUASIMC_THIRD_PARTY_nlohmann_json $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
set(QUASIMC_THIRD_PARTY_pugixml pugixml::pugixml)
set(QUASIMC_THIRD_PARTY_cli11 CLI11::CLI11)
set(QUASIMC_THIRD_PARTY_png PNG::PNG)
set(QUASIMC_THIRD_PARTY_netcdf_headers $<BUILD_INTERFACE:QuasimcNetcdf::headers>)
set(QUASIMC_THIRD_PARTY_dl ${CMAKE_DL_LIBS})

# Sets QUASIMC_LAYER_<module> for every module of the table, and QUASIMC_MODULES in order.
set(QUASIMC_MODULES "")
file(STRINGS "${PROJECT_SOURCE_DIR}/src/layers.txt" quasimc_rows REGEX "^[0-9]")
set_property(
    DIRECTORY
    APPEND
    PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/layers.txt")
foreach(row IN LISTS quasimc_rows)
    separate_arguments(names UNIX_COMMAND "${row}")
    list(POP_FRONT names layer)
    foreach(name IN LISTS names)
        set(QUASIMC_LAYER_${name} ${layer})
        list(APPEND QUASIMC_MODULES ${name})
    endforeach()
endforeach()

# Turns the names of modules and third parties into targets; refuses a link against the layers.
function(quasimc_resolve module result)
    set(targets "")
    foreach(name IN LISTS ARGN)
        if(DEFINED QUASIMC_LAYER_${name})
            if(NOT QUASIMC_LAYER_${name} LESS QUASIMC_LAYER_${module})
                message(FATAL_ERROR "Module ${module} (layer ${QUASIMC_LAYER_${module}}) links "
                                    "${name} (layer ${QUASIMC_LAYER_${name}}); "
                                    "only lower layers may be linked.")
            endif()
            if(NOT TARGET quasimc_${name})
                message(FATAL_ERROR "Module ${module} links ${name}, which does not exist.")
            endif()
            list(APPEND targets quasimc_${name})
        elseif(DEFINED QUASIMC_THIRD_PARTY_${name})
            list(APPEND targets ${QUASIMC_THIRD_PARTY_${name}})
        else()
            message(FATAL_ERROR "Module ${module} links ${name}, which is neither a module of "
                                "layers.txt nor a library named in QuasimcModule.cmake.")
        endif()
    endforeach()
    set(${result} ${targets} PARENT_SCOPE)
endfunction()

# Modules that read what comes from outside: fuzzers follow which way their code goes. The others,
# which compute, would be slowed down for nothing.
set(QUASIMC_FUZZED_MODULES base coupling files growth light meshio options parallel resultio runfile scene text
                           weather window)

# Modules that read, write and talk: under sanitizers the optimizer takes longer for them than the
# tests of what they do gain by it.
set(QUASIMC_LIGHT_MODULES capi files meshio netcdf options parallel picture resultio runfile text weather
                          window)

# quasimc_vector_sources(<source>...): sources that use Highway, compiled once for each kind of vector unit by
# including itself.  Highway chooses among them at run time and does not compile under -march=native, so
# the source is compiled for any x86-64, whatever CXXFLAGS says.
function(quasimc_vector_sources)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-march=x86-64;-mtune=generic")
    endif()
endfunction()

function(quasimc_module)
    cmake_parse_arguments(PARSE_ARGV 0 arg "COLD" "NAME" "SOURCES;PUBLIC;PRIVATE;DEFINITIONS")
    if(NOT DEFINED QUASIMC_LAYER_${arg_NAME})
        message(FATAL_ERROR "Module ${arg_NAME} has no row in src/layers.txt.")
    endif()
    quasimc_resolve(${arg_NAME} public ${arg_PUBLIC})
    quasimc_resolve(${arg_NAME} private ${arg_PRIVATE})
    set(target quasimc_${arg_NAME})
    if(arg_SOURCES)
        add_library(${target} STATIC ${arg_SOURCES})
        set(scope PUBLIC)
        set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
        quasimc_unity(${target} modules)
        target_compile_definitions(${target} PRIVATE ${arg_DEFINITIONS})
        if(QUASIMC_BUILD_FUZZ AND arg_NAME IN_LIST QUASIMC_FUZZED_MODULES)
            target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
        endif()
        if(QUASIMC_SANITIZE AND arg_NAME IN_LIST QUASIMC_LIGHT_MODULES)
            target_compile_options(${target} PRIVATE -O0)
        endif()
        target_link_libraries(${target} PUBLIC ${public} PRIVATE ${private}
                                                                 $<BUILD_INTERFACE:quasimc_settings>)
        if(arg_COLD)
            target_compile_options(${target} PRIVATE ${QUASIMC_COLD_OPTIMIZATION})
        endif()
    else()
        add_library(${target} INTERFACE)
        set(scope INTERFACE)
        target_link_libraries(${target} INTERFACE ${public})
    endif()
    add_library(quasimc::${arg_NAME} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_NAME})
    target_compile_features(${target} ${scope} cxx_std_20)
    target_include_directories(
        ${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
        $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)
    set_property(GLOBAL APPEND PROPERTY QUASIMC_LIBRARIES ${target})
endfunction()
