// SPDX-License-Identifier: Apache-2.0
#include "system/files/FileState.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <sys/stat.h>
#include <zlib.h>

namespace fs = std::filesystem;

namespace
{
/** Names, sizes and times of files, in any order. */
class Files
{
public:
  /** \param name tells it from the others */
  void
  Add(const fs::path & path, const std::string & name)
  {
    struct stat status = {};
    if (stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
    {
      ++m_Number;
      m_Bytes += static_cast<std::uint64_t>(status.st_size);
      const std::int64_t time = status.st_mtim.tv_sec * std::int64_t{ 1000000000 } + status.st_mtim.tv_nsec;
      m_Newest = std::max(m_Newest, time);
      const std::string text = name + '\n' + std::to_string(status.st_size) + '\n' + std::to_string(time);
      m_Checksum += crc32_z(0, reinterpret_cast<const unsigned char *>(text.data()), text.size());
    }
  }

  void
  AddFolder(const fs::path & folder)
  {
    std::error_code error;
    // Folders that must not be read, as lost+found, hold nothing that is read.
    auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    {
      // What runs write for themselves is hidden.
      if (entry->path().filename().string().front() == '.')
      {
        entry.disable_recursion_pending();
        continue;
      }
      this->Add(entry->path(), entry->path().lexically_relative(folder).string());
    }
    if (error)
    {
      throw std::runtime_error("cannot list the files of " + folder.string() + ": " + error.message());
    }
  }

  std::string
  Describe() const
  {
    return std::to_string(m_Number) + (m_Number == 1 ? " file of " : " files of ") + std::to_string(m_Bytes) +
           " bytes, changed at " + std::to_string(m_Newest) + ", checksum " + std::to_string(m_Checksum);
  }

private:
  std::uint64_t m_Number = 0;
  std::uint64_t m_Bytes = 0;
  std::int64_t  m_Newest = 0;
  std::uint64_t m_Checksum = 0; // of what names which size and time; where files change places, all else stays
};
} // namespace

std::string
DescribeFiles(const fs::path & image)
{
  Files           files;
  std::error_code error;
  if (fs::is_directory(image, error))
  {
    files.AddFolder(image);
    return files.Describe();
  }
  files.Add(image, "");
  for (const char * const ending : { ".raw", ".zraw", ".raw.gz", ".img", ".img.gz", ".hdr" })
  {
    const fs::path data = fs::path(image).replace_extension(ending);
    if (data != image)
    {
      files.Add(data, ending);
    }
  }
  return files.Describe();
}

void
CheckFiles(const fs::path & image, const std::string & description)
{
  if (DescribeFiles(image) != description)
  {
    throw std::runtime_error("cannot read " + image.string() + ": it was changed meanwhile; run again");
  }
}
