# The rows of a table of numbers, as an initializer list: {1,2,3}, a line. Lines of anything else are
# left out.
function(quasimc_table_of_numbers csv inc)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${csv}")
    file(STRINGS "${csv}" rows REGEX "^[0-9]")
    list(JOIN rows "},\n{" text)
    file(CONFIGURE OUTPUT "${inc}" CONTENT "{${text}}\n" @ONLY)
endfunction()
