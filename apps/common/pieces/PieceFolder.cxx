// SPDX-License-Identifier: Apache-2.0
#include "pieces/PieceFolder.h"
#include "outputs/ReplacedFiles.h"
#include "pieces/AgreementText.h"
#include "pieces/PieceMark.h"
#include "system/files/DiskSync.h"
#include "system/files/FileIdentity.h"
#include "system/files/FolderLock.h"
#include "system/files/NameExchange.h"
#include "system/files/UniqueFolder.h"
#include "system/process/FinishLock.h"
#include "system/process/Interrupt.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
constexpr const char * AgreementName = "agreement";
constexpr const char * PiecesKey = "number of pieces";
constexpr const char * IdentityKey = "identity";

fs::path
GetFolder(const fs::path & output)
{
  return output.parent_path() / ("." + output.filename().string() + ".pieces");
}

/** A new folder for this process, whose name starts so. */
fs::path
MakeOwnFolder(const fs::path & start, std::error_code & error)
{
  const fs::path folder = MakeUniqueFolder(start, error);
  if (!error)
  {
    AllowUsualAccess(folder); // others may be other users of the group
  }
  return folder;
}

std::optional<unsigned int>
ParseNumber(const std::string & text)
{
  std::istringstream stream(text);
  unsigned int       number = 0;
  return stream >> number ? std::optional<unsigned int>(number) : std::nullopt;
}

/** Writes a small file that is there whole or not at all. */
std::error_code
WriteAtOnce(const fs::path & unnamed, const fs::path & path, const std::string & text)
{
  std::ofstream(unnamed, std::ios::binary) << text;
  std::error_code error;
  const bool      isWhole = fs::file_size(unnamed, error) == text.size();
  if (!error && !isWhole)
  {
    return std::make_error_code(std::errc::no_space_on_device);
  }
  return error ? error : BringToDiskAs(unnamed, path);
}
} // namespace

PieceFolder::PieceFolder(const fs::path & output, const unsigned int pieces)
  : m_Output(output)
  , m_Folder(GetFolder(output))
  , m_Pieces(pieces)
{}

PieceFolder::~PieceFolder()
{
  if (!m_Temporary.empty())
  {
    RemoveTemporaryFolder(HoldInterrupts(), m_Temporary);
  }
}

void
PieceFolder::Fail(const std::string & reason) const
{
  throw std::runtime_error("cannot write " + m_Output.string() + ": " + reason);
}

std::optional<unsigned int>
PieceFolder::FindNumberOfPieces(const fs::path & output)
{
  const fs::path  agreement = GetFolder(output) / AgreementName;
  std::error_code error;
  if (!fs::exists(agreement, error) && error)
  {
    throw std::runtime_error("cannot read " + agreement.string() + ": " + error.message());
  }
  return ParseNumber(Find(ReadAgreement(agreement), PiecesKey));
}

std::optional<unsigned int>
PieceFolder::FindNumberOfCompletePieces(const fs::path & output)
{
  return ParseNumber(Find(ParseAgreement(ReadMark(output)), PiecesKey));
}

