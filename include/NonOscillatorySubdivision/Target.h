// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Target_h
#define NonOscillatorySubdivision_Target_h

#include "NonOscillatorySubdivision/ElementType.h"
#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>
#include <string>
#include <vector>

namespace itk
{
namespace Subdivision
{

struct TargetTable;

/** \brief An instruction set that kernels are compiled for and that this processor has. Results of two targets may
 * differ in the last place. */
class NonOscillatorySubdivision_EXPORT Target
{
public:
  static const Target &
  Fastest();

  /** The empty name stands for the fastest.
   * \throw std::invalid_argument that lists the names, where there is none. */
  static const Target &
  Named(const std::string & name);

  /** The names, the fastest first; the last one is always "portable". */
  static std::vector<std::string>
  GetNames();

  const char *
  GetName() const;

  /** Makes real values of elements that lie side by side. 64-bit integers round to nearest. */
  template <typename TReal>
  void
  Widen(ElementType type, const void * elements, std::size_t count, TReal * values) const;

  /** For the kernel, which alone knows what it is. */
  const TargetTable &
  GetTable() const
  {
    return *m_Table;
  }

private:
  friend struct TargetList;
  explicit Target(const TargetTable & table)
    : m_Table(&table)
  {}

  const TargetTable * m_Table;
};

} // namespace Subdivision
} // namespace itk

#endif
