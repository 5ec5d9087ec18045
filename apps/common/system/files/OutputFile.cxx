// SPDX-License-Identifier: Apache-2.0
#include "system/files/OutputFile.h"
#include "system/files/DiskSync.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}

std::string
InMegabytes(std::uint64_t bytes)
{
  return std::to_string(bytes / 1000000) + " MB";
}

int
GetFlags(const OutputFile::Opening opening)
{
  switch (opening)
  {
    case OutputFile::Opening::New:
      return O_CREAT | O_EXCL;
    case OutputFile::Opening::Shared:
      // Where other machines write other parts of the file, NFS must not write whole pages, with what it took for
      // theirs; with synchronous writes, it does not.
      return O_DSYNC;
    default:
      return 0;
  }
}
} // namespace

OutputFile::OutputFile(const std::string & path, const std::string & meant, const Opening opening)
  : m_Meant(meant)
  , m_File(open(path.c_str(), O_WRONLY | O_CLOEXEC | GetFlags(opening), 0666))
{
  if (!m_File.IsOpen())
  {
    Fail(meant, GetLastError().message());
  }
}

void
OutputFile::Close()
{
  if (const std::error_code error = m_File.Close())
  {
    Fail(m_Meant, error.message());
  }
}

void
OutputFile::CheckRoom(std::uint64_t size) const
{
  struct statvfs disk = {};
  if (fstatvfs(m_File.GetNumber(), &disk) == 0 && size / disk.f_frsize > disk.f_bavail)
  {
    Fail(m_Meant,
         "it needs " + InMegabytes(size) + ", and the disk has " +
           InMegabytes(std::uint64_t{ disk.f_bavail } * disk.f_frsize) + " left");
  }
}

bool
OutputFile::Reserve(std::uint64_t size)
{
  // Where the disk is far too small, blocks are not even tried for: they take a while.
  this->CheckRoom(size);
  const bool isReserved = this->ReserveRange(0, size);
  this->Resize(size);
  return isReserved;
}

void
OutputFile::SetSize(std::uint64_t size)
{
  this->CheckRoom(size);
  this->Resize(size);
}

void
OutputFile::Resize(std::uint64_t size)
{
  if (ftruncate(m_File.GetNumber(), static_cast<off_t>(size)) != 0)
  {
    Fail(m_Meant, GetLastError().message());
  }
}

void
OutputFile::Extend(std::uint64_t size)
{
  if (const int error = posix_fallocate(m_File.GetNumber(), 0, static_cast<off_t>(size)))
  {
    Fail(m_Meant, std::generic_category().message(error));
  }
}

bool
OutputFile::ReserveRange(std::uint64_t offset, std::uint64_t count)
{
#ifdef __linux__
  if (count == 0 || fallocate(m_File.GetNumber(), 0, static_cast<off_t>(offset), static_cast<off_t>(count)) == 0)
  {
    return true;
  }
  if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
  {
    Fail(m_Meant, GetLastError().message());
  }
#else
  static_cast<void>(offset);
  static_cast<void>(count);
#endif
  // Not every file system can; then the disk may run full while the voxels are written.
  return false;
}

void
OutputFile::DoNotHurry()
{
  m_IsHurried = false;
}

void
OutputFile::BringToDisk()
{
  if (const std::error_code error = ::BringToDisk(m_File))
  {
    Fail(m_Meant, error.message());
  }
}

void
OutputFile::WriteAt(std::uint64_t offset, const void * bytes, std::uint64_t count)
{
  while (count > 0)
  {
    const auto written =
      pwrite(m_File.GetNumber(), bytes, std::min<std::uint64_t>(count, 1 << 30), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR)
    {
      continue;
    }
    if (written <= 0)
    {
      Fail(m_Meant, std::generic_category().message(written < 0 ? errno : ENOSPC));
    }
#ifdef __linux__
    // The disk begins at once, so that bringing the file to it does not take as long again at the end. A hint.
    if (m_IsHurried)
    {
      (void)sync_file_range(m_File.GetNumber(), static_cast<off_t>(offset), written, SYNC_FILE_RANGE_WRITE);
    }
#endif
    bytes = static_cast<const char *>(bytes) + written;
    offset += static_cast<std::uint64_t>(written);
    count -= static_cast<std::uint64_t>(written);
  }
}
