# quasimc_page(<folder> <files>)
#
# Bundles the page of web/ with esbuild into <folder>: index.html, viewer.css, viewer.js. Node.js is
# optional. Without it, or if the packages of web/package.json can't be had, the files are empty, and
# the program says that it was built without its page. The packages are fetched while configuring,
# once; without a network, QUASIMC_BUILD_PAGE=OFF saves the attempt.

option(QUASIMC_BUILD_PAGE "Build the page in the browser, if Node.js is there" ON)

# Sets <ready> to whether the packages are in web/ of the build folder.
function(quasimc_fetch_page_packages work ready)
    set(${ready} FALSE PARENT_SCOPE)
    find_program(QUASIMC_NODE node)
    find_program(QUASIMC_NPM npm)
    mark_as_advanced(QUASIMC_NODE QUASIMC_NPM)
    # Source packages of the Python module come without web/.
    if(NOT QUASIMC_BUILD_PAGE OR NOT QUASIMC_BUILD_APPS OR NOT QUASIMC_NODE OR NOT QUASIMC_NPM
       OR NOT EXISTS "${PROJECT_SOURCE_DIR}/web/package-lock.json")
        message(STATUS "Page in the browser: not built (needs Node.js and npm)")
        return()
    endif()
    set(omitted --omit=dev)
    if(QUASIMC_BUILD_TESTS)
        set(omitted "") # the tests drive a browser
    endif()
    file(SHA256 "${PROJECT_SOURCE_DIR}/web/package-lock.json" wanted)
    string(APPEND wanted "${omitted}")
    set(present "")
    if(EXISTS "${work}/packages.sha256")
        file(READ "${work}/packages.sha256" present)
    endif()
    if(NOT present STREQUAL wanted)
        message(STATUS "Page in the browser: fetching packages")
        foreach(file package.json package-lock.json .npmrc)
            file(COPY "${PROJECT_SOURCE_DIR}/web/${file}" DESTINATION "${work}")
        endforeach()
        execute_process(
            COMMAND "${QUASIMC_NPM}" ci --ignore-scripts --no-audit --no-fund --prefer-offline
                    ${omitted} --fetch-retries=0 --fetch-timeout=20000
            WORKING_DIRECTORY "${work}"
            TIMEOUT 120
            OUTPUT_VARIABLE said
            ERROR_VARIABLE said
            RESULT_VARIABLE status)
        # The last command checks that esbuild runs here.
        if(status EQUAL 0)
            execute_process(
                COMMAND "${QUASIMC_NODE}" node_modules/esbuild/bin/esbuild --version
                WORKING_DIRECTORY "${work}"
                TIMEOUT 60
                OUTPUT_VARIABLE said
                ERROR_VARIABLE said
                RESULT_VARIABLE status)
        endif()
        if(NOT status EQUAL 0)
            message(WARNING "The program is built without its page in the browser: ${said}")
            return()
        endif()
        file(WRITE "${work}/packages.sha256" "${wanted}")
    endif()
    set(${ready} TRUE PARENT_SCOPE)
endfunction()

function(quasimc_page folder files)
    set(work "${PROJECT_BINARY_DIR}/web")
    set(names index.html viewer.css viewer.js)
    quasimc_fetch_page_packages("${work}" ready)
    if(ready)
        set(target "${work}/dist")
        set_property(
            DIRECTORY
            APPEND
            PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/web/package-lock.json")
        list(TRANSFORM names PREPEND "${target}/" OUTPUT_VARIABLE outputs)
        file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/web/src/*")
        add_custom_command(
            OUTPUT ${outputs}
            COMMAND "${QUASIMC_NODE}" "${PROJECT_SOURCE_DIR}/web/build.mjs" "${work}" "${target}"
            DEPENDS ${sources} "${PROJECT_SOURCE_DIR}/web/build.mjs" "${work}/packages.sha256"
            COMMENT "Bundling the page in the browser"
            VERBATIM)
    else()
        set(target "${work}/none")
        list(TRANSFORM names PREPEND "${target}/" OUTPUT_VARIABLE outputs)
        foreach(output IN LISTS outputs)
            file(WRITE "${output}" "")
        endforeach()
    endif()
    set(QUASIMC_PAGE_READY ${ready} CACHE INTERNAL "Whether the page is built")
    set(${folder} "${target}" PARENT_SCOPE)
    set(${files} "${outputs}" PARENT_SCOPE)
endfunction()
