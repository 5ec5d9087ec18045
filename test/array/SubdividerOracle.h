// SPDX-License-Identifier: Apache-2.0
#ifndef SubdividerOracle_h
#define SubdividerOracle_h

#include "NonOscillatorySubdivision/Subdivider.h"
#include "common/SubdivisionReference.h"
#include "TestArray.h"

#include <functional>

/** The slow reference for arrays of up to five axes, of any first index and element type. */
class SubdividerOracle
{
public:
  static constexpr unsigned int Dimension = 5;
  using Index = SubdivisionReference::Index<Dimension>;
  using Grid = SubdivisionReference::Grid<Dimension>;
  using Boundary = SubdivisionReference::Boundary<Dimension>;

  /** \param input all of the input
   * \param boundary of a grid that begins at 0 along every axis */
  SubdividerOracle(const TestArray &                  input,
                   const SubdivisionReference::Scheme scheme,
                   const double                       tension,
                   const itk::Subdivision::Flags &    subdivided,
                   const Boundary &                   boundary)
    : m_Subdivided(subdivided)
    , m_Box(input.GetBox())
    , m_Reference(MakeGrid(input), MakeSettings(scheme, tension, subdivided, boundary))
  {}

  /** The value, neither rounded nor clamped, at an index of the output. */
  double
  At(const TestArray::Index & output) const
  {
    Index index{};
    for (std::size_t axis = 0; axis < output.size(); ++axis)
    {
      index[axis] = output[axis] - (m_Subdivided[axis] ? 2 : 1) * m_Box[axis].First;
    }
    return m_Reference.At(index);
  }

private:
  static Grid
  MakeGrid(const TestArray & input)
  {
    const TestArray::Box box = input.GetBox();
    Index                size;
    size.fill(1);
    for (std::size_t axis = 0; axis < box.size(); ++axis)
    {
      size[axis] = static_cast<long>(box[axis].Size);
    }
    return SubdivisionReference::MakeGrid<Dimension>(Index{}, size, [&](const Index & index) {
      TestArray::Index position;
      for (std::size_t axis = 0; axis < box.size(); ++axis)
      {
        position.push_back(box[axis].First + index[axis]);
      }
      return input.Get(position);
    });
  }

  static SubdivisionReference::Settings<Dimension>
  MakeSettings(const SubdivisionReference::Scheme scheme,
               const double                       tension,
               const itk::Subdivision::Flags &    subdivided,
               const Boundary &                   boundary)
  {
    SubdivisionReference::Settings<Dimension> settings;
    settings.scheme = scheme;
    settings.tension = tension;
    settings.boundary = boundary;
    settings.axes.fill(false);
    std::copy(subdivided.begin(), subdivided.end(), settings.axes.begin());
    return settings;
  }

  itk::Subdivision::Flags                      m_Subdivided;
  TestArray::Box                               m_Box;
  SubdivisionReference::Subdivision<Dimension> m_Reference;
};

#endif
