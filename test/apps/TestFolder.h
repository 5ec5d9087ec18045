// SPDX-License-Identifier: Apache-2.0
#ifndef TestFolder_h
#define TestFolder_h

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

/** A folder for the files of a test. */
class TestFolder
{
public:
  TestFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "volume-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
    {
      throw std::runtime_error("no temporary folder");
    }
    m_Path = std::filesystem::canonical(pattern);
  }
  ~TestFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(m_Path, error);
  }
  TestFolder(const TestFolder &) = delete;
  TestFolder &
  operator=(const TestFolder &) = delete;

  std::string
  operator/(const std::string & name) const
  {
    return (m_Path / name).string();
  }

  void
  WriteFile(const std::string & name, const std::string & content) const
  {
    std::ofstream(m_Path / name, std::ios::binary) << content;
  }

  std::string
  ReadFile(const std::string & name) const
  {
    std::ifstream file(m_Path / name, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  /** The names of all files and folders, and what the files hold. */
  std::map<std::string, std::string>
  GetFiles() const
  {
    std::map<std::string, std::string> files;
    for (const auto & entry : std::filesystem::directory_iterator(m_Path))
    {
      const std::string name = entry.path().filename().string();
      files[name] = entry.is_regular_file() ? this->ReadFile(name) : "";
    }
    return files;
  }

private:
  std::filesystem::path m_Path;
};

#endif
