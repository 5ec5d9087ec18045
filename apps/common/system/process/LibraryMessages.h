// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryMessages_h
#define LibraryMessages_h

#include "system/files/FileDescriptor.h"

#include <streambuf>
#include <string>

/** Keeps from the terminal what the image libraries print while they read and write: errors reach the user as
 * exceptions, in one line, and 3D Slicer reads stdout. The program itself prints with std::printf and to
 * GetTerminal() (Terminal.h). */
class LibraryMessages
{
public:
  LibraryMessages();
  ~LibraryMessages();
  LibraryMessages(const LibraryMessages &) = delete;
  LibraryMessages &
  operator=(const LibraryMessages &) = delete;

  /** All that was printed since. */
  std::string
  GetText() const;

  /** Makes the file that holds what is printed. A process that is forked afterwards shares it. */
  static void
  Prepare();

  /** All that was printed while any such object existed. */
  static std::string
  GetWholeText();

private:
  const std::size_t      m_Start;
  const FileDescriptor   m_Errors; // where they went before
  std::streambuf * const m_Output;
};

#endif
