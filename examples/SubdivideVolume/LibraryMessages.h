// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryMessages_h
#define LibraryMessages_h

#include <iostream>
#include <sstream>

/** Keeps from the terminal what the image libraries print to std::cout and std::cerr while they read and write: errors
 * reach the user as exceptions, in one line, and 3D Slicer reads stdout. The program itself prints with std::printf. */
class LibraryMessages
{
public:
  LibraryMessages()
    : m_Output(std::cout.rdbuf(m_Text.rdbuf()))
    , m_Error(std::cerr.rdbuf(m_Text.rdbuf()))
  {}

  ~LibraryMessages()
  {
    std::cout.rdbuf(m_Output);
    std::cerr.rdbuf(m_Error);
  }

  LibraryMessages(const LibraryMessages &) = delete;
  LibraryMessages &
  operator=(const LibraryMessages &) = delete;

private:
  std::ostringstream     m_Text;
  std::streambuf * const m_Output;
  std::streambuf * const m_Error;
};

#endif
