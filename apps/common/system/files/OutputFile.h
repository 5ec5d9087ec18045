// SPDX-License-Identifier: Apache-2.0
#ifndef OutputFile_h
#define OutputFile_h

#include "system/files/FileDescriptor.h"

#include <cstdint>
#include <string>

/** A file that is open for writing at any place. */
class OutputFile
{
public:
  enum class Opening
  {
    New,   ///< it must not exist
    Kept,  ///< it must exist, and keeps what it holds
    Shared ///< likewise, and other machines write other parts of it
  };

  /** \param meant the name that messages call it by
   * \throw std::runtime_error */
  OutputFile(const std::string & path, const std::string & meant, Opening opening = Opening::New);

  /** Gives the file its full size and blocks for it, so that the disk cannot run full later.
   * \return whether the file system can; if not, only bringing the file to the disk tells that there was room
   * \throw std::runtime_error if the disk has no room */
  bool
  Reserve(std::uint64_t size);

  /** Gives the file its full size without blocks for it: others take those for the parts that they write.
   * \throw std::runtime_error if the disk has no room */
  void
  SetSize(std::uint64_t size);

  /** Gives the file a size; what is beyond it is cut off.
   * \throw std::runtime_error */
  void
  Resize(std::uint64_t size);

  /** Gives the file a larger size and blocks for it, whatever the file system can; its bytes stay as they are.
   * \throw std::runtime_error if the disk has no room */
  void
  Extend(std::uint64_t size);

  /** Takes blocks for a part of the file, whose bytes stay as they are.
   * \return whether the file system can
   * \throw std::runtime_error if the disk has no room */
  bool
  ReserveRange(std::uint64_t offset, std::uint64_t count);

  /** Nobody will wait until the file is on the disk: then the disk need not begin with each part that is written. */
  void
  DoNotHurry();

  /** Brings all that was written to the disk.
   * \throw std::runtime_error */
  void
  BringToDisk();

  /** \throw std::runtime_error */
  void
  WriteAt(std::uint64_t offset, const void * bytes, std::uint64_t count);

  /** Nothing can be written afterwards. File systems of other machines tell here what they could not write before.
   * \throw std::runtime_error */
  void
  Close();

private:
  void
  CheckRoom(std::uint64_t size) const;

  std::string    m_Meant;
  FileDescriptor m_File;
  bool           m_IsHurried{ true };
};

#endif
