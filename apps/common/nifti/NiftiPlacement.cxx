// SPDX-License-Identifier: Apache-2.0
#include "nifti/NiftiPlacement.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
/** Single precision numbers, after some steps, are a little beside what is meant. */
constexpr double Rounding = 1e-4;

std::string
JoinLengths(const std::array<double, 3> & lengths)
{
  std::ostringstream text; // with six digits, of single precision's seven
  text << lengths[0] << " x " << lengths[1] << " x " << lengths[2];
  return text.str();
}

/** Some programs turn an axis of a negative length round, some take its absolute value, and some take it for 1. */
std::string
ExplainNegativeLength(const std::size_t axis, const double length)
{
  const std::string  name = "pixdim[" + std::to_string(axis + 1) + "]";
  std::ostringstream text;
  text << "its voxels have a negative length of " << length << " (" << name
       << "), which programs take in different ways; set " << name << " to " << -length
       << ", and turn the axis round by the qform if that is meant";
  return text.str();
}

bool
AreOne(const std::array<double, 3> & a, const std::array<double, 3> & b, double tolerance)
{
  return std::equal(
    a.begin(), a.end(), b.begin(), [=](double x, double y) { return std::abs(x - y) <= tolerance * std::abs(y); });
}
} // namespace

template <typename TTest>
bool
NiftiPlacement::IsTrueOfAny(TTest && test) const
{
  return (m_Numbers.HasQuaternion && test(this->GetQuaternionMatrix())) ||
         (m_Numbers.HasMatrix && test(m_Numbers.Rows));
}

NiftiPlacement::Matrix
NiftiPlacement::GetQuaternionMatrix() const
{
  const double b = m_Numbers.Quaternion[0];
  const double c = m_Numbers.Quaternion[1];
  const double d = m_Numbers.Quaternion[2];
  const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
  Matrix       matrix = { { { a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), 0 },
                            { 2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), 0 },
                            { 2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c, 0 } } };
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      matrix[row][axis] *= (axis == 2 ? m_Numbers.Sign : 1.0) * m_Numbers.Spacing[axis];
    }
    matrix[row][3] = m_Numbers.Quaternion[3 + row];
  }
  return matrix;
}

bool
NiftiPlacement::IsFinite() const
{
  const auto areFinite = [](const auto & numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
  };
  return (!m_Numbers.HasQuaternion || areFinite(m_Numbers.Quaternion)) &&
         (!m_Numbers.HasMatrix || std::all_of(m_Numbers.Rows.begin(), m_Numbers.Rows.end(), areFinite));
}

bool
NiftiPlacement::IsTwice() const
{
  if (!m_Numbers.HasQuaternion || !m_Numbers.HasMatrix)
  {
    return false;
  }
  const Matrix   a = this->GetQuaternionMatrix();
  const Matrix & b = m_Numbers.Rows;
  double         smallest = 1e30;
  for (const double spacing : m_Numbers.Spacing)
  {
    smallest = std::min(smallest, std::abs(spacing));
  }
  // Both are in single precision, and rounded on the way: a tenth of a voxel is no rounding.
  double largest = 0.0;
  for (std::size_t row = 0; row < 3; ++row)
  {
    double change = std::abs(a[row][3] - b[row][3]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      change = std::max(change, std::abs(a[row][axis] - b[row][axis]) * m_Numbers.Size[axis]);
    }
    largest = std::max(largest, change);
  }
  return largest > 0.1 * smallest;
}

const char *
NiftiPlacement::GetName(const ImageGrid & grid) const
{
  // The grid is in millimetres, in a space whose first two axes point the other way.
  const double millimetres = grid.Spacing[0] / std::abs(m_Numbers.Spacing[0]);
  const auto   getDistance = [&](const Matrix & matrix) {
    double distance = 0.0;
    for (std::size_t row = 0; row < 3 && row < grid.Origin.size(); ++row)
    {
      const double sign = row < 2 ? -1.0 : 1.0;
      distance += std::abs(sign * millimetres * matrix[row][3] - grid.Origin[row]);
      for (std::size_t axis = 0; axis < 3 && axis < grid.Size.size(); ++axis)
      {
        distance += std::abs(sign * millimetres * matrix[row][axis] - grid.Spacing[axis] * grid.Directions[axis][row]);
      }
    }
    return distance;
  };
  return getDistance(m_Numbers.Rows) < getDistance(this->GetQuaternionMatrix()) ? "sform" : "qform";
}

bool
NiftiPlacement::LeavesAxes(const std::size_t axes) const
{
  return this->IsTrueOfAny([axes](const Matrix & matrix) {
    bool leaves = false;
    for (std::size_t axis = 0; axis < std::min<std::size_t>(axes, 3); ++axis)
    {
      const double length = std::hypot(matrix[0][axis], matrix[1][axis], matrix[2][axis]);
      for (std::size_t row = axes; row < 3; ++row)
      {
        leaves = leaves || !(std::abs(matrix[row][axis]) <= Rounding * length);
      }
    }
    return leaves;
  });
}

bool
NiftiPlacement::LiesBeside(const std::size_t axes) const
{
  return this->IsTrueOfAny([axes](const Matrix & matrix) {
    bool isBeside = false;
    for (std::size_t row = axes; row < 3; ++row)
    {
      isBeside = isBeside || matrix[row][3] != 0.0;
    }
    return isBeside;
  });
}

std::array<double, 3>
NiftiPlacement::GetMatrixSpacing() const
{
  const Matrix &        rows = m_Numbers.Rows;
  std::array<double, 3> lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = std::hypot(rows[0][axis], rows[1][axis], rows[2][axis]);
  }
  return lengths;
}

std::string
NiftiPlacement::FindFault() const
{
  for (std::size_t axis = 0; axis < m_Numbers.Axes; ++axis)
  {
    if (m_Numbers.Spacing[axis] < 0.0)
    {
      return ExplainNegativeLength(axis, m_Numbers.Spacing[axis]);
    }
  }
  constexpr double most = 1e-2;
  const bool       isMatrixAlone = m_Numbers.HasMatrix && !m_Numbers.HasQuaternion;
  return isMatrixAlone && !AreOne(this->GetMatrixSpacing(), m_Numbers.Spacing, most) ? this->ExplainRefusal() : "";
}

std::string
NiftiPlacement::ExplainRefusal() const
{
  const std::string away = ", or set sform_code to 0 to go without that placement";
  const auto        lengths = this->GetMatrixSpacing();
  if (*std::min_element(lengths.begin(), lengths.end()) == 0.0)
  {
    return "its sform has an axis without length; correct it" + away;
  }
  if (!AreOne(lengths, m_Numbers.Spacing, Rounding))
  {
    return "its sform has voxels of " + JoinLengths(lengths) + ", but its pixdim says " +
           JoinLengths(m_Numbers.Spacing) + "; correct the wrong one" + away;
  }
  return "its sform is sheared, with axes that are not at right angles; resample it to such axes" + away;
}
