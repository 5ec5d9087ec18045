// SPDX-License-Identifier: Apache-2.0
#ifndef TextNumbers_h
#define TextNumbers_h

#include "NonOscillatorySubdivision/ElementType.h"

#include <cstdint>
#include <string>
#include <string_view>

/** Reads voxels that stand as text, as exactly the numbers that are there: an integer may be written 1e3 or 5.0, but
 * one that its type cannot hold ends the reading. */
class TextNumbers
{
public:
  /** \param separators characters besides blanks that may stand between two numbers
   * \param out room for \c count elements of the type */
  TextNumbers(std::string                   path,
              itk::Subdivision::ElementType type,
              std::uint64_t                 count,
              void *                        out,
              std::string                   separators = {});

  /** Goes on with a part of the text, which may end within a number.
   * \throw std::runtime_error */
  void
  Add(std::string_view part);

  /** Whether as many as are due have been read. */
  bool
  AreAll() const
  {
    return m_Done == m_Count;
  }

  /** To be called after the last part.
   * \return the first word after the numbers; empty if none is there
   * \throw std::runtime_error if there are fewer numbers */
  std::string
  Finish();

private:
  void
  TakeWord();
  bool
  TryToParse(void * to) const;

  const std::string                   m_Path;
  const itk::Subdivision::ElementType m_Type;
  const std::uint64_t                 m_Count;
  const std::string                   m_Blanks;
  char *                              m_Next;
  std::uint64_t                       m_Done = 0;
  std::string                         m_Word; // that goes on in the next part
  std::string                         m_Rest; // first word after the numbers
};

#endif
