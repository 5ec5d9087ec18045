// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryMessages_h
#define LibraryMessages_h

#include <cstdio>
#include <streambuf>
#include <string>
#include <vector>

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
  const int              m_Errors; // where they went before
  std::streambuf * const m_Output;
};

/** The warnings among what libraries printed: each once, in one line, without places in source code; of many, the first
 * few. */
std::vector<std::string>
FindLibraryWarnings(const std::string & text);

#endif