bool
PieceFolder::TryToJoin(const PieceAgreement & agreement)
{
  m_Agreement = OpenToLock(m_Folder / AgreementName);
  if (!m_Agreement.IsOpen())
  {
    const std::error_code error = GetLastError();
    if (error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
    {
      this->Fail("its pieces in " + m_Folder.string() + " cannot be joined: " + error.message());
    }
    return false;
  }
  const PieceAgreement theirs = ReadAgreement(m_Folder / AgreementName);
  m_Identity = Find(theirs, IdentityKey);
  for (const auto & [key, value] : agreement)
  {
    const std::string other = Find(theirs, key);
    if (other != MakeOneWord(value))
    {
      this->Fail("its pieces are being made with another " + key + ": " + (other.empty() ? "none" : other) + ", not " +
                 MakeOneWord(value) + "; to begin anew, remove " + m_Folder.string());
    }
  }
  return true;
}

/** What is begun appears at once, whole. */
void
PieceFolder::Begin(const PieceAgreement & agreement, const PieceWriter & writer)
{
  this->MakeTemporaryFolder(m_Folder.string() + ".", m_Output);
  for (const char * const name : { "output", "notes", "temporary" })
  {
    fs::create_directory(m_Temporary / name);
  }
  writer.LayOut(m_Temporary / "output");
  const std::string text =
    Compose(agreement) + IdentityKey + (": " + GetIdentity(m_Temporary / "output" / m_Output.filename())) + "\n";
  std::error_code error = WriteAtOnce(m_Temporary / "unnamed", m_Temporary / AgreementName, text);
  if (error)
  {
    this->Fail(error.message());
  }
  const auto lock = HoldInterrupts();
  // It fails where another process was faster, since the folder is not empty.
  fs::rename(m_Temporary, m_Folder, error);
  if (error)
  {
    RemoveTemporaryFolder(lock, m_Temporary);
  }
  else
  {
    RemoveWhenInterrupted(lock, {}, {});
  }
  m_Temporary.clear();
}

bool
PieceFolder::Join(const PieceAgreement & agreement, const PieceWriter & writer)
{
  constexpr int most = 10; // others may come and go in between
  for (int i = 0; i < most; ++i)
  {
    if (this->TryToJoin(agreement))
    {
      return true;
    }
    if (ReadMark(m_Output) == Compose(agreement))
    {
      return false;
    }
    this->Begin(agreement, writer);
  }
  this->Fail("the folder " + m_Folder.string() + " is not one of pieces; remove it");
}

fs::path
PieceFolder::GetOutputFolder() const
{
  return m_Folder / "output";
}

void
PieceFolder::MakeTemporaryFolder(const fs::path & start, const fs::path & unfinished)
{
  std::error_code error;
  const auto      lock = HoldInterrupts();
  m_Temporary = MakeOwnFolder(start, error);
  if (error)
  {
    this->Fail(error.message());
  }
  RemoveWhenInterrupted(lock, m_Temporary, unfinished);
}

const fs::path &
PieceFolder::MakeTemporaryFolder()
{
  this->MakeTemporaryFolder(m_Folder / "temporary" / "", {});
  return m_Temporary;
}

std::optional<std::uint32_t>
PieceFolder::FindNote(const unsigned int piece) const
{
  const fs::path path = m_Folder / "notes" / std::to_string(piece);
  errno = 0;
  std::ifstream file(path);
  std::uint32_t checksum = 0;
  if (file >> checksum)
  {
    return checksum;
  }
  // Not asked again: another process may have noted it since.
  if (!file.is_open() && (errno == ENOENT || errno == ENOTDIR))
  {
    return std::nullopt;
  }
  this->Fail("it is not known whether piece " + std::to_string(piece) + " is done: " + path.string() +
             " cannot be read");
}

void
PieceFolder::Note(const unsigned int piece, const std::uint32_t checksum)
{
  const std::error_code error =
    WriteAtOnce(m_Temporary / "note", m_Folder / "notes" / std::to_string(piece), std::to_string(checksum) + "\n");
  if (error)
  {
    this->Fail("piece " + std::to_string(piece) + " is done, but cannot be noted: " + error.message());
  }
}

std::vector<unsigned int>
PieceFolder::FindMissing() const
{
  std::vector<unsigned int> missing;
  for (unsigned int piece = 1; piece <= m_Pieces; ++piece)
  {
    if (!this->FindNote(piece))
    {
      missing.push_back(piece);
    }
  }
  return missing;
}

bool
PieceFolder::IsFinished() const
{
  return !m_Identity.empty() && GetIdentity(m_Output) == m_Identity;
}

bool
PieceFolder::IsFinishedByAnother() const
{
  const FinishLock lock(m_Agreement, m_Folder);
  return this->IsFinished();
}

bool
PieceFolder::Finish(const PieceWriter & writer)
{
  if (!this->FindMissing().empty())
  {
    return this->IsFinished();
  }
  const FinishLock  alone(m_Agreement, m_Folder);
  const std::string joined = GetIdentity(m_Agreement);
  const bool        isStillThere = !joined.empty() && GetIdentity(m_Folder / AgreementName) == joined;
  if (isStillThere && !this->IsFinished())
  {
    this->Complete(writer);
  }
  if (!this->IsFinished())
  {
    this->Fail("another process has replaced or removed it");
  }
  if (isStillThere)
  {
    this->Remove();
  }
  return true;
}

void
PieceFolder::Complete(const PieceWriter & writer) const
{
  const fs::path written = this->GetOutputFolder() / m_Output.filename();
  if (GetIdentity(written) != m_Identity)
  {
    this->Fail("its pieces were all done, but it has been replaced or removed since; to begin anew, remove " +
               m_Folder.string());
  }
  writer.CheckAll(this->GetOutputFolder());
  PieceAgreement agreement = ReadAgreement(m_Folder / AgreementName);
  agreement.pop_back(); // the identity
  MarkAsComplete(written, Compose(agreement));
  const FolderLock              alone(m_Output.parent_path()); // against runs to the same output
  const std::optional<fs::path> oldData = writer.FindOldData();
  const auto                    lock = HoldInterrupts();
  this->GiveNames(writer);
  if (oldData)
  {
    std::error_code ignored;
    fs::remove(*oldData, ignored);
  }
}

void
PieceFolder::GiveNames(const PieceWriter & writer) const
{
  const fs::path folder = this->GetOutputFolder();
  for (const fs::directory_entry & entry : fs::directory_iterator(folder))
  {
    KeepPermissions(m_Output.parent_path() / entry.path().filename(), entry.path());
    if (const std::error_code error = BringToDisk(entry.path()))
    {
      this->Fail(error.message());
    }
  }
  if (const auto pair = writer.FindPair(folder))
  {
    ::GiveNames(*pair);
    return;
  }
  std::error_code unknown;
  const bool      replacesFolder = fs::is_directory(m_Output, unknown);
  if (const std::error_code error = GiveName(folder / m_Output.filename(), m_Output, replacesFolder))
  {
    this->Fail(error.message());
  }
  BringToDisk(m_Output.parent_path());
}

/** Under another name first, so that nobody joins what is going. */
void
PieceFolder::Remove() const
{
  std::error_code error;
  fs::path        going = MakeOwnFolder(m_Folder.string() + ".", error);
  const auto      lock = HoldInterrupts();
  if (going.empty()) // the disk is full, perhaps
  {
    fs::remove(m_Folder / AgreementName, error);
    going = m_Folder;
  }
  else
  {
    fs::rename(m_Folder, going, error);
  }
  RemoveWhenInterrupted(lock, going, {});
  RemoveTemporaryFolder(lock, going);
}
