// SPDX-License-Identifier: Apache-2.0
#include "outputs/PairNaming.h"

#include "headers/DataOwners.h"
#include "headers/PlainHeader.h"
#include "system/files/DiskSync.h"
#include "system/files/OutputFile.h"

#include <stdexcept>
#include <system_error>

namespace fs = std::filesystem;

namespace
{
class PairNaming
{
public:
  explicit PairNaming(const DetachedPair & pair)
    : m_Pair(pair)
    , m_Target(pair.Output.parent_path())
    , m_Written(pair.Folder / pair.DataName)
    , m_Data(m_Target / pair.DataName)
    , m_Voxels(m_Written)
  {}

  /** Nothing refers to the name of the voxels. */
  void
  Name()
  {
    this->AlsoCallVoxels(m_Data);
    this->NameHeader(m_Pair.Folder / m_Pair.Output.filename());
  }

  void
  Replace()
  {
    const fs::path interim = m_Target / MakeInterimDataName(m_Target, m_Pair.DataName);
    try
    {
      this->AlsoCallVoxels(interim);
      this->NameHeader(this->WriteHeader(interim.filename().string()));
    }
    catch (const std::exception &)
    {
      this->GiveBack(interim);
      throw;
    }
    this->GiveFinalNames(interim);
    std::error_code ignored;
    fs::remove(interim, ignored);
  }

private:
  /** Free even where processes that were killed have left theirs. */
  fs::path
  MakeHelperName() const
  {
    return m_Pair.Folder / MakeInterimDataName(m_Pair.Folder, m_Pair.DataName);
  }

  void
  AlsoCallVoxels(const fs::path & name)
  {
    const fs::path  alias = this->MakeHelperName();
    std::error_code error;
    fs::create_hard_link(m_Voxels, alias, error);
    if (!error)
    {
      fs::rename(alias, name);
      return;
    }
    fs::rename(m_Voxels, name); // the file system has no hard links
    m_Voxels = name;
  }

  fs::path
  WriteHeader(const std::string & dataName) const
  {
    const std::string text = m_Pair.ComposeHeader(dataName);
    const fs::path    header = this->MakeHelperName();
    OutputFile        file(header.string(), m_Pair.Output.string());
    file.WriteAt(0, text.data(), text.size());
    file.BringToDisk();
    fs::permissions(header, fs::status(m_Pair.Folder / m_Pair.Output.filename()).permissions());
    return header;
  }

  /** On the disk, too, a header must not come before its voxels. */
  void
  NameHeader(const fs::path & header) const
  {
    BringToDisk(m_Target);
    fs::rename(header, m_Pair.Output);
    BringToDisk(m_Target);
  }

  void
  GiveFinalNames(const fs::path & interim)
  {
    try
    {
      this->AlsoCallVoxels(m_Data);
      this->NameHeader(m_Pair.Folder / m_Pair.Output.filename());
    }
    catch (const std::exception & error)
    {
      // Between two names of one file, this does nothing.
      std::error_code ignored;
      fs::rename(m_Voxels, interim, ignored);
      throw std::runtime_error("its voxels are complete in " + interim.string() +
                               ", but cannot get their name: " + error.what());
    }
  }

  /** Takes a name from the voxels, which stay where they were written. */
  void
  GiveBack(const fs::path & name)
  {
    std::error_code ignored;
    fs::rename(m_Voxels, m_Written, ignored);
    m_Voxels = m_Written;
    fs::remove(name, ignored);
  }

  const DetachedPair & m_Pair;
  const fs::path       m_Target;
  const fs::path       m_Written;
  const fs::path       m_Data;
  fs::path             m_Voxels; // one of their names
};
} // namespace

void
GiveNames(const DetachedPair & pair)
{
  try
  {
    PairNaming naming(pair);
    if (ReadDataName(pair.Output) == pair.DataName)
    {
      naming.Replace();
    }
    else
    {
      naming.Name();
    }
  }
  catch (const fs::filesystem_error & error)
  {
    throw std::runtime_error("cannot write " + pair.Output.string() + ": " + error.code().message());
  }
  catch (const std::runtime_error & error)
  {
    throw std::runtime_error("cannot write " + pair.Output.string() + ": " + error.what());
  }
}
