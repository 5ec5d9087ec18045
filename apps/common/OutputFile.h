// SPDX-License-Identifier: Apache-2.0
#ifndef OutputFile_h
#define OutputFile_h

#include <cstdint>
#include <string>

/** A file that did not exist before, open for writing at any place. */
class OutputFile
{
public:
  /** \param meant the name that messages call it by
   * \throw std::runtime_error */
  OutputFile(const std::string & path, const std::string & meant);
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &
  operator=(const OutputFile &) = delete;

  /** Gives the file its full size and blocks for it, so that the disk cannot run full later.
   * \throw std::runtime_error if the disk has no room */
  void
  Reserve(std::uint64_t size);

  /** \throw std::runtime_error */
  void
  WriteAt(std::uint64_t offset, const void * bytes, std::uint64_t count);

private:
  std::string m_Meant;
  int         m_Descriptor;
};

#endif
