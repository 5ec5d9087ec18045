# The manual page, made of what the program says of itself.
find_program(HELP2MAN help2man)
mark_as_advanced(HELP2MAN)
if(NOT HELP2MAN)
  message(STATUS "help2man was not found: the manual page of SubdivideVolume is not made.")
  return()
endif()
set(page "${CMAKE_CURRENT_BINARY_DIR}/SubdivideVolume.1")
add_custom_command(
  OUTPUT "${page}"
  COMMAND "${HELP2MAN}" --no-info --no-discard-stderr --section=1 "--name=double the resolution of an image"
    "--output=${page}" $<TARGET_FILE:SubdivideVolume>
  DEPENDS SubdivideVolume
  COMMENT "Making the manual page of SubdivideVolume"
  VERBATIM
)
add_custom_target(SubdivideVolumeManualPage ALL DEPENDS "${page}")
install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
