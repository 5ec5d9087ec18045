# The public headers: plain enough for castxml, which parses them where ITK is wrapped for Python; and those of the kernel
# and array layers each by itself, without ITK.

find_program(CASTXML_EXECUTABLE castxml)
mark_as_advanced(CASTXML_EXECUTABLE)

# What a user of the module compiles with.
set(include_directories $<TARGET_PROPERTY:NonOscillatorySubdivisionGTestDriver,INCLUDE_DIRECTORIES>)

if(CASTXML_EXECUTABLE)
  separate_arguments(compiler_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
  # The standard library of GCC relies on sized deallocation, which the Clang within castxml has on demand only.
  add_test(
    NAME NonOscillatorySubdivisionHeaders.ParseWithCastXML
    COMMAND "${CASTXML_EXECUTABLE}" --castxml-output=1 --castxml-start _wrapping_
      --castxml-cc-gnu "(" "${CMAKE_CXX_COMPILER}" -std=c++17 ")" -std=c++17 -fsized-deallocation
      ${compiler_flags} -DITK_WRAPPING_PARSER -DITK_MANUAL_INSTANTIATION
      "-I$<JOIN:${include_directories},;-I>"
      -o "${CMAKE_CURRENT_BINARY_DIR}/ParsedHeaders.xml" "${CMAKE_CURRENT_LIST_DIR}/ParsedHeaders.cxx"
    COMMAND_EXPAND_LISTS
  )
else()
  add_skipped_test(NonOscillatorySubdivisionHeaders.ParseWithCastXML "castxml is not installed")
endif()

file(GLOB plain_headers CONFIGURE_DEPENDS "${NonOscillatorySubdivision_SOURCE_DIR}/include/NonOscillatorySubdivision/*.h")
foreach(header IN LISTS plain_headers)
  get_filename_component(name "${header}" NAME_WE)
  set(test "NonOscillatorySubdivisionHeaders.${name}AloneWithoutITK")
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    add_test(
      NAME ${test}
      COMMAND "${CMAKE_CXX_COMPILER}" -std=c++17 -fsyntax-only -Wall -Wextra -Werror
        "-I${NonOscillatorySubdivision_SOURCE_DIR}/include" "-I${NonOscillatorySubdivision_BINARY_DIR}/include"
        -include "NonOscillatorySubdivision/${name}.h" -x c++ /dev/null
    )
  else()
    add_skipped_test(${test} "it needs a compiler with the options of GCC")
  endif()
endforeach()

# Images that the filter does not take are refused by the compiler, in the filter's words.
foreach(kind Adaptor LabelMap SpecialCoordinates Matrices VariableLength LongDoubles BoolOfLabels)
  set(test "NonOscillatorySubdivisionHeaders.Refuse${kind}")
  if(kind MATCHES "Matrices|VariableLength|LongDoubles")
    set(message "Pixels to be subdivided are, or consist of, integers")
  elseif(kind STREQUAL "BoolOfLabels")
    set(message "Labels other than those of bool do not fit")
  else()
    set(message "Images to be subdivided are itk::Image or itk::VectorImage")
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    add_test(
      NAME ${test}
      COMMAND "${CMAKE_CXX_COMPILER}" -std=c++17 -fsyntax-only -DREFUSED_IMAGE=${kind}
        "-I$<JOIN:${include_directories},;-I>" "${CMAKE_CURRENT_LIST_DIR}/RefusedImages.cxx"
      COMMAND_EXPAND_LISTS
    )
    set_tests_properties(${test} PROPERTIES PASS_REGULAR_EXPRESSION "${message}")
  else()
    add_skipped_test(${test} "it needs a compiler with the options of GCC")
  endif()
endforeach()
