// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryMessages_h
#define LibraryMessages_h

#include <cstdio>
#include <streambuf>
#include <string>

/** Where the program tells the user of errors and progress: stderr, even while it is kept from the libraries. */
std::FILE *
GetTerminal();

/** Keeps from the terminal what the image libraries print while they read and write: errors reach the user as
 * exceptions, in one line, and 3D Slicer reads stdout. The program itself prints with std::printf and to
 * GetTerminal(). */
class LibraryMessages
{
public:
  LibraryMessages();
  ~LibraryMessages();
  LibraryMessages(const LibraryMessages &) = delete;
  LibraryMessages &
  operator=(const LibraryMessages &) = delete;

  /** All that was printed. */
  std::string
  GetText() const;

private:
  std::FILE * const      m_File;
  std::streambuf * const m_Output;
};

#endif
