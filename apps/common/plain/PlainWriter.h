// SPDX-License-Identifier: Apache-2.0
#ifndef PlainWriter_h
#define PlainWriter_h

#include "deflate/ParallelDeflate.h"
#include "headers/PlainHeader.h"
#include "outputs/TemporaryFolder.h"
#include "system/files/OutputFile.h"
#include "volumes/VolumeWriter.h"

#include <filesystem>
#include <memory>
#include <string>

/** Writes voxels behind a text header: .mha, .nrrd, or .mhd and .nhdr with the voxels in a file beside them. The header
 * is composed from the grid and the metadata that the description has, and from nothing else. */
class PlainWriter : public VolumeWriter
{
public:
  PlainWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn);
  ~PlainWriter() override;

  std::vector<std::filesystem::path>
  GetReplacedFiles() const override;

  bool
  WritesParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Begin(const ImageDescription & description) override;

  void
  Write(const itk::Subdivision::Box & box, const void * voxels) override;

  void
  Commit() override;

private:
  /** What the header is in the end. */
  std::string
  ComposeHeader(const std::string & dataName) const;

  std::string                      m_Path;
  OutputOptions                    m_Options;
  WarningSink                      m_Warn;
  ImageDescription                 m_Description;
  PlainHeader                      m_Header;
  std::unique_ptr<TemporaryFolder> m_Folder;
  std::unique_ptr<OutputFile>      m_HeaderFile;
  std::unique_ptr<OutputFile>      m_DataFile; // null: the header's file
  std::uint64_t                    m_DataOffset = 0;
  std::uint64_t                    m_BytesWritten = 0; // of voxels
  std::unique_ptr<ParallelDeflate> m_Deflate;
  std::uint64_t                    m_CompressedBytes = 0;
};

#endif
