# Installs the package into a folder of the build tree, and there a separate project finds it, builds and runs.

set(installed_prefix "${CMAKE_CURRENT_BINARY_DIR}/installed")
add_test(
  NAME NonOscillatorySubdivisionPackage.Install
  COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --config "$<CONFIG>" --prefix "${installed_prefix}"
)
set_tests_properties(NonOscillatorySubdivisionPackage.Install PROPERTIES FIXTURES_SETUP installed_package)

add_test(
  NAME NonOscillatorySubdivisionPackage.FindPackage
  COMMAND "${CMAKE_CTEST_COMMAND}"
    --build-and-test "${PROJECT_SOURCE_DIR}/examples/find_package" "${CMAKE_CURRENT_BINARY_DIR}/find_package"
    --build-generator "${CMAKE_GENERATOR}"
    --build-options
      "-DCMAKE_PREFIX_PATH=${installed_prefix}"
      "-DITK_DIR=${ITK_DIR}"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
      "-DCMAKE_BUILD_TYPE=$<CONFIG>"
    --test-command UseSubdivision
)
# The program prints a subdivided step; two of its children are 176 and 386 of 1024.
set_tests_properties(NonOscillatorySubdivisionPackage.FindPackage PROPERTIES
  FIXTURES_REQUIRED installed_package
  PASS_REGULAR_EXPRESSION "0\\.171875[\r\n]+0\\.376953"
)
