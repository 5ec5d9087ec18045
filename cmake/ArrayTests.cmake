# The tests of the kernel and the array layer, which need no ITK.
get_filename_component(tests "${CMAKE_CURRENT_LIST_DIR}/../test" ABSOLUTE)
file(GLOB array_tests CONFIGURE_DEPENDS "${tests}/kernel/*.cxx" "${tests}/array/*GTest.cxx")
