file(STRINGS "${SOURCE}/CITATION.cff" line REGEX "^version: ")
if(NOT line STREQUAL "version: ${VERSION}")
    message(FATAL_ERROR "CITATION.cff says '${line}', CMakeLists.txt ${VERSION}")
endif()
