// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzFolder_h
#define FuzzFolder_h

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <unistd.h>

/** A folder of this process among the temporary files, which goes with it; in memory where TMPDIR says so. It holds
 * data.raw, 64 bytes that headers may name. */
class FuzzFolder
{
public:
  FuzzFolder()
    : m_Path(std::filesystem::temp_directory_path() / ("subdivision-fuzz-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(m_Path);
    this->Write("data.raw", std::string(64, 'd'));
  }

  ~FuzzFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(m_Path, error);
  }

  FuzzFolder(const FuzzFolder &) = delete;
  FuzzFolder &
  operator=(const FuzzFolder &) = delete;

  std::string
  GetPath(const std::string & name) const
  {
    return (m_Path / name).string();
  }

  /** Writes a file and returns its path. */
  std::string
  Write(const std::string & name, const std::string & text) const
  {
    const std::string path = this->GetPath(name);
    std::FILE * const file = std::fopen(path.c_str(), "wb");
    const bool        isWritten = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (file == nullptr || std::fclose(file) != 0 || !isWritten)
    {
      throw std::runtime_error("cannot write " + path);
    }
    return path;
  }

private:
  std::filesystem::path m_Path;
};

#endif
