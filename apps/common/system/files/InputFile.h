// SPDX-License-Identifier: Apache-2.0
#ifndef InputFile_h
#define InputFile_h

#include "system/files/FileDescriptor.h"

#include <cstdint>
#include <string>

/** A regular file that is open for reading at any place. It stays readable while another file takes its name. */
class InputFile
{
public:
  /** \throw std::runtime_error if there is no such file, or it is a folder, a pipe or a device */
  explicit InputFile(const std::string & path);

  const std::string &
  GetPath() const
  {
    return m_Path;
  }

  std::uint64_t
  GetSize() const
  {
    return m_Size;
  }

  /** Reads exactly so many bytes.
   * \throw std::runtime_error if they are not there */
  void
  ReadAt(std::uint64_t offset, void * bytes, std::uint64_t count) const;

  /** Reads what is there of so many bytes. */
  std::string
  ReadTextAt(std::uint64_t offset, std::uint64_t count) const;

private:
  std::uint64_t
  ReadSome(std::uint64_t offset, void * bytes, std::uint64_t count) const;

  std::string    m_Path;
  FileDescriptor m_File;
  std::uint64_t  m_Size = 0;
};

#endif
