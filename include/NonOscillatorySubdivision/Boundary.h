// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Boundary_h
#define NonOscillatorySubdivision_Boundary_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivisionExport.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief Supplies elements outside an array that follow no rule of Boundary's. Asked by several threads at once. */
class NonOscillatorySubdivision_EXPORT OutsideElements
{
public:
  virtual ~OutsideElements();

  /** The element at an index for each axis, at least one of which lies outside. May throw. */
  virtual double
  GetElement(const std::int64_t * index) const = 0;
};

/** \brief What lies outside an array. The scheme treats it as data. */
class NonOscillatorySubdivision_EXPORT Boundary
{
public:
  /** The default: the nearest element (zero flux). */
  static Boundary
  Nearest();
  /** Mirrored at the faces: ... 1 0 | 0 1 2 ... n-1 | n-1 n-2 ... */
  static Boundary
  Mirror();
  static Boundary
  Periodic();
  /** One value; or one for each position along axis 0, which then must not be subdivided (components of pixels). */
  static Boundary
  Constant(std::vector<double> values);
  /** Asks somebody else, who may read all of what the caller has of the array. */
  static Boundary
  Custom(std::shared_ptr<const OutsideElements> elements);

  /** Whether outside indices are mapped to inside ones, by MapIndex(). */
  bool
  MapsIndices() const;

  /** The index within [0, size) whose element stands at an index outside; only if MapsIndices().
   * \throw std::invalid_argument if there is none, since size is less than 1 */
  std::int64_t
  MapIndex(std::int64_t index, std::int64_t size) const;

  /** The part of an array's interval \c whole that is read for the elements of \c stencil, some of which may lie
   * outside. For Custom, all of \c whole if any lies outside. Never empty.
   * \throw std::invalid_argument if one of the intervals is empty */
  Interval
  GetRequest(const Interval & stencil, const Interval & whole) const;

  /** The values of Constant; else empty. */
  const std::vector<double> &
  GetConstants() const;

  /** Who is asked; null but for Custom. */
  const OutsideElements *
  GetElements() const;

private:
  enum class Kind
  {
    Nearest,
    Mirror,
    Periodic,
    Constant,
    Custom
  };
  explicit Boundary(Kind kind);

  Kind                                   m_Kind;
  std::vector<double>                    m_Constants;
  std::shared_ptr<const OutsideElements> m_Elements;
};

} // namespace Subdivision
} // namespace itk

#endif
