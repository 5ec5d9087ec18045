// SPDX-License-Identifier: Apache-2.0
#ifndef TextReader_h
#define TextReader_h

#include "headers/PlainLayout.h"
#include "volumes/VolumeReader.h"

#include <string>
#include <vector>

/** Reads voxels that stand as text behind a header, or elsewhere: as numbers, or as the hexadecimal digits of their
 * bytes. It holds all of them. */
class TextReader : public VolumeReader
{
public:
  /** \throw std::runtime_error if the text is not exactly that of the image */
  TextReader(const std::string & path, const PlainLayout & layout);

  std::vector<std::string>
  GetFiles() const override;

  bool
  ReadsParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Read(const itk::Subdivision::Box & box, void * voxels) override;

private:
  std::vector<std::string> m_Files;
  std::vector<char>        m_Voxels;
};

#endif
