# Wrapping ITK for Python parses the public headers with castxml: they must stay plain enough for it.

find_program(CASTXML_EXECUTABLE castxml)
mark_as_advanced(CASTXML_EXECUTABLE)

if(CASTXML_EXECUTABLE)
  # The standard library of GCC relies on sized deallocation, which the Clang within castxml has on demand only.
  set(include_directories $<TARGET_PROPERTY:NonOscillatorySubdivision,INTERFACE_INCLUDE_DIRECTORIES>)
  add_test(
    NAME NonOscillatorySubdivisionHeaders.ParseWithCastXML
    COMMAND "${CASTXML_EXECUTABLE}" --castxml-output=1 --castxml-start _wrapping_
      --castxml-cc-gnu "(" "${CMAKE_CXX_COMPILER}" -std=c++17 ")" -std=c++17 -fsized-deallocation
      -DITK_WRAPPING_PARSER -DITK_MANUAL_INSTANTIATION
      "-I$<JOIN:${include_directories},;-I>"
      -o "${CMAKE_CURRENT_BINARY_DIR}/ParsedHeaders.xml" "${CMAKE_CURRENT_SOURCE_DIR}/ParsedHeaders.cxx"
    COMMAND_EXPAND_LISTS
  )
else()
  add_test(
    NAME NonOscillatorySubdivisionHeaders.ParseWithCastXML
    COMMAND "${CMAKE_COMMAND}" -E echo "skipped: castxml is not installed"
  )
  set_tests_properties(NonOscillatorySubdivisionHeaders.ParseWithCastXML PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")
endif()
