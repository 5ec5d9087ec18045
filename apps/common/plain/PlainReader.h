// SPDX-License-Identifier: Apache-2.0
#ifndef PlainReader_h
#define PlainReader_h

#include "deflate/InflateStream.h"
#include "headers/PlainLayout.h"
#include "system/files/InputFile.h"
#include "volumes/VolumeReader.h"

#include <memory>
#include <vector>

/** Reads voxels that stand in files behind a text header, or elsewhere: any part without the rest; from a compressed
 * stream forward, keeping the last part for the next one to overlap. */
class PlainReader : public VolumeReader
{
public:
  PlainReader(const std::string & path, const PlainLayout & layout);

  std::vector<std::string>
  GetFiles() const override;

  bool
  ReadsParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Read(const itk::Subdivision::Box & box, void * voxels) override;

private:
  void
  ReadBytes(std::uint64_t offset, char * bytes, std::uint64_t count);
  void
  ReadStored(std::uint64_t offset, char * bytes, std::uint64_t count);
  void
  ReadCompressed(std::uint64_t offset, char * bytes, std::uint64_t count);

  std::string                    m_Path;
  PlainLayout                    m_Layout;
  std::vector<InputFile>         m_Files; // open as long as the reader lives, if they are few
  std::unique_ptr<InflateStream> m_Stream;
  std::vector<char>              m_LastPart; // of a compressed stream
  std::uint64_t                  m_LastOffset = 0;
};

/** Reads a MetaImage or NRRD of which all is understood.
 * \throw HeaderNotUnderstood or std::runtime_error */
std::unique_ptr<VolumeReader>
OpenMetaImage(const std::string & path);
std::unique_ptr<VolumeReader>
OpenNrrd(const std::string & path);

/** Checks that the files of an NRRD whose header is not understood hold exactly the numbers that it says.
 * \return how many bytes they take
 * \throw std::runtime_error */
std::uint64_t
CheckNrrdNumbers(const std::string & path);

#endif
