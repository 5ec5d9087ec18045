// SPDX-License-Identifier: Apache-2.0
#ifndef NrrdAxes_h
#define NrrdAxes_h

#include "headers/NrrdFields.h"
#include "headers/PlainLayout.h"

#include <string>
#include <vector>

/** Reads where each axis of an NRRD lies, the first one perhaps being of components. */
class NrrdAxes
{
public:
  /** Both must live as long as this. */
  NrrdAxes(const std::string & path, const NrrdFields & fields);

  /** Takes the last axis for the first one, if it is of components. */
  void
  MoveComponentsFirst();

  /** Fills in the grid, the number of components and what they mean.
   * \throw HeaderNotUnderstood or std::runtime_error */
  void
  Describe(ImageDescription & description) const;

  const std::vector<std::uint64_t> &
  GetSizes() const
  {
    return m_Sizes;
  }

private:
  /** Whether the first axis is of a voxel's components, and what they mean. */
  bool
  FindComponents(ImageDescription & description) const;
  unsigned int
  GetComponents(const std::string & kind) const;
  void
  FindDirections(std::size_t first, ImageGrid & grid) const;
  /** Without a space, an axis has a spacing and a place of its own. */
  void
  FindSpacings(std::size_t first, ImageGrid & grid) const;

  const std::string &        m_Path;
  const NrrdFields &         m_Fields;
  std::size_t                m_SpaceDimension;
  std::size_t                m_Count = 0;
  std::vector<std::uint64_t> m_Sizes;
  std::vector<std::string>   m_Kinds;
  std::vector<std::size_t>   m_Order; // which axis of the file is the first, the second, ...
};

/** 1 for each coordinate of a space, given in small letters, that points as in the LPS space, -1 if the other way. */
std::vector<double>
GetSigns(const std::string & name, std::size_t dimension);

#endif
