// SPDX-License-Identifier: Apache-2.0
#ifndef NonTemporalWriter_h
#define NonTemporalWriter_h

#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>

namespace itk
{
namespace Subdivision
{

/** \class NonTemporalWriter
 *
 * \brief Copies bytes to memory that nobody reads soon.
 *
 * Where the processor can do so, whole cache lines go there without being read first and without taking the place of
 * what is in the cache. The bytes of a line that is not complete yet wait for the next copy, which usually begins where
 * this one ended. Elsewhere these are plain copies.
 *
 * All is written, and other threads may read it, once the writer is destroyed.
 *
 */
class NonOscillatorySubdivision_EXPORT NonTemporalWriter
{
public:
  NonTemporalWriter() = default;
  ~NonTemporalWriter();
  NonTemporalWriter(const NonTemporalWriter &) = delete;
  NonTemporalWriter &
  operator=(const NonTemporalWriter &) = delete;

  /** Copies \c bytes bytes; the memory at \c from may be used for other things afterwards. */
  void
  Copy(const void * from, std::size_t bytes, void * to);

private:
  static constexpr std::size_t LineLength = 64;

  void
  CopyWaiting();

  /** Where the next copy begins if it continues the last one. */
  unsigned char * m_End{ nullptr };
  /** The beginning of the line before m_End; it waits for its end. */
  unsigned char m_Line[LineLength];
  std::size_t   m_Waiting{ 0 };
};

} // namespace Subdivision
} // namespace itk

#endif
